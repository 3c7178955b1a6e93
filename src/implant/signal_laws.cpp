// What the command and the encoder do to the numbers that are recorded: each by the inverse of its law in u,
// or by its law in the readings.
#include <algorithm>
#include <cmath>

#include "implant/drawn_shape.h"

namespace gapscope::internal::implant {
namespace {

constexpr double kLostEvery = 3.0;  ///< counts are lost about so often [s]

using Column = std::vector<double>;

/// Km u (1 + ratio · wave), the wave meant over the step.
Column ripple(const Subject& s, const Values& v, std::mt19937_64&) {
  Column u = s.recording->u;
  for (std::size_t i = 0; i < u.size(); ++i) {
    double sum = 0.0;
    for (int k = 0; k < kPointsOfStep; ++k)
      sum += skewed_sine(v[1] * s.motion.between(i, (k + 0.5) / kPointsOfStep).x + v[2]);
    u[i] /= 1.0 + v[0] * sum / kPointsOfStep;
  }
  return u;
}
SizeRange ripple_range(const CaseScale&) { return {1e-6, 0.9}; }

/// What acts is knee · tanh(u/knee).
Column saturation(const Subject& s, const Values& v, std::mt19937_64&) {
  Column u = s.recording->u;
  for (double& value : u) value = v[0] * std::atanh(value / v[0]);
  return u;
}
SizeRange saturation_range(const CaseScale& s) { return {1e4 * s.peak_input, (1.0 + 1e-9) * s.peak_input}; }

Column dead_zone(const Subject& s, const Values& v, std::mt19937_64&) {
  Column u = s.recording->u;
  for (double& value : u) value += value > 0.0 ? v[0] : value < 0.0 ? -v[0] : 0.0;
  return u;
}
SizeRange dead_zone_range(const CaseScale& s) { return {1e-6 * s.peak_input, s.peak_input}; }

/// What acts later was commanded earlier: the mean of the held input over the step, as much later.
Column delay(const Subject& s, const Values& v, std::mt19937_64&) {
  const Recording& r = *s.recording;
  Column area = {0.0};  // of the held input up to each sample
  for (std::size_t i = 0; i < r.size(); ++i) area.push_back(area.back() + r.u[i] * s.motion.step(i));
  const double end = s.motion.at(r.size() - 1).t + s.motion.step(r.size() - 1);
  std::size_t at = 0;
  const auto area_to = [&](double t) {
    if (t >= end) return area.back() + (t - end) * r.u.back();
    while (at + 1 < r.size() && s.motion.at(at + 1).t <= t) ++at;
    return area[at] + (t - s.motion.at(at).t) * r.u[at];
  };
  Column u(r.size());
  double before = area_to(v[0]);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double after = area_to(s.motion.at(i).t + s.motion.step(i) + v[0]);
    u[i] = (after - before) / s.motion.step(i);
    before = after;
  }
  return u;
}
SizeRange time_range(const CaseScale& s) { return {1e-3 * s.step, 0.02 * s.shortest}; }

/// A torque loop of first order that shall pass the middle of two inputs where they meet.
Column torque_loop(const Subject& s, const Values& v, std::mt19937_64&) {
  const Column& y = s.recording->u;
  const auto between = [&](std::size_t i) {
    return i == 0 ? y[0] : i < y.size() ? 0.5 * (y[i - 1] + y[i]) : y.back();
  };
  Column u(y.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double kept = std::exp(-s.motion.step(i) / v[0]);
    u[i] = (between(i + 1) - kept * between(i)) / (1.0 - kept);
  }
  return u;
}

/// A command that is not the one that was recorded.
Column input_noise(const Subject& s, const Values& v, std::mt19937_64& own) {
  Column u = s.recording->u;
  for (double& value : u) value += v[0] * normal(own);
  return u;
}
SizeRange noise_range(const CaseScale& s) { return {1e-6 * s.input_rms, 10.0 * s.input_rms}; }

Column eccentricity(const Subject& s, const Values& v, std::mt19937_64&) {
  Column x = s.recording->x1;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += v[0] * std::sin(s.motion.at(i).x + v[1]);
  return x;
}
SizeRange eccentricity_range(const CaseScale&) { return {1e-9, 0.5}; }

Column coarser(const Subject& s, const Values& v, std::mt19937_64&) {
  Column x = s.recording->x1;
  for (double& value : x) value = v[0] * std::floor(value / v[0]);
  return x;
}
double quantum_of(double size, const CaseScale& s) {
  return s.quantum * std::max(2.0, std::round(40.0 * size));
}

/// The smoothed motion through a filter of first order, straight between samples; noise as it was.
Column measurement_lag(const Subject& s, const Values& v, std::mt19937_64&) {
  Column x = s.recording->x1;
  double behind = v[0] * s.motion.at(0).w;  // settled
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] -= behind;
    if (i + 1 >= x.size()) break;
    const double kept = std::exp(-s.motion.step(i) / v[0]);
    const double speed = (s.motion.at(i + 1).x - s.motion.at(i).x) / s.motion.step(i);
    behind = v[0] * speed + (behind - v[0] * speed) * kept;
  }
  return x;
}

