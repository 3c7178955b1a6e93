#include "diagnosis/experiment_library.h"

#include <fmt/format.h>

#include <cmath>

namespace gapscope {
namespace internal::diagnosis {
namespace {

constexpr double kSmall = 0.4;    ///< of the largest input
constexpr double kOneWay = 0.6;   ///< share of the input that is a constant push
constexpr double kDwell = 0.4;    ///< of the period
constexpr int kLevels = 9;        ///< of the steps
constexpr double kPerHold = 4.0;  ///< levels that the steps hold in a period of the middle frequency

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
  Excitation one_way = periodic(ExcitationKind::kSine, (1.0 - kOneWay) * peak, middle);
  one_way.offset = kOneWay * peak;
  Excitation resting = periodic(ExcitationKind::kTrapezoid, peak, low);
  resting.dwell = kDwell;
  Excitation steps;
  steps.kind = ExcitationKind::kSteps;
  steps.amplitude = peak;
  steps.levels = kLevels;
  steps.hold = 1.0 / (kPerHold * middle);
  return {periodic(ExcitationKind::kSine, peak, low),
          periodic(ExcitationKind::kSine, peak, middle),
          periodic(ExcitationKind::kSine, peak, high),
          periodic(ExcitationKind::kSine, kSmall * peak, low),
          periodic(ExcitationKind::kSine, kSmall * peak, middle),
          periodic(ExcitationKind::kTriangle, peak, low),
          band(ExcitationKind::kSweptSine, peak, limits),
          band(ExcitationKind::kSweptSine, kSmall * peak, limits),
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
