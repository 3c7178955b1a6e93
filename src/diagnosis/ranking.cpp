#include "diagnosis/ranking.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/text.h"
#include "diagnosis/joint_effects.h"
#include "diagnosis/probability.h"
#include "gapscope/base/statistics.h"
#include "torque_view/evidence.h"

namespace gapscope::internal::diagnosis {
namespace {

const double kFloorScore = std::log(1.0 + kMeasure.score_offset);

bool names(std::span<const char* const> list, std::string_view name) {
  return std::any_of(list.begin(), list.end(), [&](const char* other) { return name == other; });
}

/// Whether an effect leaves more of the free runs' error than what is all of the cause does.
bool leaves_a_part(const ScoredModel& after, const ScoredModel& before, const DecisionRule& rule) {
  return !at_floor(after) && after.median_free - 1.0 > rule.all_of_cause * (before.median_free - 1.0);
}

/// Of the windows above the floor; NaN where none is.
double share_better(const std::vector<double>& before, const std::vector<double>& after) {
  double above = 0.0, better = 0.0;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    if (before[i] < kExplained) continue;
    above += 1.0;
    better += after[i] < before[i] ? 1.0 : 0.0;
  }
  return above > 0.0 ? better / above : kNaN;
}

}  // namespace

bool look_alike(const EffectEntry& a, const EffectEntry& b) {
  return names(a.look_alikes, b.name) || names(b.look_alikes, a.name);
}

ScoredModel scored_by_windows(const EffectEntry* entry, Windows windows) {
  ScoredModel j;
  j.entry = entry;
  j.windows = std::move(windows);
  const double parameters = entry != nullptr ? static_cast<double>(entry->parameters.size()) : 0.0;
  j.score = log_score(j.windows) + kMeasure.score_per_parameter * parameters;
  j.median_free = median_size(j.windows.free);
  j.median_innovation = median_size(j.windows.innovation);
  return j;
}

ScoredModel judge(const EffectEntry* entry, FittedModel fitted, const HeldOut& held_out, double hz) {
  ScoredModel j;
  j.entry = entry;
  if (fitted.mean_cost < kInfinity)
    if (const auto playbacks = play(fitted.model, held_out, hz, false); !playbacks.empty())
      j = scored_by_windows(entry, windows_of(playbacks, held_out));
  j.fitted = std::move(fitted);
  return j;
}

bool at_floor(const ScoredModel& j) {
  return j.median_free < kRule.floor_ratio && j.median_innovation < kRule.floor_ratio;
}

bool is_led_astray(const ScoredModel& added, const ScoredModel& other) {
  return added.median_innovation < kRule.floor_ratio && !(other.median_innovation < kRule.floor_ratio) &&
         added.median_free > other.median_free;
}

bool leaves_far_more_held_out(const ScoredModel& model, double fitted_mean_cost) {
  return model.median_free > kRule.far * std::sqrt(fitted_mean_cost);
}

bool helps(const ScoredModel& before, const ScoredModel& after, bool repeats_badly) {
  const auto windows = repeats_badly ? &Windows::innovation : &Windows::free;
  const std::vector<double>&b = before.windows.*windows, &a = after.windows.*windows;
  if (b.empty() || a.size() != b.size()) return false;
  if (!(after.fitted.mean_cost < (1.0 - kRule.worth_having) * before.fitted.mean_cost)) return false;
  const auto& effects = after.fitted.model.effects;
  if (!effects.empty() && is_absent(effects.back())) return false;
  const auto squares = [](const std::vector<double>& w) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(w.data(), std::ssize(w)));
  };
  const torque_view::Evidence evidence = torque_view::Blocks(b.size(), {}).compare(squares(b), squares(a));
  return evidence.share >= kRule.evident && evidence.interval.low > 0.0 &&
         share_of_windows_better(before, after) >= kRule.least_windows;
}

double relative_gain(const ScoredModel& before, const ScoredModel& after) {
  return (before.score - after.score) / std::max(before.score - kFloorScore, kRule.tells_apart);
}

double share_of_windows_better(const ScoredModel& before, const ScoredModel& after) {
  if (after.windows.free.empty()) return after.windows_better;
  const double free = share_better(before.windows.free, after.windows.free);
  return std::isnan(free) ? share_better(before.windows.innovation, after.windows.innovation) : free;
}

void rank(std::vector<ScoredModel>& candidates, const DecisionRule& rule) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const ScoredModel& a, const ScoredModel& b) { return a.score < b.score; });
  if (candidates.empty()) return;
  const EffectEntry* parent = contained_effect(*candidates.front().entry);
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const ScoredModel& c) {
    return parent != nullptr && c.entry == parent;
  });
  if (found != candidates.end() && found->score - candidates.front().score < rule.indistinct)
    std::rotate(candidates.begin(), found, std::next(found));
}

