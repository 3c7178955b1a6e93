#include "diagnosis/ranking.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "diagnosis/probability.h"
#include "gapscope/base/random.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kAlike = 0.3;         ///< S between look-alikes that the data does not separate
constexpr double kAlikeOfLeft = 0.15;  ///< added to it for each S that the best leaves
constexpr double kIndistinct = 0.08;   ///< S between any two effects that the data does not separate
constexpr double kLeastRel = 0.4;      ///< share of the log distance to the floor that a step closes
constexpr double kLeastMargin = 0.3;   ///< S by which it beats all others
constexpr double kOtherFormRel =
    0.2;  ///< the same where the margin below says that only the form of the law differs
constexpr double kOtherFormMargin = 1.5;  ///< S by which such an effect beats all others
constexpr double kOtherFormShrink = 0.7;  ///< share of the free runs' size that such an effect takes
constexpr double kLeastGain = 0.3;        ///< S, of a step that cannot reach the floor
constexpr double kLeastWindows = 0.6;     ///< share of the windows that such a step improves
constexpr double kAskedFor =
    0.85;  ///< of the fitted mean square that a step leaves at most: held-out luck is no finding
constexpr double kAskedForAtFloor = 0.99;  ///< the same of a step that comes to the floor
constexpr double kNestedShare = 0.8;       ///< of the child's gain: the parent is enough
constexpr double kNestedMargin = 0.6;      ///< S from which on the child is better nevertheless
constexpr double kNestedShareOfSize =
    0.5;  ///< share of the prediction error's decrease above which the parent is enough
constexpr double kLeastDistance = 0.3;     ///< S to the floor of which a share can be told
constexpr double kTrace = 0.02;            ///< share of the free runs' size that such a law may leave
constexpr double kParentAsGood = 0.1;      ///< S, at the floor
constexpr double kFarMore = 20.0;          ///< times the size that is left of what was fitted
constexpr double kLeastHelp = 0.1;         ///< of the mean square of the held-out windows
constexpr double kHelpFitted = 0.97;       ///< of the fitted mean square, at most, that what helps leaves
constexpr std::size_t kFewestWindows = 4;  ///< of which an interval can be told
constexpr int kDraws = 400;
const double kFloorScore = std::log(1.0 + kScoreOffset);

bool names(std::span<const char* const> list, std::string_view name) {
  return std::any_of(list.begin(), list.end(), [&](const char* other) { return name == other; });
}

/// Whether such an effect leaves more than a trace of the free runs' error: it is then at best a part of the
/// cause.
bool leaves_a_part(const ScoredModel& after, const ScoredModel& before) {
  return after.entry->law_is_fixed && !at_floor(after) &&
         after.median_free - 1.0 > kTrace * (before.median_free - 1.0);
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

ScoredModel judge(const EffectEntry* entry, FittedModel fitted, const HeldOut& held_out, double hz) {
  ScoredModel j;
  j.entry = entry;
  if (fitted.mean_cost < kInfinity) {
    if (const auto playbacks = play(fitted.model, held_out, hz, false); !playbacks.empty()) {
      j.windows = windows_of(playbacks, held_out);
      const double parameters = entry != nullptr ? static_cast<double>(entry->parameters.size()) : 0.0;
      j.score = log_score(j.windows) + kScorePerParameter * parameters;
      j.median_free = median_size(j.windows.free);
      j.median_innovation = median_size(j.windows.innovation);
    }
  }
  j.fitted = std::move(fitted);
  return j;
}

bool at_floor(const ScoredModel& j) {
  return j.median_free < kFloorRatio && j.median_innovation < kFloorRatio;
}

bool leaves_far_more_held_out(const ScoredModel& model, double fitted_mean_cost) {
  return model.median_free > kFarMore * std::sqrt(fitted_mean_cost);
}

bool helps(const ScoredModel& before, const ScoredModel& after, bool repeats_badly) {
  const auto windows = repeats_badly ? &Windows::innovation : &Windows::free;
  const std::vector<double>&b = before.windows.*windows, &a = after.windows.*windows;
  const std::size_t count = std::min(a.size(), b.size());
  if (count < kFewestWindows || !(after.fitted.mean_cost < kHelpFitted * before.fitted.mean_cost))
    return false;
  const auto share = [&](const std::vector<std::size_t>& drawn) {
    double left = 0.0, all = 0.0;
    for (const std::size_t i : drawn) left += a[i], all += b[i];
    return 1.0 - left / all;
  };
  std::vector<std::size_t> drawn(count);
  std::iota(drawn.begin(), drawn.end(), 0u);
  if (!(share(drawn) >= kLeastHelp) || !(share_of_windows_better(before, after) >= kLeastWindows))
    return false;
  std::mt19937_64 generator = random_stream(1, "windows that help");
  std::vector<double> shares;
  for (int draw = 0; draw < kDraws; ++draw) {
    for (std::size_t& i : drawn)
      i = static_cast<std::size_t>(uniform(generator, 0.0, static_cast<double>(count)));
    shares.push_back(share(drawn));
  }
  return quantile(std::move(shares), 0.025) > 0.0;
}

double relative_gain(const ScoredModel& before, const ScoredModel& after) {
  return (before.score - after.score) / std::max(before.score - kFloorScore, kLeastDistance);
}

double share_of_windows_better(const ScoredModel& before, const ScoredModel& after) {
  if (after.windows.free.empty()) return after.windows_better;
  const double free = share_better(before.windows.free, after.windows.free);
  return std::isnan(free) ? share_better(before.windows.innovation, after.windows.innovation) : free;
}

void rank(std::vector<ScoredModel>& candidates, const ScoredModel& before, bool repeats_badly) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const ScoredModel& a, const ScoredModel& b) { return a.score < b.score; });
  if (candidates.empty()) return;
  const ScoredModel& best = candidates.front();
  const EffectEntry* parent = contained_effect(*best.entry);
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const ScoredModel& c) {
    return parent != nullptr && c.entry == parent;
  });
  if (found == candidates.end()) return;
  if (at_floor(best)) {
    if (at_floor(*found) && found->score - best.score < kParentAsGood)
      std::rotate(candidates.begin(), found, std::next(found));
    return;
  }
  const double share = repeats_badly ? (before.median_innovation - found->median_innovation) /
                                           (before.median_innovation - best.median_innovation)
                                     : (before.score - found->score) / (before.score - best.score);
  const bool little_worse =
      repeats_badly ? before.score - found->score >= kLeastGain : found->score - best.score < kNestedMargin;
  if (little_worse && share > (repeats_badly ? kNestedShareOfSize : kNestedShare))
    std::rotate(candidates.begin(), found, std::next(found));
}

