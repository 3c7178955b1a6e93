#include <algorithm>
#include <cmath>

#include "independent_plant/dynamics.h"

/// The smooth torques on either side, effect by effect.
namespace gapscope::independent_plant {
namespace {

double harmonic(const AngleHarmonic& h, double angle) {
  const double phase = h.periods_per_turn * angle + h.phase_rad;
  double wave = std::sin(phase + (h.skew != 0.0 ? h.skew * std::sin(phase) : 0.0));
  if (h.second != 0.0) wave += h.second * std::sin(2.0 * phase + h.second_phase_rad);
  if (h.third != 0.0) wave += h.third * std::sin(3.0 * phase + h.third_phase_rad);
  return h.amplitude * wave;
}

double knock_torque(const std::vector<Knock>& knocks, double duration, double t) {
  double torque = 0.0;
  for (const Knock& knock : knocks) {
    const double phase = (t - knock.start_s) / duration;
    if (phase > 0.0 && phase < 1.0) torque += knock.torque_nm * std::sin(kPi * phase);
  }
  return torque;
}

double drive_torque(const BlindDrive& d, double t, double x1, double w1, double command) {
  const CommandEffects& e = d.effects.command;
  double torque = d.torque_constant * command;
  if (const double weak = w1 / d.effects.outside.weak_speed_rad_s; weak != 0.0) torque /= 1.0 + weak * weak;
  if (e.ripple.amplitude != 0.0) torque *= 1.0 + harmonic(e.ripple, x1);
  if (e.wander_ratio != 0.0)
    torque *= 1.0 - 0.5 * e.wander_ratio * (1.0 - std::cos(2.0 * kPi * t / e.wander_period_s));
  if (e.sag_per_w != 0.0 && torque * w1 > 0.0)
    torque *= std::pow(1.0 + e.sag_per_w * torque * w1 / e.sag_exponent, -e.sag_exponent);
  return torque;
}

/// What is no effect of the catalogue.
double outside_torque(const OutsideEffects& e, double t, double x1, double w1) {
  double torque = 0.0;
  if (const double y = w1 / e.hump_speed_rad_s; e.hump_nm != 0.0)
    torque -= e.hump_nm * y * std::exp(0.5 * (1.0 - y * y));
  if (e.cable_nm != 0.0)
    torque -= e.cable_nm * std::sinh(3.0 * (x1 - e.cable_from_rad) / e.cable_reach_rad) / std::sinh(3.0);
  if (e.tight_nm != 0.0)
    torque -=
        e.tight_nm * std::tanh(w1 / e.tight_speed_rad_s) * 0.5 * (1.0 + std::sin(x1 + e.tight_phase_rad));
  if (e.worn.amplitude != 0.0) torque -= std::pow(t / e.worn_time_s, 2) * harmonic(e.worn, x1);
  if (e.stray_nm != 0.0) torque += e.stray_nm * std::sin(2.0 * kPi * e.stray_hz * t + e.stray_phase_rad);
  if (e.snag_nm != 0.0) torque += 0.5 * e.snag_nm * (1.0 + std::tanh((t - e.snag_time_s) / e.snag_rise_s));
  return torque;
}

/// @param z  deflection   @param w  speed of the body
double bristle_rate(const BristleFriction& b, double z, double w) {
  return w - std::abs(w) * z / b.length_rad;
}

double bristle_torque(const BristleFriction& b, double z, double w) {
  if (b.level_nm == 0.0) return 0.0;
  return -b.level_nm / b.length_rad * z - b.damping_nms * bristle_rate(b, z, w);
}

}  // namespace

double Dynamics::shape_command(double u) const {
  const CommandEffects& e = drive_.effects.command;
  const double beyond = std::max(0.0, std::abs(u) - e.dead_zone);
  const double limited =
      std::isinf(e.saturation_knee) ? beyond : e.saturation_knee * std::tanh(beyond / e.saturation_knee);
  const OutsideEffects& o = drive_.effects.outside;
  return std::copysign(limited, u) * (1.0 + o.one_sided_gain * std::tanh(u / o.gain_input));
}

double Dynamics::measured_angle(double x1) const {
  const SensorEffects& e = drive_.effects.sensor;
  if (e.eccentricity_rad == 0.0) return x1;
  return x1 + e.eccentricity_rad * std::sin(e.eccentricity_periods * x1 + e.eccentricity_phase_rad);
}

/// Everything on the motor but dry friction and contact; `direction` is that of its dry friction.
double Dynamics::motor_drive(double t, const State& s, int direction, double held) const {
  const MotorEffects& e = drive_.effects.motor;
  const double w = s[kW1];
  double damping = drive_.motor_damping * (1.0 + e.friction.viscous_ratio * direction);
  if (e.viscous_drift_ratio != 0.0)
    damping *= 1.0 - e.viscous_drift_ratio * std::expm1(-t / e.viscous_drift_time_s);
  const double command = drive_.effects.command.lag_s > 0.0 ? s[kTorqueLoop] : held;
  double torque = drive_torque(drive_, t, s[kX1], w, command) - damping * w;
  if (e.drag_nms2 != 0.0) torque -= std::copysign(e.drag_nms2 * std::pow(std::abs(w), e.drag_exponent), w);
  if (e.cogging.amplitude != 0.0) torque -= harmonic(e.cogging, s[kX1]);
  if (e.second_cogging.amplitude != 0.0) torque -= harmonic(e.second_cogging, s[kX1]);
  torque += bristle_torque(e.bristle, s[kBristle], w);
  torque += outside_torque(drive_.effects.outside, t, s[kX1], w);
  if (!knocks_.empty()) torque += knock_torque(knocks_, e.knocks.duration_s, t);
  return torque;
}

/// What acts on a load at x, w besides contact and friction.
double Dynamics::load_torques(double x, double w, const State& s) const {
  const LoadEffects& e = drive_.effects.load;
  double torque = e.constant_torque_nm;
  if (e.unbalance_nm != 0.0)
    torque -= e.unbalance_nm * std::sin(e.unbalance_periods * x + e.unbalance_phase_rad);
  if (e.resonator_inertia > 0.0)
    torque += e.resonator_stiffness * (s[kX3] - x) + e.resonator_damping * (s[kW3] - w);
  return torque;
}

double Dynamics::load_on_one_body(const State& s) const {
  return drive_.load == BlindLoad::kNone ? load_torques(s[kX1], s[kW1], s) : 0.0;
}

double Dynamics::load_drive(const State& s) const {
  return load_torques(s[kX2], s[kW2], s) - drive_.load_damping * s[kW2] +
         bristle_torque(drive_.effects.load.bristle, s[kLoadBristle], s[kW2]);
}

double Dynamics::motor_level(int direction, double w, double gear_torque) const {
  const MotorFriction& f = drive_.effects.motor.friction;
  const double of_gears =
      f.gear_ratio == 0.0 ? 0.0 : f.gear_ratio * (std::hypot(gear_torque, f.gear_knee_nm) - f.gear_knee_nm);
  if (f.level_nm == 0.0) return of_gears;
  const double level = f.level_nm * (1.0 + f.coulomb_ratio * direction);
  if (f.stiction_ratio == 0.0) return level + of_gears;
  return of_gears + level * (1.0 + f.stiction_ratio * std::exp(-std::pow(std::abs(w) / f.stribeck_speed_rad_s,
                                                                         f.stribeck_exponent)));
}

double Dynamics::load_level() const {
  return drive_.load == BlindLoad::kLocked ? kInfinity : drive_.load_coulomb;
}

double Dynamics::load_inertia(double t) const {
  if (drive_.load == BlindLoad::kLocked) return kInfinity;
  const LoadEffects& e = drive_.effects.load;
  if (e.inertia_ratio == 0.0) return drive_.load_inertia;
  const double since = t - e.inertia_time_s;
  const double ramp = e.inertia_duration_s > 0.0 ? std::clamp(since / e.inertia_duration_s, 0.0, 1.0)
                                                 : (since >= 0.0 ? 1.0 : 0.0);
  return drive_.load_inertia * (1.0 + e.inertia_ratio * ramp);
}

double Dynamics::motor_inertia(double t) const {
  if (drive_.load != BlindLoad::kNone || drive_.effects.load.inertia_ratio == 0.0)
    return drive_.motor_inertia;
  return drive_.motor_inertia * load_inertia(t) / drive_.load_inertia;
}

void Dynamics::hidden_rates(const State& s, double held, State& rate) const {
  const Effects& e = drive_.effects;
  if (e.motor.bristle.level_nm != 0.0) rate[kBristle] = bristle_rate(e.motor.bristle, s[kBristle], s[kW1]);
  if (e.load.bristle.level_nm != 0.0)
    rate[kLoadBristle] = bristle_rate(e.load.bristle, s[kLoadBristle], s[kW2]);
  if (e.command.lag_s > 0.0) rate[kTorqueLoop] = (held - s[kTorqueLoop]) / e.command.lag_s;
  if (e.sensor.lag_s > 0.0) rate[kFilter] = (measured_angle(s[kX1]) - s[kFilter]) / e.sensor.lag_s;
  if (e.load.resonator_inertia > 0.0) {
    const bool one = drive_.load == BlindLoad::kNone;
    const double x = s[one ? kX1 : kX2], w = s[one ? kW1 : kW2];
    rate[kX3] = s[kW3];
    rate[kW3] = (e.load.resonator_stiffness * (x - s[kX3]) + e.load.resonator_damping * (w - s[kW3]) -
                 e.load.resonator_drag * s[kW3]) /
                e.load.resonator_inertia;
  }
}

}  // namespace gapscope::independent_plant
