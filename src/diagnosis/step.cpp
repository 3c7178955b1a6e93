#include "diagnosis/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "diagnosis/counted.h"
#include "diagnosis/periodic_torque.h"
#include "diagnosis/ranking.h"
#include "signals/one_body.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

/// Lines that periodic effects begin with: the strongest of the correcting torque, one that stands out from
/// its neighbours, and those whose period was given. A torque that does not follow the drive's begins as it
/// stands out: an observer that is slow against it has a part of its size.
std::vector<Harmonic> first_lines(const Study& study, const std::vector<Playback>& playbacks,
                                  std::span<const TorqueLine> standing, double torque_constant) {
  std::vector<Harmonic> lines = strongest_lines(playbacks, study.train, torque_constant, study.effort.lines);
  const double apart = one_cycle(study.train);
  const auto add = [&](double periods) {
    for (const Harmonic& l : lines)
      if (std::abs(l.periods - periods) < apart) return;
    std::vector<std::vector<double>> torque;
    for (const Playback& p : playbacks) torque.push_back(p.torque);
    lines.push_back(line_at(torque, study.train, torque_constant, periods));
  };
  if (!lines.empty() && !standing.empty()) {
    const Harmonic& line = standing.front().line;
    if (torque_constant == 0.0) {
      std::erase_if(lines, [&](const Harmonic& l) { return std::abs(l.periods - line.periods) < apart; });
      lines.push_back(line);
    } else {
      add(line.periods);
    }
  }
  for (const double periods : given_periods(study.options.known)) add(periods);
  return lines;
}

/// Starts of every candidate; those of periodic effects from the correcting torque of the model so far.
std::vector<std::vector<EffectStart>> all_starts(const Study& study, const ScoredModel& before,
                                                 std::span<const EffectEntry* const> entries) {
  const std::vector<Playback> playbacks = play_on_train(study, before.fitted.model);
  const std::vector<TorqueLine> standing = standing_lines(ripples_of(playbacks), study.train);
  const signals::OneBody rough = signals::as_one_body(study.train);
  const double km = before.fitted.model.parameters[place::kTorqueConstant].value;
  std::vector<std::vector<EffectStart>> starts;
  for (const EffectEntry* entry : entries) {
    starts.push_back(effect_starts(*entry));
    const bool of_torque = entry->start_search == StartSearch::kTorqueLines;
    const bool of_share = entry->start_search == StartSearch::kTorqueShareLines;
    if (!of_torque && !of_share) continue;
    const auto lines = first_lines(study, playbacks, standing, of_share ? km : 0.0);
    starts.back() = line_starts(*entry, lines, km * rough.peak_input, rough.travel);
  }
  return starts;
}

/// A coarser encoder is seen on the samples themselves; nothing is fitted.
FittedModel with_quantum(FittedModel nominal, const EffectEntry& entry, double quantum) {
  ModelEffect effect;
  effect.entry = &entry;
  effect.parameters[0].value = quantum;
  nominal.model.effects.push_back(effect);
  nominal.at_bound.clear();
  return nominal;
}

bool contains_law_of(const EffectEntry& a, const EffectEntry& b) { return contained_effect(a) == &b; }

bool related(const EffectEntry& a, const EffectEntry& b) {
  return look_alike(a, b) || contains_law_of(a, b) || contains_law_of(b, a);
}

/// Candidates that are not at the floor are fitted once more.
template <class Fit>
void once_more(const Study& study, const char* why, const std::vector<std::size_t>& places,
               std::vector<ScoredModel>& ranked, const Fit& fit) {
  Counted counted(study.options.progress, places.size());
  parallel_for(places.size(), study.options.threads, [&](std::size_t k) {
    ScoredModel& candidate = ranked[places[k]];
    counted.begin(fmt::format("{}: {}", why, candidate.entry->name));
    if (!std::isfinite(candidate.score) || at_floor(candidate) || finish_requested()) return;
    FittedModel fitted = fit(candidate.fitted);
    if (fitted.mean_cost < candidate.fitted.mean_cost)
      candidate = judge(candidate.entry, std::move(fitted), study.held_out, study.observer_hz);
  });
  rank(ranked);
}

