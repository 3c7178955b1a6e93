#include "diagnosis/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "diagnosis/periodic_torque.h"
#include "diagnosis/ranking.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/parallel.h"
#include "gapscope/base/require.h"
#include "signals/one_body.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

constexpr std::size_t kSecondRound = 4;
constexpr double kWorthComparing = 0.3;  ///< S that a candidate gains
constexpr double kExplainsMuch = 0.5;    ///< share of the log distance to the floor
constexpr double kLostClearly = 1.5;     ///< S behind the best, in a later step
constexpr std::size_t kLines = 3;        ///< of the residual torque that periodic effects begin with

/// Lines that periodic effects begin with: the strongest of the residual torque, one that stands out from its
/// neighbours, and those whose period was given.
std::vector<Harmonic> first_lines(const Study& study, const std::vector<Playback>& playbacks,
                                  std::span<const TorqueLine> standing, double torque_constant) {
  std::vector<Harmonic> lines = strongest_lines(playbacks, study.train, torque_constant, kLines);
  const auto add = [&](double periods) {
    const double apart = one_cycle(study.train);
    for (const Harmonic& l : lines)
      if (std::abs(l.periods - periods) < apart) return;
    std::vector<std::vector<double>> torque;
    for (const Playback& p : playbacks) torque.push_back(p.torque);
    lines.push_back(line_at(torque, study.train, torque_constant, periods));
  };
  if (!lines.empty() && !standing.empty()) add(standing.front().line.periods);
  for (const double periods : given_periods(study.options.known)) add(periods);
  return lines;
}

/// Starts of every candidate; those of periodic effects from the residual torque of the model so far.
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

/// Candidates that are not at the floor are fitted once more.
template <class Fit>
void once_more(const Study& study, const ScoredModel& before, const std::vector<std::size_t>& places,
               std::vector<ScoredModel>& ranked, const Fit& fit) {
  parallel_for(places.size(), study.options.threads, [&](std::size_t k) {
    ScoredModel& candidate = ranked[places[k]];
    if (!std::isfinite(candidate.score) || at_floor(candidate)) return;
    FittedModel fitted = fit(candidate.fitted);
    if (fitted.mean_cost < candidate.fitted.mean_cost)
      candidate = judge(candidate.entry, std::move(fitted), study.held_out, study.observer_hz);
  });
  rank(ranked, before, study.repeats_badly());
}

/// Fits the best few once more, also from the best candidate's values; the effect that the best contains and
/// those that contain it are among them at any rank. Where none of these explains much, all others follow.
/// @param all false, in a later step: only those that are near the best or easily mistaken for it
void further_rounds(const Study& study, const ScoredModel& before, std::vector<ScoredModel>& ranked,
                    bool all) {
  if (ranked.empty() || !std::isfinite(ranked.front().score)) return;
  const ReferenceModel first = ranked.front().fitted.model;
  const EffectEntry* best = ranked.front().entry;
  const double near = ranked.front().score + (at_floor(ranked.front()) ? 0.0 : kLostClearly);
  std::vector<std::size_t> few, rest;
  std::set<const EffectEntry*> tried;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const EffectEntry* entry = ranked[i].entry;
    if (i >= kSecondRound && entry != contained_effect(*best) && contained_effect(*entry) != best) continue;
    if (!all && ranked[i].score > near && !look_alike(*entry, *best)) continue;
    few.push_back(i);
    tried.insert(entry);
  }
  const FitOptions& options = study.options.fit;
  once_more(study, before, few, ranked, [&](const FittedModel& candidate) {
    return retry(study.train, candidate, first, study.sheet, options, study.observer_hz);
  });
  if (!all || relative_gain(before, ranked.front()) > kExplainsMuch || study.repeats_badly()) return;
  if (study.is_exhausted()) return;
  for (std::size_t i = 0; i < ranked.size(); ++i)
    if (!tried.contains(ranked[i].entry)) rest.push_back(i);
  once_more(study, before, rest, ranked, [&](const FittedModel& candidate) {
    return led_by_faster_observer(study.train, candidate, options, study.observer_hz);
  });
}

