#include "torque_view/law_shapes.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::torque_view {
namespace {

constexpr double kFewestCycles = 2.0;  ///< of a line over the travel: fewer are a slope or an offset

constexpr double kSpringStep =
    1.06;  ///< ratio of frequencies: a spring is looked for from a damping of 0.03 on [-]

std::vector<double> geometric(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from * std::pow(to / from, i / (count - 1.0)));
  return values;
}

std::vector<double> only_if(bool true_here, double shape) {
  return true_here ? std::vector<double>{shape} : std::vector<double>{};
}

/// Of a locked output the torque goes with the position: a law of one is a law of the other. At one speed the
/// torque stays at one level, where no law of it shows.
bool shows_levels(const Scales& s) { return !s.held_output && !s.one_speed; }

}  // namespace

std::vector<double> no_shape(const Scales&) { return {kNaN}; }
std::vector<double> motor_turn(const Scales& s) {
  return only_if(std::isfinite(s.turns.motor), s.turns.motor);
}
std::vector<double> load_turn(const Scales& s) {
  return only_if(std::isfinite(s.turns.load) && !s.held_output, s.turns.load);
}
std::vector<double> only_held(const Scales& s) { return only_if(s.held_output, kNaN); }
std::vector<double> low_speeds(const Scales& s) {
  return geometric(0.02 * s.speed_std, 0.4 * s.speed_std, 8);
}
std::vector<double> lengths(const Scales& s) { return geometric(1e-4 * s.travel, 1e-2 * s.travel, 9); }
std::vector<double> dead_zones(const Scales& s) {
  if (!shows_levels(s)) return {};
  return geometric(0.01 * s.torque_rms, 0.3 * s.torque_rms, 5);
}
std::vector<double> powers(const Scales& s) {
  if (!shows_levels(s)) return {};
  return {2.0, 4.0, 8.0};
}
std::vector<double> step_times(const Scales& s) {
  std::vector<double> at;
  for (int i = 1; i <= 5; ++i) at.push_back(s.start + s.duration * i / 6.0);
  return at;
}
std::vector<double> spans(const Scales& s) { return geometric(0.1 * s.duration, 3.0 * s.duration, 4); }
std::vector<double> resonances(const Scales& s) {
  if (!shows_levels(s)) return {};
  const double top = std::max(4.0, std::min(80.0, 2.0 * s.hz));
  return geometric(2.0, top, 2 + static_cast<int>(std::log(top / 2.0) / std::log(kSpringStep)));
}
std::vector<double> found_line(const Scales& s) { return only_if(std::isfinite(s.line), s.line); }
std::vector<double> found_ripple(const Scales& s) { return only_if(std::isfinite(s.ripple), s.ripple); }
std::vector<double> only_known(const Scales&) { return {}; }
std::vector<double> top_speed(const Scales& s) { return {s.top_speed}; }

std::vector<double> line_grid(const Scales& s) {
  const double step = 0.5 * kPi / s.travel, top = 2.0 * kPi * s.hz / s.speed_rms;
  std::vector<double> k;
  for (double at = 2.0 * kPi * kFewestCycles / s.travel; at <= top; at += step) k.push_back(at);
  return k;
}

}  // namespace gapscope::internal::torque_view
