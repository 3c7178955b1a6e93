#include "diagnosis/report_back.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/mismatch_size.h"
#include "diagnosis/where.h"
#include "diagnosis/words.h"

namespace gapscope::internal {
namespace {

std::vector<NamedValue> effect_values(const ModelEffect& effect) {
  std::vector<NamedValue> values;
  for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i) {
    const EffectParameterSpec& spec = effect.entry->parameters[i];
    double value = effect.parameters[i].value;
    if (spec.key == std::string("phase_rad")) value = std::remainder(value, 2.0 * kPi);
    values.push_back({spec.key, spec.unit, value});
  }
  return values;
}

std::vector<RankedEffect> ranking_of(const Study& study, const Findings& found) {
  std::vector<RankedEffect> ranking;
  const double floor = judged_floor(study);
  const auto windows = judged_windows(study);
  const double before = median_size(found.before.windows.*windows);
  double weights = 0.0;
  for (const Judged& c : found.candidates) weights += weight_of(c, found.candidates.front());
  for (const Judged& c : found.candidates) {
    RankedEffect r;
    r.effect = c.entry->name;
    r.score = c.score;
    r.rel = relative_gain(found.before, c);
    r.windows_better = share_of_windows_better(found.before, c);
    if (std::isfinite(c.score)) {
      const double size = median_size(c.windows.*windows);
      r.held_out = floor * size;
      r.shrink = shrink_of(before, size);
    }
    r.probability = found.decision.probability * weight_of(c, found.candidates.front()) / weights;
    if (!c.fitted.model.effects.empty()) r.parameters = effect_values(c.fitted.model.effects.back());
    r.remark = remark_on(c, found.before);
    ranking.push_back(r);
  }
  return ranking;
}

std::vector<BlameShift> blame_of(const Judged& before, const Judged& after) {
  std::vector<BlameShift> blame;
  for (std::size_t i = 0; i < kDriveParameterCount; ++i) {
    const ParameterSetting& p = before.fitted.model.parameters[i];
    if (p.estimate)
      blame.push_back({kDriveParameters[i].key, kDriveParameters[i].unit, p.value,
                       after.fitted.model.parameters[i].value});
  }
  return blame;
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
                        before[r].mode};
    if (r < after.size()) trace.error_after = after[r].free, trace.torque_after = after[r].torque;
    traces.push_back(std::move(trace));
  }
  return traces;
}

DiagnosisVerdict verdict_of(const Findings& found) {
  if (found.candidates.empty() && at_floor(found.before)) return DiagnosisVerdict::kNone;
  return found.decision.accepted ? DiagnosisVerdict::kEffect : DiagnosisVerdict::kUnknown;
}

}  // namespace

Diagnosis report_back(const Study& study, const Findings& found) {
  Diagnosis d;
  d.verdict = verdict_of(found);
  d.observer_hz = study.observer_hz;
  const bool added = d.verdict == DiagnosisVerdict::kEffect;
  const Judged& after = added ? found.candidates.front() : found.before;
  if (added) {
    d.effects = {after.entry->name};
    for (const EffectEntry* entry : found.decision.group) d.group.push_back(entry->name);
    d.blame = blame_of(found.before, after);
  }
  d.ranking = ranking_of(study, found);
  d.fitted = after.fitted.model;
  const double km = d.fitted.parameters[place::kTorqueConstant].value;
  const auto before_played = play(found.before.fitted.model, study.held_out, study.observer_hz, true);
  const auto after_played = added ? play(d.fitted, study.held_out, study.observer_hz, true) : before_played;
  d.gap = mismatch_size(study, found.before, after);
  d.measures = measures_of(study, before_played, after_played);
  d.where = place_of(before_played, study.held_out, km, study.options.rotation,
                     added ? &d.fitted.effects.back() : nullptr);
  d.remaining = place_of(after_played, study.held_out, km, study.options.rotation, nullptr);
  d.traces = traces_of(study, before_played, after_played);
  d.sentence = sentence_of(d, study.options.rotation);
  return d;
}

}  // namespace gapscope::internal