/// Look-alikes of a candidate begin once more, from the numbers of its drive: where the two are hard to tell
/// apart, a poor minimum must not decide.
void fit_look_alikes(const Study& study, const ScoredModel& before, const ScoredModel& best,
                     std::span<const EffectEntry* const> entries,
                     const std::vector<std::vector<EffectStart>>& starts, std::vector<ScoredModel>& ranked) {
  const FitOptions& options = study.options.fit;
  const std::vector<reference::FitLinearisation> bases =
      bases_of(study.train, before.fitted, best.fitted.model, options, study.observer_hz);
  if (bases.empty() || !(before.score - best.score > kWorthComparing)) return;
  parallel_for(ranked.size(), study.options.threads, [&](std::size_t k) {
    ScoredModel& c = ranked[k];
    if (!look_alike(*c.entry, *best.entry) || at_floor(c) || reads_counts(*c.entry)) return;
    const auto place = std::find(entries.begin(), entries.end(), c.entry) - entries.begin();
    FittedModel fitted =
        fit_candidate(study.train, before.fitted, {&bases.back(), 1}, *c.entry,
                      starts[static_cast<std::size_t>(place)], nullptr, options, study.observer_hz);
    if (fitted.mean_cost < c.fitted.mean_cost)
      c = judge(c.entry, std::move(fitted), study.held_out, study.observer_hz);
  });
}

}  // namespace

std::vector<Playback> play_on_train(const Study& study, const ReferenceModel& model) {
  HeldOut own;
  own.traces = study.train;
  own.scored_from.assign(own.traces.size(), 0);
  own.periods = own.scored_from;
  return play(model, own, study.observer_hz, true);
}

std::vector<ScoredModel> candidates_of(const Study& study, const ScoredModel& before,
                                       const std::vector<const EffectEntry*>& catalogue, bool first_step) {
  std::vector<const EffectEntry*> entries;
  for (const EffectEntry* entry : catalogue)
    if (reads_counts(*entry) ? study.seen_quantum > 0.0 : is_candidate(*entry, before.fitted.model))
      entries.push_back(entry);
  const auto starts = all_starts(study, before, entries);
  const std::vector<reference::FitLinearisation> bases =
      bases_of(study.train, before.fitted, study.sheet, study.options.fit, study.observer_hz);
  std::vector<ScoredModel> judged(entries.size());
  std::mutex saying;
  const auto run = [&](std::size_t i, const FittedModel* parent) {
    {
      const std::lock_guard lock(saying);
      study.options.progress(fmt::format("fitting {}", entries[i]->name));
    }
    FittedModel fitted = reads_counts(*entries[i])
                             ? with_quantum(before.fitted, *entries[i], study.seen_quantum)
                             : fit_candidate(study.train, before.fitted, bases, *entries[i], starts[i],
                                             parent, study.options.fit, study.observer_hz);
    judged[i] = judge(entries[i], std::move(fitted), study.held_out, study.observer_hz);
  };
  const auto place_of = [&](const EffectEntry* entry) {
    return static_cast<std::size_t>(std::find(entries.begin(), entries.end(), entry) - entries.begin());
  };
  const auto wave = [&](bool children) {
    std::vector<std::size_t> now;
    for (std::size_t i = 0; i < entries.size(); ++i)
      if ((contained_effect(*entries[i]) != nullptr) == children) now.push_back(i);
    parallel_for(now.size(), study.options.threads, [&](std::size_t k) {
      const std::size_t parent = place_of(contained_effect(*entries[now[k]]));
      const bool has = parent < entries.size() && judged[parent].fitted.mean_cost < kInfinity;
      run(now[k], has ? &judged[parent].fitted : nullptr);
    });
  };
  wave(false);
  wave(true);
  rank(judged, before, study.repeats_badly());
  const std::vector<ScoredModel> best(judged.begin(),
                                      judged.begin() + std::min<std::size_t>(2, judged.size()));
  for (const ScoredModel& b : best) fit_look_alikes(study, before, b, entries, starts, judged);
  rank(judged, before, study.repeats_badly());
  further_rounds(study, before, judged, first_step);
  return judged;
}

}  // namespace internal::diagnosis
}  // namespace gapscope