/// Searches for the gap anew with the best candidate, and with what that has come to as long as it leaves far
/// less: the first fit, and all candidates with it, may be where a gap or its contact stands for the effect.
void leave_closed_gap(const Study& study, std::vector<ScoredModel>& ranked) {
  if (ranked.empty() || !seeks_gap(study.sheet)) return;
  ScoredModel& best = ranked.front();
  for (bool far_better = true;
       far_better && std::isfinite(best.score) && !at_floor(best) && !finish_requested();) {
    FittedModel other = searched_from_sheet(study, best.fitted);
    far_better = other.mean_cost < study.effort.far_better * best.fitted.mean_cost;
    best = judge(best.entry, std::move(other), study.held_out, study.observer_hz);
  }
  rank(ranked);
}

/// Fits the best few and what is related to the best once more, also from the best candidate's values: where
/// two are hard to tell apart, a poor minimum must not decide. Where one explains all, its drive is the place
/// to begin; where none explains much, all others follow.
/// @param others false, in a later step: these do not
void further_rounds(const Study& study, const ScoredModel& before, std::vector<ScoredModel>& ranked,
                    bool others) {
  if (ranked.empty() || !std::isfinite(ranked.front().score) || finish_requested()) return;
  const ReferenceModel first = ranked.front().fitted.model;
  const EffectEntry* best = ranked.front().entry;
  std::vector<std::size_t> few, rest;
  std::set<const EffectEntry*> tried;
  for (std::size_t i = 0; i < ranked.size(); ++i)
    if (i < study.effort.leaders || related(*ranked[i].entry, *best)) {
      few.push_back(i);
      tried.insert(ranked[i].entry);
    }
  const bool explained = at_floor(ranked.front());
  once_more(study, "fitting the best once more", few, ranked, [&](const FittedModel& candidate) {
    return explained ? on_drive_of(study, candidate, first) : retry(study, candidate, first);
  });
  if (!others || relative_gain(before, ranked.front()) > kRule.least_way || study.repeats_badly()) return;
  for (std::size_t i = 0; i < ranked.size(); ++i)
    if (!tried.contains(ranked[i].entry)) rest.push_back(i);
  once_more(study, "none explains much, fitting the others once more", rest, ranked,
            [&](const FittedModel& candidate) { return led_by_faster_observer(study, candidate); });
}

/// All candidates of a step. Every one races; those that lead there, and what is related to the best of them,
/// are refined. All are where none of these explains much of what was fitted. Asked to finish, a first step
/// does what it needs for a ranking, a later one is given up.
class Field {
 public:
  Field(const Study& study, const ScoredModel& before, std::span<const EffectEntry* const> entries,
        std::span<const reference::FitLinearisation> bases,
        const std::vector<std::vector<EffectStart>>& starts, bool first_step)
      : study_(study),
        first_step_(first_step),
        before_(before),
        entries_(entries),
        bases_(bases),
        starts_(starts),
        raced_(entries.size()),
        fitted_(entries.size()),
        races_(study.options.progress, entries.size()) {}

  std::vector<ScoredModel> judged() {
    race_all(false);
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (is_parent(i)) refine({i});
    race_all(true);
    const std::vector<std::size_t> leaders = leading();
    refine({leaders.begin(), leaders.begin() + std::min<std::ptrdiff_t>(1, std::ssize(leaders))});
    refine(leaders);
    refine(related_to_the_best());
    if (!finish_requested() && !(least_fitted() < study_.effort.far_better * before_.fitted.mean_cost))
      refine(all());
    if (is_given_up()) return {};
    std::vector<ScoredModel> judged(entries_.size());
    parallel_for(entries_.size(), study_.options.threads, [&](std::size_t i) {
      FittedModel fitted = fitted_[i] ? std::move(*fitted_[i]) : raced_[i]->as_raced();
      judged[i] = judge(entries_[i], std::move(fitted), study_.held_out, study_.observer_hz);
    });
    return judged;
  }

