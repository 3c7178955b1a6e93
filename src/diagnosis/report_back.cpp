#include "diagnosis/report_back.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "diagnosis/long_runs.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/open_question.h"
#include "diagnosis/periodic_torque.h"
#include "diagnosis/probability.h"
#include "diagnosis/ranking.h"
#include "diagnosis/tell_budget.h"
#include "diagnosis/tell_intervals.h"
#include "diagnosis/under_controller.h"
#include "diagnosis/where.h"
#include "recording/supply.h"

namespace gapscope::internal::diagnosis {
namespace {

std::vector<RankedEffect> ranking_of(const Study& study, const ScoredModel& before,
                                     const std::vector<ScoredModel>& candidates, const Decision& decision) {
  std::vector<RankedEffect> ranking;
  const double floor = judged_floor(study);
  const auto windows = judged_windows(study);
  const double size_before = median_size(before.windows.*windows);
  const Shares shares = probability_shares(candidates, decision, study.options.known.outside_catalogue);
  for (const ScoredModel& c : candidates) {
    RankedEffect r;
    r.effect = c.entry->name;
    r.score = c.score;
    r.rel = relative_gain(before, c);
    r.windows_better = share_of_windows_better(before, c);
    if (std::isfinite(c.score)) {
      const double size = median_size(c.windows.*windows);
      r.held_out = floor * size;
      r.shrink = shrink_of(size_before, size);
    }
    r.probability = shares.candidates[ranking.size()];
    if (!c.fitted.model.effects.empty()) r.parameters = effect_values(c.fitted.model.effects.back());
    r.remark = remark_on(c, before);
    ranking.push_back(r);
  }
  return ranking;
}

std::vector<BlameShift> blame_of(const ScoredModel& before, const ScoredModel& after) {
  std::vector<BlameShift> blame;
  for (std::size_t i = 0; i < kDriveParameterCount; ++i) {
    const ParameterSetting& p = before.fitted.model.parameters[i];
    if (p.estimate)
      blame.push_back(
          {kDriveParameters[i].key, kDriveParameters[i].unit, p.value, after.fitted.model.parameters[i].value,
           before.fitted.drive_at_bound[i], after.fitted.drive_at_bound[i],
           after.fitted.balanced && std::equal_to<>()(after.fitted.model.parameters[i].value, p.value)});
  }
  return blame;
}

/// Of the rows that a controller made the input of, those of the trace.
std::vector<double> part_of(const std::vector<double>& rows, const MotorTrace& t) {
  const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(t.command_first);
  return {begin, begin + static_cast<std::ptrdiff_t>(t.size())};
}

std::vector<MismatchTrace> traces_of(const Study& study, const std::vector<Playback>& before,
                                     const std::vector<Playback>& after) {
  std::vector<MismatchTrace> traces;
  for (std::size_t r = 0; r < before.size(); ++r) {
    const MotorTrace& t = study.held_out.traces[r];
    MismatchTrace trace{t.file,
                        t.start,
                        t.dt,
                        study.held_out.scored_from[r],
                        {t.u.begin(), t.u.end()},
                        {t.x1.begin(), t.x1.end()},
                        before[r].free,
                        {},
                        before[r].torque,
                        {},
                        before[r].mode,
                        {t.stamps.begin(), t.stamps.end()}};
    trace.encoder = study.sheet.structure.reads_load() ? EncoderSide::kLoad : EncoderSide::kMotor;
    if (t.command != nullptr) {
      trace.target = part_of(t.command->target, t);
      if (is_supplied(*t.command)) trace.supply = part_of(t.command->supply, t);
    }
    if (r < after.size()) trace.error_after = after[r].free, trace.torque_after = after[r].torque;
    traces.push_back(std::move(trace));
  }
  return traces;
}

DiagnosisVerdict verdict_of(const FirstSearch& found, const Additions& added) {
  if (found.candidates.empty() && at_floor(found.before)) return DiagnosisVerdict::kNone;
  return added.accepted ? DiagnosisVerdict::kEffect : DiagnosisVerdict::kUnknown;
}

std::vector<std::string> names_of(const std::vector<const EffectEntry*>& entries) {
  std::vector<std::string> names;
  for (const EffectEntry* entry : entries) names.push_back(entry->name);
  return names;
}

/// NaN: there is no error budget.
double band_of(const FirstSearch& found) { return found.budget ? found.budget->band.hz : kNaN; }

/// Up to which a torque was looked for: the band of the error budget, else what the observer passes that
/// follows lines over the position, and no more than the samples show [Hz].
double highest_looked_at(const Study& study, double band_hz) {
  double highest = std::isnan(band_hz) ? kMeasure.ripple_hz : band_hz;
  for (const MotorTrace& t : study.held_out.traces) highest = std::min(highest, 0.5 / t.dt);
  return highest;
}

MismatchPlace place_left_by(const Study& study, const ReferenceModel& model, double band_hz) {
  const double km = model.parameters[place::kTorqueConstant].value;
  const auto played = play(model, study.held_out, study.observer_hz, true);
  return place_of(played, study.held_out, km, study.options.coordinates, nullptr, band_hz);
}

/// @param after the model that the step has led to
DiagnosisStep step_of(const Study& study, const FurtherStep& step, const ScoredModel& after, bool added,
                      double band_hz) {
  DiagnosisStep s;
  for (const ModelEffect& e : step.before.fitted.model.effects) s.on_top_of.push_back(e.entry->name);
  if (step.candidates.empty()) return s;
  s.effect = step.candidates.front().entry->name;
  s.accepted = added && step.decision.accepted;
  s.dropped = names_of(step.dropped);
  s.mismatch = mismatch_size(study, step.before, after);
  s.ranking = ranking_of(study, step.before, step.candidates, step.decision);
  if (!s.accepted) return s;
  s.group = names_of(step.decision.group);
  s.left = place_left_by(study, after.fitted.model, band_hz);
  return s;
}

void tell_steps(const Study& study, const Additions& added, double band_hz, Diagnosis& d) {
  for (const Addition& effect : added.effects)
    if (added.accepted) d.effects.push_back(effect.entry->name);
  if (added.accepted) d.group = names_of(added.effects.front().group);
  for (std::size_t i = 0; i < added.steps.size(); ++i) {
    const bool last = i + 1 == added.steps.size();
    const bool taken = added.steps[i].decision.accepted || added.steps[i].candidates.empty();
    const ScoredModel& after = !last   ? added.steps[i + 1].before
                               : taken ? added.after
                                       : added.steps[i].candidates.front();
    d.steps.push_back(step_of(study, added.steps[i], after, added.accepted, band_hz));
  }
}

/// What each accepted step takes, by the measure of the whole; a step that made others superfluous has none.
void tell_added(const Study& study, const ScoredModel& nominal, const Additions& additions,
                const ReferenceModel& told, Diagnosis& d) {
  const bool one_each =
      additions.effects.size() == d.effects.size() && d.steps.size() + 1 >= d.effects.size();
  for (std::size_t i = 0; i < additions.effects.size(); ++i) {
    const Addition& effect = additions.effects[i];
    AddedEffect a;
    a.effect = effect.entry->name;
    a.established = true;
    a.group = names_of(effect.group);
    a.parameters = values_in(told, *effect.entry);
    const bool alone = additions.steps.empty() || !additions.steps.front().decision.accepted;
    const MismatchSize size = i > 0   ? (one_each ? d.steps[i - 1].mismatch : MismatchSize{})
                              : alone ? d.mismatch
                              : has_effect(additions.steps.front().before.fitted.model, effect.entry)
                                  ? mismatch_size(study, nominal, additions.steps.front().before)
                                  : MismatchSize{};  // it has taken the place of the first one
    a.shrink = size.shrink, a.shrink_ci95 = size.shrink_ci95;
    if (i + 1 == additions.effects.size()) a.after_torque = d.mismatch.after_torque;
    d.added.push_back(std::move(a));
  }
}

/// The size of the mismatch in torque as the observer's residual shows it.
void tell_torque(const Study& study, double torque_constant, Diagnosis& d) {
  if (d.measures.empty()) return;  // the motion of a model diverges
  const MismatchMeasure& torque = d.measures.back();
  d.mismatch.before_torque = torque.before, d.mismatch.after_torque = torque.after;
  double square = 0.0, samples = 0.0;
  for (const MotorTrace& t : study.held_out.traces)
    for (const double u : t.u) square += u * u, samples += 1.0;
  d.mismatch.input_torque = torque_constant * std::sqrt(square / samples);
}

/// They were learned on drives whose candidates' own refits decide, above the encoder's floor.
void forget_probabilities(Diagnosis& d) {
  d.outside_probability = kNaN;
  for (RankedEffect& r : d.ranking) r.probability = kNaN;
  for (DiagnosisStep& s : d.steps)
    for (RankedEffect& r : s.ranking) r.probability = kNaN;
}

/// What goes before the first addition in a ranking by free runs, where the error budget has decided.
void mark_undecided(Diagnosis& d) {
  for (RankedEffect& r : d.ranking) {
    if (r.effect == d.effects.front()) return;
    if (contains(d.effects, r.effect)) continue;
    r.remark += r.remark.empty() ? "" : "; ";
    r.remark += "ranks here by its free run alone, on which the verdict does not rest";
  }
}

/// What does not depend on how the additions were found.
/// @param first the effect that was added first, as it was fitted alone; nullptr: none
void tell_models(const Study& study, const FirstSearch& found, const ScoredModel& nominal,
                 const ScoredModel& after, const ModelEffect* first, Diagnosis& d) {
  const bool added = first != nullptr;
  d.observer_hz = study.observer_hz;
  if (added) d.blame = blame_of(nominal, after);
  d.ranking = ranking_of(study, found.before, found.candidates, found.decision);
  d.nominal = nominal.fitted.model, d.fitted = after.fitted.model;
  const double km = d.fitted.parameters[place::kTorqueConstant].value;
  const auto before_played = play(nominal.fitted.model, study.held_out, study.observer_hz, true);
  const auto after_played = added ? play(d.fitted, study.held_out, study.observer_hz, true) : before_played;
  d.periodic = periodic_torques(study, d.fitted, after_played);
  if (!found.candidates.empty())
    d.outside_probability =
        probability_shares(found.candidates, found.decision, study.options.known.outside_catalogue).outside;
  d.mismatch = mismatch_size(study, nominal, after);
  d.undetermined = undetermined_by(study, d.fitted);
  d.measures = measures_of(study, before_played, after_played);
  const double band = band_of(found);
  d.where = place_of(before_played, study.held_out, km, study.options.coordinates, first, band);
  d.remaining = place_of(after_played, study.held_out, km, study.options.coordinates, nullptr, band);
  d.traces = traces_of(study, before_played, after_played);
  tell_torque(study, km, d);
  if (found.budget) tell_budget(study, *found.budget, d);
  d.looked_at_hz = {0.0, highest_looked_at(study, band)};
  tell_whole_runs(study, nominal.fitted.model, added, d);
  d.as_configured = as_configured(study);
  if (found.budget || study.repeats_badly()) forget_probabilities(d);
}

}  // namespace

Diagnosis report_back(const Study& study, const FirstSearch& found, const Additions& additions) {
  Diagnosis d;
  d.verdict = verdict_of(found, additions);
  const bool added = d.verdict == DiagnosisVerdict::kEffect;
  const Study whole = of_all(study);
  const ScoredModel told = settled(whole, on_all(whole, added ? additions.after : found.before));
  const ScoredModel nominal = added ? on_all(whole, nominal_of(found, additions)) : told;
  tell_steps(study, additions, band_of(found), d);
  tell_models(whole, found, nominal, told, added ? &first_effect(found, additions) : nullptr, d);
  if (added) tell_added(study, nominal, additions, told.fitted.model, d);
  tell_intervals(whole, told.fitted, nominal.fitted.model, d);
  d.rivals = open_question(found, additions);
  return d;
}

namespace {

/// The model with what was added, in order.
Diagnosis report_added(const Study& whole, const FirstSearch& found, const ScoredModel& after,
                       std::vector<AddedEffect> added) {
  Diagnosis d;
  d.verdict = added.front().established ? DiagnosisVerdict::kEffect : DiagnosisVerdict::kHelps;
  for (const AddedEffect& a : added) d.effects.push_back(a.effect);
  d.group = added.front().group;
  d.added = std::move(added);
  const EffectEntry* first = find_effect(d.effects.front());
  const auto& fitted = after.fitted.model.effects;
  const auto at = std::find_if(fitted.begin(), fitted.end(), [&](const ModelEffect& e) {
    return e.entry == first || contained_effect(*e.entry) == first;
  });
  const ScoredModel nominal = on_all(whole, found.before);
  tell_models(whole, found, nominal, after, at == fitted.end() ? nullptr : &*at, d);
  d.balanced = after.fitted.balanced;
  tell_intervals(whole, after.fitted, nominal.fitted.model, d);
  return d;
}

/// With its numbers where they settle; what free runs leave nothing of is taken out, and the rest settles
/// anew.
TorqueSearch settled_ladder(const Study& whole, TorqueSearch ladder) {
  for (;;) {
    TorqueSearch told{ladder.added, settled(whole, on_all(whole, ladder.after))};
    TorqueSearch left = told;
    drop_what_vanished(ladder.after.fitted.model, left);
    if (left.added.size() == told.added.size()) return told;
    if (left.added.empty()) return left;
    ladder = std::move(left);
    ladder.after.fitted.errors.reset();  // of the numbers that went, too
    ladder.after.fitted.disagreements.clear();
  }
}

}  // namespace

Diagnosis report_ladder(const Study& study, const FirstSearch& found, const TorqueSearch& ladder) {
  const Study whole = of_all(study);
  const TorqueSearch told = settled_ladder(whole, ladder);
  if (told.added.empty()) return report_back(study, found, {});
  Diagnosis d = report_added(whole, found, told.after, added_effects(*found.budget, told));
  mark_undecided(d);
  return d;
}

Diagnosis report_help(const Study& study, const FirstSearch& found) {
  const Study whole = of_all(study);
  const ScoredModel best = settled(whole, on_all(whole, found.candidates.front()));
  AddedEffect a;
  a.effect = best.entry->name;
  a.group = names_of(found.decision.group);
  a.parameters = values_in(best.fitted.model, *best.entry);
  Diagnosis d = report_added(whole, found, best, {a});
  d.added.front().shrink = d.mismatch.shrink, d.added.front().shrink_ci95 = d.mismatch.shrink_ci95;
  d.added.front().after_torque = d.mismatch.after_torque;
  d.rivals = open_question(found, {});
  return d;
}

}  // namespace gapscope::internal::diagnosis
