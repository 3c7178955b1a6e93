#include "drives/controller.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"

namespace gapscope::independent_plant {

ControllerSettings tuned_controller(double inertia, double torque_constant, double bandwidth_hz,
                                    double rate) {
  const double omega = 2.0 * kPi * bandwidth_hz;
  ControllerSettings s;
  s.rate = rate;
  s.speed_gain = omega * inertia / torque_constant;
  s.integral_s = 4.0 / omega;
  s.position_gain = 0.25 * omega;
  s.filter_s = 0.1 / omega;
  return s;
}

Controller::Controller(const ControllerSettings& settings) : settings_(settings) {
  GAPSCOPE_REQUIRE(settings.rate > 0.0 && settings.integral_s > 0.0 && settings.limit > 0.0);
  GAPSCOPE_REQUIRE(settings.filter_s >= 0.0 && settings.dead_time_s >= 0.0);
  GAPSCOPE_REQUIRE(settings.jitter_s >= 0.0 && settings.jitter_s * settings.rate < 1.0);
}

double Controller::step(double t, double x, const Target& target) {
  const double dt = std::isnan(last_t_) ? 0.0 : t - last_t_;
  if (dt > 0.0) speed_ += ((x - last_x_) / dt - speed_) * dt / (dt + settings_.filter_s);
  last_t_ = t, last_x_ = x;
  const double wanted = settings_.position_gain * (target.x - x) + settings_.speed_forward * target.w;
  const double error = wanted - speed_;
  const double integral = integral_ + error * dt / settings_.integral_s;
  const double u = settings_.speed_gain * (error + integral);
  if (std::abs(u) <= settings_.limit) integral_ = integral;
  return std::clamp(u, -settings_.limit, settings_.limit);
}

}  // namespace gapscope::independent_plant