/// Counts that never come back, in either direction: once in three seconds, at least once.
Column lost_counts(const Subject& s, const Values& v, std::mt19937_64& own) {
  Column x = s.recording->x1;
  const int times = std::max(1, static_cast<int>(std::lround(s.recording->duration() / kLostEvery)));
  for (int k = 0; k < times; ++k) {
    const double sign = uniform(own, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    const auto from = static_cast<std::size_t>(static_cast<double>(x.size()) * uniform(own, 0.05, 0.95));
    for (std::size_t i = from; i < x.size(); ++i) x[i] += sign * v[0];
  }
  return x;
}
double lost_of(double size, const CaseScale& s) {
  const double lost = 0.05 * size * s.travel;
  return s.quantum > 0.0 ? s.quantum * std::max(1.0, std::round(lost / s.quantum)) : lost;
}

constexpr ImplantLaw kCommandLaws[] = {
    {"torque_ripple",
     true,
     Way::kCommand,
     Asks::kNothing,
     {{{"ratio", ""}, {"periods_per_turn", "1/rev"}, {"phase_rad", "rad"}, kUnused}},
     draw_line,
     nullptr,
     ripple,
     ripple_range,
     nullptr},
    {"torque_saturation",
     true,
     Way::kCommand,
     Asks::kNothing,
     {{{"knee", "unit of u"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     saturation,
     saturation_range,
     nullptr},
    {"input_dead_zone",
     true,
     Way::kCommand,
     Asks::kNothing,
     {{{"width", "unit of u"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     dead_zone,
     dead_zone_range,
     nullptr},
    {"input_delay",
     true,
     Way::kCommand,
     Asks::kNothing,
     {{{"delay_s", "s"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     delay,
     time_range,
     nullptr},
    {"actuator_lag",
     true,
     Way::kCommand,
     Asks::kNothing,
     {{{"time_constant_s", "s"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     torque_loop,
     time_range,
     nullptr},
    {"input_noise",
     false,
     Way::kCommand,
     Asks::kNothing,
     {{{"rms", "unit of u"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     input_noise,
     noise_range,
     nullptr},
};

constexpr ImplantLaw kSensorLaws[] = {
    {"encoder_eccentricity",
     true,
     Way::kSensor,
     Asks::kRotation,
     {{{"amplitude_rad", "rad"}, {"phase_rad", "rad"}, kUnused, kUnused}},
     draw_phase,
     nullptr,
     eccentricity,
     eccentricity_range,
     nullptr},
    {"encoder_quantization",
     true,
     Way::kSensor,
     Asks::kQuantum,
     {{{"quantum_rad", "rad"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     coarser,
     nullptr,
     quantum_of},
    {"measurement_lag",
     true,
     Way::kSensor,
     Asks::kNothing,
     {{{"time_constant_s", "s"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     measurement_lag,
     time_range,
     nullptr},
    {"lost_counts",
     false,
     Way::kSensor,
     Asks::kNothing,
     {{{"jump_rad", "rad"}, kUnused, kUnused, kUnused}},
     draw_nothing,
     nullptr,
     lost_counts,
     nullptr,
     lost_of},
};

}  // namespace

std::span<const ImplantLaw> command_laws() { return kCommandLaws; }
std::span<const ImplantLaw> sensor_laws() { return kSensorLaws; }

}  // namespace gapscope::internal::implant
