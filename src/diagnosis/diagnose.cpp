#include "diagnosis/diagnose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/cut_short.h"
#include "base/require.h"
#include "diagnosis/detectable.h"
#include "diagnosis/evidence.h"
#include "diagnosis/further.h"
#include "diagnosis/limits_of_any_model.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/motion.h"
#include "diagnosis/step.h"
#include "diagnosis/verdict.h"
#include "gapscope/base/errors.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

ScoredModel scored_nominal(const Study& study) {
  return judge(nullptr, fit_nominal(study.train, study.sheet, study.options.fit, study.observer_hz),
               study.held_out, study.observer_hz);
}

/// The nominal model where one set of numbers is at the floor on all recordings.
///
/// A fit leaves undetermined what its recordings do not ask for, and may miss others by that alone. Then
/// nothing is missing, as long as the other numbers explain what was fitted as well as the fit did.
std::optional<ScoredModel> explained_together(const Study& study, const ScoredModel& nominal) {
  if (!(nominal.fitted.mean_cost < kRule.near_floor)) return {};
  const double hz = study.observer_hz;
  const std::vector<MotorTrace> all = everything(study);
  HeldOut own = fitted_as_held_out(study);
  add_supply_steps(nominal.fitted.model, hz, own);
  const double alone = judge(nullptr, nominal.fitted, own, hz).score;
  const auto explains = [&](const ScoredModel& held_out) {
    if (!at_floor(held_out)) return false;
    const ScoredModel fitted = judge(nullptr, held_out.fitted, own, hz);
    return at_floor(fitted) && fitted.score < alone + kRule.indistinct;
  };
  ScoredModel together =
      judge(nullptr, fit_near(all, nominal.fitted.model, study.options.fit, hz), study.held_out, hz);
  if (explains(together)) return together;
  const FittedModel other = fit_nominal(study.held_out.traces, study.sheet, study.options.fit, hz);
  together = judge(nullptr, other, study.held_out, hz);
  if (explains(together)) return together;
  together = judge(nullptr, fit_near(all, other.model, study.options.fit, hz), study.held_out, hz);
  if (explains(together)) return together;
  return {};
}

/// On what is held out, else on what was fitted.
Repeatability repeatability(const Study& study, const ReferenceModel& model) {
  const Repeatability seen =
      repeatability_of(play(model, study.held_out, study.observer_hz, false), study.held_out);
  if (!std::isnan(seen.innovation)) return seen;
  const HeldOut own = fitted_as_held_out(study);
  return repeatability_of(play(model, own, study.observer_hz, false), own);
}

/// Whether the drive's own repetition is the floor; then the study is changed to that.
bool take_repeatability(Study& study, const ScoredModel& nominal) {
  HeldOut& held = study.held_out;
  const Repeatability seen = repeatability(study, nominal.fitted.model);
  const double floor = *std::max_element(held.floors.begin(), held.floors.end());
  if (!(seen.innovation > kRule.far * floor) || !seen.stationary) return false;
  study.observer_hz = kMeasure.fast_hz;
  const Repeatability fast =
      repeatability(study, fit_nominal(study.train, study.sheet, study.options.fit, kMeasure.fast_hz).model);
  held.innovation_repeats = fast.innovation, held.free_repeats = fast.free;
  held.repeats_in = fast.read_from;
  return true;
}

/// The nominal model from the drive of the best candidate, where that leads to a far better fit: the first
/// one had ended in a minimum that the best candidate, not its effect, has left.
std::optional<ScoredModel> nominal_near(const Study& study, const FirstSearch& found) {
  if (found.candidates.empty() || !std::isfinite(found.candidates.front().score)) return {};
  const ReferenceModel& best = found.candidates.front().fitted.model;
  ReferenceModel model = found.before.fitted.model;
  model.parameters = best.parameters, model.controller = best.controller;
  FittedModel fitted = fit_near(study.train, model, study.options.fit, study.observer_hz);
  if (!(fitted.mean_cost < study.effort.far_better * found.before.fitted.mean_cost)) return {};
  return judge(nullptr, std::move(fitted), study.held_out, study.observer_hz);
}

/// The simpler effect that the first candidate contains, where it is none itself.
const EffectEntry* excluded_parent(const Study& study, const std::vector<ScoredModel>& ranked) {
  const EffectEntry* parent = ranked.empty() ? nullptr : contained_effect(*ranked.front().entry);
  return std::ranges::find(study.catalogue, parent) == study.catalogue.end() ? parent : nullptr;
}

