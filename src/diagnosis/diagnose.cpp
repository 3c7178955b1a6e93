#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/pipeline.h"
#include "diagnosis/repeatability.h"
#include "diagnosis/report_back.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/require.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "reference/rough_drive.h"

namespace gapscope {
namespace internal {
namespace {

constexpr double kBadRepetition = 10.0;    ///< floors of the encoder
constexpr double kTrainShare = 2.0 / 3.0;  ///< of each file, where nothing else is held out

void hold_out_the_last_third(std::span<const MotorTrace> files, Study& study) {
  for (const MotorTrace& file : files) {
    const auto cut = static_cast<std::size_t>(kTrainShare * static_cast<double>(file.size()));
    study.train.push_back(part(file, 0, cut));
    study.held_out.traces.push_back(file);
    study.held_out.scored_from.push_back(cut);
  }
}

}  // namespace

Study make_study(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                 const ReferenceModel& model, const DiagnosisOptions& options) {
  Study study{{}, {}, model, {}, kSlowHz, options};
  if (held_out.empty()) {
    hold_out_the_last_third(train, study);
  } else {
    study.train.assign(train.begin(), train.end());
    study.held_out.traces.assign(held_out.begin(), held_out.end());
    study.held_out.scored_from.assign(held_out.size(), 0);
  }
  for (const MotorTrace& t : study.held_out.traces) study.held_out.floors.push_back(encoder_floor(t));
  for (const MotorTrace& t : study.held_out.traces) study.held_out.periods.push_back(input_period(t));
  for (const std::string& name : options.excluded) GAPSCOPE_REQUIRE(find_effect(name) != nullptr);
  for (const EffectEntry* entry : effect_table())
    if (std::find(options.excluded.begin(), options.excluded.end(), entry->name) == options.excluded.end())
      study.catalogue.push_back(entry);
  return study;
}

namespace {

Judged judged_nominal(const Study& study) {
  return judge(nullptr, fit_nominal(study.train, study.sheet, study.options.fit, study.observer_hz),
               study.held_out, study.observer_hz);
}

HeldOut whole(const std::vector<MotorTrace>& traces) {
  HeldOut all;
  all.traces = traces;
  all.scored_from.assign(traces.size(), 0);
  for (const MotorTrace& t : traces) {
    all.floors.push_back(encoder_floor(t));
    all.periods.push_back(input_period(t));
  }
  return all;
}

/// On what is held out, else on what was fitted.
Repeatability repeatability(const Study& study, const FittedModel& model) {
  const Repeatability seen =
      repeatability_of(play(model, study.held_out, study.observer_hz, false), study.held_out);
  if (!std::isnan(seen.innovation)) return seen;
  const HeldOut own = whole(study.train);
  return repeatability_of(play(model, own, study.observer_hz, false), own);
}

/// Whether the drive's own repetition is the floor; then the study is changed to that.
bool take_repeatability(Study& study, const Judged& nominal) {
  HeldOut& held = study.held_out;
  const Repeatability seen = repeatability(study, nominal.fitted.model);
  const double floor = *std::max_element(held.floors.begin(), held.floors.end());
  if (!(seen.innovation > kBadRepetition * floor) || !seen.stationary) return false;
  study.observer_hz = kFastHz;
  const Repeatability fast =
      repeatability(study, fit_nominal(study.train, study.sheet, study.options.fit, kFastHz).model);
  held.innovation_repeats = fast.innovation, held.free_repeats = fast.free;
  return true;
}

/// The simpler effect that the first candidate contains, where it is none itself.
const EffectEntry* excluded_parent(const Study& study, const std::vector<Judged>& ranked) {
  const EffectEntry* parent = ranked.empty() ? nullptr : nested_parent(*ranked.front().entry);
  const auto& all = study.catalogue;
  return std::find(all.begin(), all.end(), parent) == all.end() ? parent : nullptr;
}

}  // namespace

Findings investigate(Study& study) {
  Findings found;
  study.options.progress("fitting the nominal model");
  found.before = judged_nominal(study);
  if (at_floor(found.before)) return found;
  const HeldOut by_encoder = study.held_out;
  if (take_repeatability(study, found.before)) {
    Judged repeated = judged_nominal(study);
    if (at_floor(repeated)) {  // what does not repeat is all there is, and that is no model's
      study.held_out = by_encoder;
      study.observer_hz = kSlowHz;
    } else {
      found.before = std::move(repeated);
    }
  }
  found.candidates = candidates_of(study, found.before, study.catalogue);
  if (const EffectEntry* parent = excluded_parent(study, found.candidates))
    found.excluded_parents = candidates_of(study, found.before, {parent});
  found.decision = decide(found.candidates, found.before, study.repeats_badly(), found.excluded_parents);
  return found;
}

}  // namespace internal

Diagnosis diagnose(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                   const ReferenceModel& model, const DiagnosisOptions& options) {
  using namespace internal;
  GAPSCOPE_REQUIRE(!train.empty());
  Study study = make_study(train, held_out, model, options);
  const Findings found = investigate(study);
  Diagnosis diagnosis = report_back(study, found);
  if (held_out.empty())
    diagnosis.warnings.push_back(
        "no recording is held out: the last third of each file was, which tests the model on the same kind "
        "of "
        "excitation only.");
  return diagnosis;
}

}  // namespace gapscope