namespace {

/// Whether a rival explains what was fitted clearly better than the best on what is held out, which leaves
/// something there, too: the law of the drive does both best. What contains the best always fits it no worse.
bool fits_better(const ScoredModel& rival, const ScoredModel& best, const ScoredModel& before,
                 const DecisionRule& rule) {
  if (at_floor(best) || contained_effect(*rival.entry) == best.entry) return false;
  if (reads_counts(*rival.entry) || reads_counts(*best.entry)) return false;
  return before.score - rival.score >= rule.indistinct &&
         rival.fitted.mean_cost < (1.0 - rule.worth_having) * best.fitted.mean_cost;
}

}  // namespace

Decision decide(const std::vector<ScoredModel>& ranked, const ScoredModel& before, Reach reach,
                std::span<const ScoredModel> excluded_parents, const DecisionRule& rule) {
  Decision d;
  if (ranked.empty() || !std::isfinite(ranked.front().score)) return d;
  const ScoredModel& best = ranked.front();
  d.gain = before.score - best.score;
  d.rel = relative_gain(before, best);
  d.windows_better = share_of_windows_better(before, best);
  double other = before.score;
  for (const ScoredModel& c : ranked) {
    if (contained_effect(*c.entry) == best.entry) continue;  // it contains the best: parsimony has decided
    const bool alike = &c == &best || look_alike(*c.entry, *best.entry);
    if (c.score - best.score < (alike ? rule.tells_apart : rule.indistinct))
      d.group.push_back(c.entry);
    else
      other = std::min(other, c.score);
  }
  d.margin = other - best.score;
  // Where the floor is out of reach, a share of the log distance to it could not be told.
  const double closed =
      reach == Reach::kAnyGain ? 1.0 - best.median_innovation / before.median_innovation : d.rel;
  d.probability = group_probability(closed, d.margin, d.gain);
  const bool far_enough = reach == Reach::kAnyGain
                              ? d.gain >= rule.tells_apart && d.windows_better >= rule.least_windows
                              : d.rel >= rule.least_way;
  const bool asked_for =
      reads_counts(*best.entry) || best.fitted.mean_cost < rule.asked_for * before.fitted.mean_cost;
  d.accepted = far_enough && asked_for && d.margin >= rule.tells_apart;
  for (const ScoredModel& parent : excluded_parents)
    if (contained_effect(*best.entry) == parent.entry && parent.score - best.score < rule.tells_apart)
      d.accepted = false;
  return d;
}

Decision decide_alone(const std::vector<ScoredModel>& ranked, const ScoredModel& before, Reach reach,
                      std::span<const ScoredModel> excluded_parents, const DecisionRule& rule) {
  Decision d = decide(ranked, before, reach, excluded_parents, rule);
  for (const ScoredModel& c : ranked)
    if (std::find(d.group.begin(), d.group.end(), c.entry) == d.group.end() &&
        fits_better(c, ranked.front(), before, rule))
      d.accepted = false, d.group.push_back(c.entry);
  d.in_part = d.accepted && reach == Reach::kFloor && leaves_a_part(ranked.front(), before, rule);
  d.accepted = d.accepted && !d.in_part;
  return d;
}

Decision decide_among_equals(const std::vector<ScoredModel>& ranked, const ScoredModel& before, Reach reach,
                             std::span<const ScoredModel> excluded_parents, const DecisionRule& rule) {
  const Decision as_ranked = decide_alone(ranked, before, reach, excluded_parents, rule);
  if (as_ranked.accepted || ranked.empty() || !at_floor(ranked.front())) return as_ranked;
  std::vector<ScoredModel> others = ranked;
  std::vector<const EffectEntry*> equals;
  std::erase_if(others, [&](const ScoredModel& c) {
    const bool equal =
        c.entry != ranked.front().entry && at_floor(c) && c.score - ranked.front().score < rule.tells_apart;
    if (equal && contained_effect(*c.entry) != ranked.front().entry) equals.push_back(c.entry);
    return equal;
  });
  Decision d = decide_alone(others, before, reach, excluded_parents, rule);
  if (!d.accepted) return as_ranked;
  d.group.insert(d.group.end(), equals.begin(), equals.end());
  return d;
}

namespace {

std::string words_on(double innovation, double free) {
  const double counts = kRule.indistinct;
  if (innovation < -counts && free > counts) return "flatters the predictions, spoils the free runs";
  if (free < -counts && innovation > counts) return "flatters the free runs, spoils the predictions";
  if (std::abs(free) < counts && std::abs(innovation) < counts) return "as without it";
  return "";
}

}  // namespace

std::string remark_on(const ScoredModel& c, const ScoredModel& before) {
  if (!std::isfinite(c.score)) return "the motion with it diverges";
  const std::string words = words_on(mean_log(c.windows.innovation) - mean_log(before.windows.innovation),
                                     mean_log(c.windows.free) - mean_log(before.windows.free));
  if (c.fitted.at_bound.empty()) return words;
  std::vector<std::string> names;
  for (const std::string& key : c.fitted.at_bound) names.push_back(name_of_key(key));
  return fmt::format("{}{}{} at a bound", words, words.empty() ? "" : "; ", fmt::join(names, ", "));
}

}  // namespace gapscope::internal::diagnosis
