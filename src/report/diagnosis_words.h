#pragma once

#include <string>

#include "base/text.h"
#include "report/figure_data.h"
#include "report/wording.h"
#include "results/diagnosis_result.h"

/// What the figures of a diagnosis call things.
namespace gapscope::internal::report {

/// The trace that they show; nullptr: there is none.
inline const MismatchTrace* shown_trace(const DiagnosisResult& r) {
  const auto& traces = r.diagnosis.traces;
  return traces.empty() || traces.front().x1.size() < 2 ? nullptr : &traces.front();
}

inline std::string length_unit(const DiagnosisResult& r) { return r.coordinates.position_unit(); }
inline std::string torque_unit_of(const DiagnosisResult& r) { return r.coordinates.shown_unit("N m"); }
inline std::string torque_word(const DiagnosisResult& r) { return r.coordinates.torque_word(); }
/// Short where the unit needs a word: it stands beside a frame that is not high.
inline Axis correction_axis(const DiagnosisResult& r) {
  const std::string note = torque_note(r.input);
  return {
      note.empty() ? "correcting " + torque_word(r) : "correction", torque_unit_of(r), {}, {}, {}, {}, note};
}
inline bool reads_load(const DiagnosisResult& r) {
  return !r.diagnosis.traces.empty() && r.diagnosis.traces.front().encoder == EncoderSide::kLoad;
}
inline std::string angle_word(const DiagnosisResult& r) {
  if (!r.coordinates.rotational()) return "displacement";
  return reads_load(r) ? "load angle" : "motor angle";
}
inline std::string position_name(const DiagnosisResult& r) { return reads_load(r) ? "$x_2$" : "$x_1$"; }
inline bool added(const DiagnosisResult& r) { return !r.diagnosis.effects.empty(); }

/// What the model has been given: its one effect, or all of them.
inline std::string with_added(const DiagnosisResult& r) {
  const auto& effects = r.diagnosis.effects;
  return effects.size() == 1 ? "with " + readable(effects.front()) : "with all that was added";
}

/// The unit of u, as it was declared.
inline std::string input_unit(const DiagnosisResult& r) {
  return r.input && !r.input->unit.empty() ? r.coordinates.shown_unit(r.input->unit) : "units of $u$";
}

}  // namespace gapscope::internal::report