Decision decide(const std::vector<ScoredModel>& ranked, const ScoredModel& before, bool repeats_badly,
                std::span<const ScoredModel> excluded_parents) {
  Decision d;
  if (ranked.empty() || !std::isfinite(ranked.front().score)) return d;
  const ScoredModel& best = ranked.front();
  d.gain = before.score - best.score;
  d.rel = relative_gain(before, best);
  d.windows_better = share_of_windows_better(before, best);
  const double left = repeats_badly ? 0.0 : std::max(best.score - kFloorScore, 0.0);
  double other = before.score;
  for (const ScoredModel& c : ranked) {
    if (contained_effect(*c.entry) == best.entry) continue;  // it contains the best: parsimony has decided
    const bool alike = &c == &best || look_alike(*c.entry, *best.entry);
    if (c.score - best.score < (alike ? kAlike + kAlikeOfLeft * left : kIndistinct))
      d.group.push_back(c.entry);
    else
      other = std::min(other, c.score);
  }
  d.margin = other - best.score;
  // A drive that repeats itself badly has no floor that a share of the log distance could be told of.
  const double closed = repeats_badly ? 1.0 - best.median_innovation / before.median_innovation : d.rel;
  d.probability = group_probability(closed, d.margin, d.gain);
  const bool of_other_form = d.rel >= kOtherFormRel && d.margin >= kOtherFormMargin &&
                             best.median_free < (1.0 - kOtherFormShrink) * before.median_free;
  const bool enough = repeats_badly ? d.gain >= kLeastGain && d.windows_better >= kLeastWindows
                                    : d.rel >= kLeastRel || of_other_form;
  const double fitted = best.fitted.mean_cost;
  const double share = fitted < kExplained ? kAskedForAtFloor : kAskedFor;
  const bool asked_for = reads_counts(*best.entry) || fitted < share * before.fitted.mean_cost;
  d.accepted = enough && asked_for && d.margin >= kLeastMargin;
  for (const ScoredModel& parent : excluded_parents)
    if (contained_effect(*best.entry) == parent.entry && parent.score - best.score < kLeastMargin)
      d.accepted = false;
  return d;
}

Decision decide_alone(const std::vector<ScoredModel>& ranked, const ScoredModel& before, bool repeats_badly,
                      std::span<const ScoredModel> excluded_parents) {
  Decision d = decide(ranked, before, repeats_badly, excluded_parents);
  d.in_part = d.accepted && !repeats_badly && leaves_a_part(ranked.front(), before);
  d.accepted = d.accepted && !d.in_part;
  return d;
}

}  // namespace gapscope::internal::diagnosis