 private:
  bool is_parent(std::size_t i) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const EffectEntry* e) { return contained_effect(*e) == entries_[i]; });
  }

  bool is_given_up() const { return !first_step_ && finish_requested(); }

  void race(std::size_t i) {
    if (is_given_up()) return;
    races_.begin(fmt::format("fitting {}", entries_[i]->name));
    if (reads_counts(*entries_[i])) {
      fitted_[i] = with_quantum(before_.fitted, *entries_[i], study_.seen_quantum);
      return;
    }
    const auto parent = std::find(entries_.begin(), entries_.end(), contained_effect(*entries_[i]));
    const std::optional<FittedModel>* simpler =
        parent == entries_.end() ? nullptr : &fitted_[static_cast<std::size_t>(parent - entries_.begin())];
    const bool has = simpler != nullptr && *simpler && (*simpler)->mean_cost < kInfinity;
    raced_[i].emplace(study_, before_.fitted, bases_, *entries_[i], starts_[i], has ? &**simpler : nullptr);
  }

  /// @param children those that contain another effect: they begin on its fit, too
  void race_all(bool children) {
    std::vector<std::size_t> now;
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if ((contained_effect(*entries_[i]) != nullptr) == children) now.push_back(i);
    parallel_for(now.size(), study_.options.threads, [&](std::size_t k) { race(now[k]); });
  }

  /// Once one explains all of what was fitted, the others need not come to their end: they begin once more on
  /// its drive, see further_rounds().
  void refine(std::vector<std::size_t> places) {
    std::erase_if(places, [&](std::size_t i) { return fitted_[i].has_value(); });
    const bool explained = std::any_of(fitted_.begin(), fitted_.end(),
                                       [](const auto& f) { return f && f->mean_cost < kExplained; });
    Counted counted(study_.options.progress, places.size());
    parallel_for(places.size(), study_.options.threads, [&](std::size_t k) {
      if (is_given_up()) return;
      counted.begin(fmt::format("refining {}", entries_[places[k]]->name));
      fitted_[places[k]] = raced_[places[k]]->refined(!explained);
    });
  }

  std::vector<std::size_t> all() const {
    std::vector<std::size_t> places(entries_.size());
    std::iota(places.begin(), places.end(), 0u);
    return places;
  }

  std::vector<std::size_t> leading() const {
    std::vector<std::size_t> places = all();
    const auto left = [&](std::size_t i) { return raced_[i] ? raced_[i]->raced() : 0.0; };
    std::stable_sort(places.begin(), places.end(),
                     [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
    places.resize(std::min(places.size(), study_.effort.leaders));
    return places;
  }

  std::vector<std::size_t> related_to_the_best() const {
    const auto left = [&](std::size_t i) { return fitted_[i] ? fitted_[i]->mean_cost : kInfinity; };
    std::vector<std::size_t> places = all();
    if (places.empty()) return {};
    const std::size_t best = *std::min_element(
        places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
    std::erase_if(places, [&](std::size_t i) { return !related(*entries_[best], *entries_[i]); });
    return places;
  }

  double least_fitted() const {
    double least = kInfinity;
    for (const std::optional<FittedModel>& f : fitted_)
      if (f) least = std::min(least, f->mean_cost);
    return least;
  }

  const Study& study_;
  bool first_step_;
  const ScoredModel& before_;
  std::span<const EffectEntry* const> entries_;
  std::span<const reference::FitLinearisation> bases_;
  const std::vector<std::vector<EffectStart>>& starts_;
  std::vector<std::optional<RacedCandidate>> raced_;
  std::vector<std::optional<FittedModel>> fitted_;
  Counted races_;
};

}  // namespace

std::vector<Playback> play_on_train(const Study& study, const ReferenceModel& model) {
  HeldOut own;
  own.traces = study.train;
  own.scored_from.assign(own.traces.size(), 0);
  own.periods.assign(own.traces.size(), 0.0);
  return play(model, own, study.observer_hz, true);
}

std::vector<ScoredModel> candidates_of(const Study& study, const ScoredModel& before,
                                       const std::vector<const EffectEntry*>& catalogue, bool first_step) {
  std::vector<const EffectEntry*> entries;
  for (const EffectEntry* entry : catalogue)
    if (reads_counts(*entry) ? study.seen_quantum > 0.0 : is_candidate(*entry, before.fitted.model))
      entries.push_back(entry);
  const auto starts = all_starts(study, before, entries);
  const std::vector<reference::FitLinearisation> bases = bases_of(study, before.fitted);
  std::vector<ScoredModel> judged = Field(study, before, entries, bases, starts, first_step).judged();
  rank(judged);
  if (first_step) leave_closed_gap(study, judged);
  further_rounds(study, before, judged, first_step);
  return judged;
}

}  // namespace internal::diagnosis
}  // namespace gapscope
