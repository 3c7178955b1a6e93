#include "gapscope/simulation/excitation.h"

#include <fmt/format.h>

#include <cmath>

namespace gapscope {
namespace {

constexpr double kLowestFrequency = 1e-6;
constexpr double kHighestFrequency = 1e6;
constexpr double kLargest = 1e9;
constexpr double kLongest = 1e6;

constexpr ExcitationKindSpec kKinds[] = {
    {ExcitationKind::kSine, "sine", "amplitude sin(2 pi frequency t + phase)"},
    {ExcitationKind::kMultisine, "multisine",
     "equally strong sines from low to high, random phases from the seed, scaled to its peak"},
    {ExcitationKind::kSweptSine, "swept_sine",
     "one sine whose frequency goes from start to stop over the duration"},
    {ExcitationKind::kTriangle, "triangle", "straight flanks 0, +amplitude, 0, -amplitude, 0"},
    {ExcitationKind::kTrapezoid, "trapezoid",
     "zero, flank, +amplitude, flank, zero, flank, -amplitude, flank"},
    {ExcitationKind::kSteps, "steps", "random levels from the seed, each held for a while"},
    {ExcitationKind::kRecorded, "recorded",
     "the input of a recording, sampled at the rate of the simulation"},
};

void sine_fields(Excitation& e, FieldVisitor& v) {
  v.field({"frequency", "Hz", "frequency", kLowestFrequency, kHighestFrequency}, e.frequency);
  v.field({"phase", "rad", "phase at t = 0", -100.0, 100.0}, e.phase);
}

void multisine_fields(Excitation& e, FieldVisitor& v) {
  v.field({"low", "Hz", "lowest line", kLowestFrequency, kHighestFrequency}, e.low);
  v.field({"high", "Hz", "highest line", kLowestFrequency, kHighestFrequency}, e.high);
  v.field({"lines", "", "number of sines", 1, 1000}, e.lines);
  v.field({"period", "s", "every line is a multiple of 1/period; 0: the whole duration", 0.0, kLongest},
          e.period);
}

void swept_sine_fields(Excitation& e, FieldVisitor& v) {
  v.field({"start_frequency", "Hz", "frequency at t = 0", kLowestFrequency, kHighestFrequency},
          e.start_frequency);
  v.field({"stop_frequency", "Hz", "frequency at the end", kLowestFrequency, kHighestFrequency},
          e.stop_frequency);
  v.field({"logarithmic", "", "equal time for each octave instead of each hertz"}, e.logarithmic);
}

void trapezoid_fields(Excitation& e, FieldVisitor& v) {
  v.field({"frequency", "Hz", "frequency", kLowestFrequency, kHighestFrequency}, e.frequency);
  v.field({"dwell", "-", "share of the period at zero, half of it at either reversal", 0.0, 0.95}, e.dwell);
  v.field({"rise", "-", "share of the period for each of the four flanks", 0.0, 0.25}, e.rise);
}

void steps_fields(Excitation& e, FieldVisitor& v) {
  v.field({"hold", "s", "time on each level", 1e-6, kLongest}, e.hold);
  v.field({"levels", "", "number of equally spaced levels from -amplitude to amplitude", 2, 1000000},
          e.levels);
}

std::string too_fast(const char* key, double frequency, double rate) {
  if (frequency < 0.5 * rate) return "";
  return fmt::format("{} is {} Hz, expected less than half the sampling rate of {} Hz", key, frequency, rate);
}

std::string multisine_problem(const Excitation& e, double rate, double duration) {
  if (e.low > e.high) return fmt::format("low is {} Hz and high {} Hz, expected low <= high", e.low, e.high);
  if (const std::string fast = too_fast("high", e.high, rate); !fast.empty()) return fast;
  const double period = e.period > 0.0 ? e.period : duration;
  const double first = std::max(1.0, std::round(e.low * period)), last = std::round(e.high * period);
  if (last - first + 1.0 >= e.lines) return "";
  return fmt::format(
      "{} lines between {} and {} Hz, expected at most {} because lines are multiples of 1/period = {:.6g} Hz",
      e.lines, e.low, e.high, std::max(0.0, last - first + 1.0), 1.0 / period);
}

std::string trapezoid_problem(const Excitation& e, double rate) {
  if (e.dwell / 2.0 + 2.0 * e.rise <= 0.5) return too_fast("frequency", e.frequency, rate);
  return fmt::format("dwell {} and four flanks of {} fill more than the period, expected dwell + 4 rise <= 1",
                     e.dwell, e.rise);
}

void recorded_fields(Excitation& e, FieldVisitor& v) {
  v.field({"file", "", "recording (CSV), relative to the configuration"}, e.file);
  v.field({"time", "", "its column of the time [s]"}, e.time_column);
  v.field({"input", "", "its column of the input"}, e.input_column);
  v.field({"voltage", "", "its column of the supply's voltage, beside a controller"}, e.voltage_column);
}

}  // namespace

std::span<const ExcitationKindSpec> excitation_kinds() { return kKinds; }

const char* to_string(ExcitationKind kind) {
  for (const ExcitationKindSpec& spec : kKinds)
    if (spec.kind == kind) return spec.name;
  return "";
}

void Excitation::fields(FieldVisitor& v) {
  if (kind == ExcitationKind::kRecorded) return recorded_fields(*this, v);
  v.field({"amplitude", "unit of u", "peak of the input, without the offset", 0.0, kLargest}, amplitude);
  switch (kind) {
    case ExcitationKind::kSine:
      sine_fields(*this, v);
      break;
    case ExcitationKind::kMultisine:
      multisine_fields(*this, v);
      break;
    case ExcitationKind::kSweptSine:
      swept_sine_fields(*this, v);
      break;
    case ExcitationKind::kTriangle:
      v.field({"frequency", "Hz", "frequency", kLowestFrequency, kHighestFrequency}, frequency);
      break;
    case ExcitationKind::kTrapezoid:
      trapezoid_fields(*this, v);
      break;
    case ExcitationKind::kSteps:
      steps_fields(*this, v);
      break;
    case ExcitationKind::kRecorded:
      break;
  }
  v.field({"offset", "unit of u", "added to everything", -kLargest, kLargest}, offset);
}

std::string excitation_problem(const Excitation& e, double rate, double duration) {
  switch (e.kind) {
    case ExcitationKind::kSine:
    case ExcitationKind::kTriangle:
      return too_fast("frequency", e.frequency, rate);
    case ExcitationKind::kMultisine:
      return multisine_problem(e, rate, duration);
    case ExcitationKind::kSweptSine: {
      const std::string start = too_fast("start_frequency", e.start_frequency, rate);
      return !start.empty() ? start : too_fast("stop_frequency", e.stop_frequency, rate);
    }
    case ExcitationKind::kTrapezoid:
      return trapezoid_problem(e, rate);
    case ExcitationKind::kSteps:
      return "";
    case ExcitationKind::kRecorded:
      return e.file.empty() ? "has no file, expected the name of a recording (CSV)" : "";
  }
  return "";
}

}  // namespace gapscope
