#include "diagnosis/experiment_library.h"

#include <fmt/format.h>

#include <cmath>

namespace gapscope {
namespace internal::diagnosis {
namespace {

Excitation periodic(ExcitationKind kind, double amplitude, double frequency) {
  Excitation e;
  e.kind = kind;
  e.amplitude = amplitude;
  e.frequency = frequency;
  return e;
}

Excitation band(ExcitationKind kind, double amplitude, const ExperimentLimits& limits) {
  Excitation e;
  e.kind = kind;
  e.amplitude = amplitude;
  e.low = e.start_frequency = limits.lowest_frequency;
  e.high = e.stop_frequency = limits.highest_frequency;
  e.logarithmic = true;
  return e;
}

}  // namespace

std::vector<Excitation> experiment_library(const ExperimentLimits& limits, double peak) {
  const double low = limits.lowest_frequency, high = limits.highest_frequency, middle = std::sqrt(low * high);
  Excitation one_way = periodic(ExcitationKind::kSine, 0.5 * peak, middle);
  one_way.offset = 0.5 * peak;
  Excitation resting = periodic(ExcitationKind::kTrapezoid, peak, low);
  resting.dwell = 0.5;
  Excitation steps;
  steps.kind = ExcitationKind::kSteps;
  steps.amplitude = peak;
  steps.hold = 0.5 / middle;
  return {periodic(ExcitationKind::kSine, peak, low),
          periodic(ExcitationKind::kSine, peak, middle),
          periodic(ExcitationKind::kSine, peak, high),
          periodic(ExcitationKind::kSine, 0.5 * peak, low),
          periodic(ExcitationKind::kSine, 0.5 * peak, middle),
          periodic(ExcitationKind::kTriangle, peak, low),
          band(ExcitationKind::kSweptSine, peak, limits),
          band(ExcitationKind::kSweptSine, 0.5 * peak, limits),
          band(ExcitationKind::kMultisine, peak, limits),
          resting,
          steps,
          one_way};
}

Excitation scaled(Excitation e, double share) {
  e.amplitude *= share;
  e.offset *= share;
  return e;
}

}  // namespace internal::diagnosis

void ExperimentLimits::fields(FieldVisitor& v) {
  v.field({"input", "unit of u", "largest |u|", 1e-12, 1e12}, input);
  v.field({"travel", "rad", "of the motor, peak to peak", 1e-12, 1e12}, travel);
  v.field({"lowest_frequency", "Hz", "of the input", 1e-3, 1e4}, lowest_frequency);
  v.field({"highest_frequency", "Hz", "of the input", 1e-3, 1e4}, highest_frequency);
  v.field({"duration", "s", "of the recording", 0.5, 3600.0}, duration);
}

std::string describe(const Excitation& e) {
  std::string name = to_string(e.kind);
  for (char& c : name)
    if (c == '_') c = ' ';
  std::string text =
      fmt::format("{} {} of {:.3g} units of u", name == "steps" ? "random" : "a", name, e.amplitude);
  if (std::isfinite(e.frequency)) text += fmt::format(" at {:.3g} Hz", e.frequency);
  if (std::isfinite(e.low)) text += fmt::format(" from {:.3g} to {:.3g} Hz", e.low, e.high);
  if (std::isfinite(e.hold)) text += fmt::format(", each held {:.3g} s", e.hold);
  if (e.dwell > 0.0) text += fmt::format(", at rest for {:.0f} % of the period", 100.0 * e.dwell);
  if (e.offset != 0.0) text += fmt::format(" on a constant {:.3g} units of u", e.offset);
  return text;
}

}  // namespace gapscope