FirstSearch first_look(Study& study) {
  FirstSearch found;
  study.work_before = *study.options.fit.work;
  study.options.progress("fitting the nominal model");
  found.before = scored_nominal(study);
  if (add_supply_steps(found.before.fitted.model, study.observer_hz, study.held_out))
    found.before = judge(nullptr, found.before.fitted, study.held_out, study.observer_hz);
  study.options.progress("weighing torques");
  found.budget = torque_budget(study, found.before.fitted.model);
  if (at_floor(found.before) || finish_requested()) return found;
  if (std::optional<ScoredModel> together = explained_together(study, found.before)) {
    found.alone = std::max(found.before.median_free, found.before.median_innovation);
    found.before = std::move(*together), study.train = everything(study), study.all.clear();
    return found;
  }
  const HeldOut by_encoder = study.held_out;
  if (take_repeatability(study, found.before)) {
    ScoredModel repeated = scored_nominal(study);
    if (at_floor(repeated)) {  // what does not repeat is all there is, and that is no model's
      study.held_out = by_encoder;
      study.observer_hz = kMeasure.slow_hz;
    } else {
      found.before = std::move(repeated);
    }
  }
  if (found.budget && rests_on_balance(*found.budget, found.before.fitted.model)) return found;
  if (finish_requested()) return found;
  const auto catalogue = found.budget ? worth_refitting(study, *found.budget) : study.catalogue;
  found.candidates = candidates_of(study, found.before, catalogue);
  if (auto better = unless_finishing([&] { return nominal_near(study, found); }).value_or(std::nullopt)) {
    found.before = std::move(*better);
    found.candidates.clear();
    if (at_floor(found.before)) return found;
    found.candidates = candidates_of(study, found.before, catalogue);
  }
  if (const EffectEntry* parent = excluded_parent(study, found.candidates))
    found.excluded_parents = candidates_of(study, found.before, {parent});
  const auto decide = found.budget ? decide_among_equals : decide_alone;
  found.decision = decide(found.candidates, found.before, study.reach(), found.excluded_parents, kRule);
  return found;
}

/// Mean square that the best fit leaves of what was fitted [floor²].
double least_left(const FirstSearch& found) {
  double least = found.before.fitted.mean_cost;
  for (const ScoredModel& c : found.candidates) least = std::min(least, c.fitted.mean_cost);
  return least;
}

/// Whether the recordings that were fitted are explained while those held out are not: they do not ask for
/// what the others need, neither of the drive nor of the effect.
bool asked_too_little(const Study& study, const FirstSearch& found) {
  if (found.candidates.empty() || !may_fit_half_of_the_held_out(study)) return false;
  const ScoredModel& best = found.candidates.front();
  if (at_floor(best)) return false;
  if (found.decision.accepted &&
      shrink_of(found.before.median_free, best.median_free) > 1.0 - kRule.all_of_cause)
    return false;
  return least_left(found) < kExplained;
}

/// The same of a search that has found nothing, where the others show far more than the fitted ones do.
bool asked_far_too_little(const Study& study, const FirstSearch& found) {
  if (found.candidates.empty() || !may_fit_half_of_the_held_out(study)) return false;
  const double least = least_left(found);
  return least < kRule.near_floor && leaves_far_more_held_out(found.candidates.front(), least);
}

/// What the fitted recordings leave open, for the reader.
std::string undetermined(const FirstSearch& found) {
  const std::string left = fmt::format(
      "what was fitted does not determine the model: it leaves {:.3g} encoder floors on what was held out",
      found.alone);
  if (found.candidates.empty()) return left + ", and none of it once these are fitted with them.";
  return left + "; their first half was fitted with the others, and the second half judges.";
}

/// With half of what is held out among what is fitted; nothing where the other half is not worth a judgement,
/// and the study stays as it was.
std::optional<FirstSearch> look_wider(Study& study, const FirstSearch& found) {
  const std::vector<MotorTrace> train = study.train, all = study.all;
  const HeldOut held_out = study.held_out;
  fit_half_of_the_held_out(study);
  FirstSearch wider = first_look(study);
  if (wider.candidates.empty() || study.repeats_badly()) {
    study.train = train, study.all = all, study.held_out = held_out, study.observer_hz = kMeasure.slow_hz;
    return {};
  }
  wider.alone = std::max(found.before.median_free, found.before.median_innovation);
  return wider;
}

/// The ladder of the torque balance, unless one effect explains all that the encoder shows.
TorqueSearch climb(const Study& study, const FirstSearch& found) {
  if (!found.budget || !found.budget->says_most) return {};
  if (found.candidates.empty() && at_floor(found.before)) return {};
  if (found.decision.accepted && at_floor(found.candidates.front()) && !study.repeats_badly()) return {};
  study.options.progress("refitting what leads in torque");
  return take_ladder(study, found.before, *found.budget);
}

/// Whether no further step could leave nothing: a drive that repeats itself badly has no floor that a model
/// could come to, unless what the balance knows comes near it.
bool is_beyond_steps(const Study& study, const ScoredModel& balanced) {
  return study.repeats_badly() && balanced.median_innovation > kTelling.clearly_more;
}

/// Whether the torque balance says most of the input and knows nothing that helps, while what the observers
/// favour stays off the floor: then they have only found numbers that hide what is missing.
bool contradicted(const FirstSearch& found, const Additions& added) {
  return found.budget && found.budget->says_most && !at_floor(added.after) && !added.explained;
}

/// Where hardly anything but noise moves x1, nothing seems to be missing.
void require_driven(const Study& study, const ScoredModel& model) {
  if (const std::string left = motion_left(study.held_out, model); !left.empty())
    throw ConfigError(study.held_out.traces.front().file,
                      "by this model u does not move x1: " + left +
                          ", expected the recording of a driven motion, and a model that is nearer to it");
}

}  // namespace

FirstSearch investigate(Study& study) {
  FirstSearch found = first_look(study);
  if (!finish_requested() && asked_too_little(study, found))
    if (std::optional<FirstSearch> wider = look_wider(study, found)) return std::move(*wider);
  return found;
}

EffectSearch search_effects(Study& study) {
  FirstSearch found = investigate(study);
  count_first_step(study, found.candidates.size());
  TorqueSearch ladder = climb(study, found);
  study.work_before = *study.options.fit.work;
  if (!ladder.added.empty() && (at_floor(ladder.after) || is_beyond_steps(study, ladder.after)))
    return {std::move(found), {}, std::move(ladder)};
  Additions added = add_further(study, found);
  // The balance sees what is slow; what leaves the encoder nothing to show is all there is.
  if (!ladder.added.empty() && !leaves_nothing(added)) return {std::move(found), {}, std::move(ladder)};
  added.accepted = added.accepted && !contradicted(found, added);
  if (added.accepted && added.wider)
    study.train = added.wider->train, study.held_out = added.wider->held_out, study.all.clear();
  if (added.accepted || study.is_exhausted() || !asked_far_too_little(study, found))
    return {std::move(found), std::move(added), {}};
  if (std::optional<FirstSearch> wider = look_wider(study, found)) {
    study.work_before = *study.options.fit.work;
    added = add_further(study, *wider);
    found = std::move(*wider);
  }
  return {std::move(found), std::move(added), {}};
}

}  // namespace internal::diagnosis

Diagnosis diagnose(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                   const ReferenceModel& model, const DiagnosisOptions& options) {
  using namespace internal::diagnosis;
  GAPSCOPE_REQUIRE(!train.empty());
  for (const auto& traces : {train, held_out})
    for (const MotorTrace& t : traces) require_motion(t);
  DiagnosisOptions counted = options;
  counted.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  Study study = make_study(train, held_out, model, counted);
  require_motion(study.held_out);
  auto [found, added, ladder] = search_effects(study);
  const bool exhausted = ladder.added.empty() && !leaves_nothing(added) && study.has_done_its_work();
  std::string left = added.accepted ? motion_left(study.held_out, added.after) : "";
  if (!left.empty()) added = {};
  Diagnosis diagnosis = verdict_on(study, found, added, ladder, left.empty());
  open_undetermined(diagnosis);
  if (!left.empty())
    diagnosis.warnings.push_back("no effect is named: with effects added, too, " + left + ".");
  if (diagnosis.verdict == DiagnosisVerdict::kNone) require_driven(study, found.before);
  diagnosis.evidence = evidence_of(study, found);
  if (finish_requested()) tell_stopped(added, !ladder.added.empty(), diagnosis);
  if (!finish_requested() && (options.known.detectable || diagnosis.effects.empty()))
    tell_detectable(study, found, diagnosis);
  if (!ladder.added.empty() && diagnosis.mismatch.after > diagnosis.mismatch.before)
    diagnosis.warnings.push_back(
        "with what was added the missing torque falls, but the error in x1 grows: a model whose inertia is "
        "too "
        "large hides in x1 what it lacks.");
  if (diagnosis.stopped)
    diagnosis.warnings.push_back(
        "the search was stopped before its end: this is what it had found by then. Further steps, free-form "
        "laws and the experiment that would decide were not looked for, and causes that hang on them stay "
        "open.");
  if (diagnosis.exhausted = exhausted && !diagnosis.stopped; diagnosis.exhausted)
    diagnosis.warnings.push_back(
        fmt::format("the search ended at its limit of work, {:.0f} steps like the first.",
                    study.effort.most_steps_of_work));
  if (held_out.empty())
    diagnosis.warnings.push_back(
        "judged on the last third of each file, which was not fitted, as no second recording is given (held_out): "
        "that is the same kind of excitation, and another one may name other effects, or in another order.");
  if (!study.judge_nothing.empty())
    diagnosis.warnings.push_back(
        fmt::format("too short for a last third that could judge, and therefore fitted whole: {}.",
                    fmt::join(study.judge_nothing, ", ")));
  if (std::isfinite(found.alone)) diagnosis.warnings.push_back(undetermined(found));
  if (added.accepted && added.wider)
    diagnosis.warnings.push_back(
        "the recordings that were fitted do not show all that the others do: for the later steps the first "
        "half of what was held out was fitted with them, and the second half judges.");
  if (added.accepted && added.explained)
    diagnosis.warnings.push_back(
        "the recordings that were fitted do not determine all numbers: what is left on those that were held "
        "out vanishes once these are fitted with them, without a further effect.");
  return diagnosis;
}

}  // namespace gapscope
