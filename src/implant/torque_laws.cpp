// Torques on the motor. Each is written in another form than that of the model which is to find it, where one
// comes to mind: whoever finds it has found the effect, not the formula.
#include <algorithm>
#include <cmath>

#include "implant/drawn_shape.h"

namespace gapscope::internal::implant {
namespace {

double any_sign(std::mt19937_64& g) { return uniform(g, -1.0, 1.0) < 0.0 ? -1.0 : 1.0; }

double coulomb(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return -v[0] * p.direction;
}

/// Friction that is larger in one direction by a torque and by a share that grows with the speed.
void draw_asymmetry(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  v[1] = any_sign(g);
  v[2] = s.rms_speed * std::exp(uniform(g, std::log(0.5), std::log(2.0)));
}
double asymmetry(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return p.direction == 0 ? 0.0 : -v[0] * v[1] * (1.0 + std::abs(p.at.w) / v[2]);
}

void draw_stribeck(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  v[1] = s.peak_speed * uniform(g, 0.05, 0.3);
  v[2] = uniform(g, 0.8, 2.0);
}
double stribeck(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return -v[0] * p.direction * std::exp(-std::pow(std::abs(p.at.w) / v[1], v[2]));
}

void draw_presliding(Values& v, const CaseScale& s, const Receiver& drive, std::mt19937_64& g) {
  v[1] = s.travel * log_uniform(g, 0.002, 0.02);
  // LuGre's bristle, damped a fifth as a mass on it would be at a torque of a tenth of the input's.
  const double level = 0.1 * drive.torque_constant * s.input_rms;
  v[2] = 0.2 * std::sqrt(drive.inertia * v[1] / level);
}
/// The bristle's share z of its length: ż = (w − |w| z)/length; torque −level (z + time ż).
double presliding(const TorquePoint& p, const Values& v, const Receiver&, double& z) {
  const double side = p.moved > 0.0 ? 1.0 : -1.0, before = z;
  if (p.moved != 0.0) z = side + (z - side) * std::exp(-std::abs(p.moved) / v[1]);
  const double rate = p.lasted > 0.0 ? (z - before) / p.lasted : 0.0;
  return -v[0] * (z + v[2] * rate);
}

void draw_drag(Values& v, const CaseScale&, const Receiver&, std::mt19937_64& g) {
  v[1] = uniform(g, 1.9, 2.1);
}
double drag(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return -v[0] * std::copysign(std::pow(std::abs(p.at.w), v[1]), p.at.w);
}

double cogging(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return -v[0] * skewed_sine(v[1] * p.at.x + v[2]);
}

double unbalance(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return -v[0] * std::sin(p.at.x + v[1]);
}

void draw_sign(Values& v, const CaseScale&, const Receiver&, std::mt19937_64& g) { v[1] = any_sign(g); }
double constant(const TorquePoint&, const Values& v, const Receiver&, double&) { return v[0] * v[1]; }

/// d grows or falls towards another value.
void draw_drift(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  v[1] = s.shortest * uniform(g, 0.2, 0.6);
  v[2] = any_sign(g);
}
double drift(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return v[0] * v[2] * std::expm1(-p.at.t / v[1]) * p.at.w;
}

/// Mass that arrives, with the speed of the drive, over a ramp.
void draw_inertia(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  v[1] = s.shortest * uniform(g, 0.3, 0.5);
  v[2] = s.shortest * uniform(g, 0.0, 0.3);
}
double more_inertia(const TorquePoint& p, const Values& v, const Receiver& drive, double&) {
  const double since = p.at.t - v[1];
  const double ramp = since <= 0.0 ? 0.0 : v[2] > 0.0 ? std::min(1.0, since / v[2]) : 1.0;
  return -v[0] * drive.inertia * ramp * p.at.a;
}

/// A torque of a frequency of its own, from another machine.
void draw_stray(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  v[1] = log_uniform(g, 2.0, std::max(4.0, std::min(20.0, 0.05 / s.step)));
  v[2] = uniform(g, 0.0, 2.0 * kPi);
}
double stray(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  return v[0] * std::sin(2.0 * kPi * v[1] * p.at.t + v[2]);
}

/// Half-sine pushes about every second or two, of either sign: times by the golden ratio, signs by thirds.
void draw_knocks(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  v[1] = uniform(g, 1.0, 2.0);
  v[2] = std::max(10.0 * s.step, uniform(g, 0.02, 0.06));
  v[3] = uniform(g, 0.0, 1.0);
}
double knocks(const TorquePoint& p, const Values& v, const Receiver&, double&) {
  const double place = p.at.t / v[1], slot = std::floor(place);
  const double draw = v[3] + 0.6180339887498949 * slot, at = draw - std::floor(draw);
  const double since = (place - slot - 0.8 * at) * v[1];
  if (since < 0.0 || since > v[2]) return 0.0;
  return (std::fmod(std::floor(draw * 7.0), 3.0) < 1.0 ? -v[0] : v[0]) * std::sin(kPi * since / v[2]);
}

constexpr ImplantLaw of(const char* name, Asks asks, std::array<ValueName, kMostValues> values,
                        decltype(ImplantLaw::draw) draw, decltype(ImplantLaw::torque) torque,
                        bool in_catalogue = true) {
  return {name, in_catalogue, Way::kTorque, asks, values, draw, torque, nullptr, nullptr, nullptr};
}

constexpr ImplantLaw kLaws[] = {
    of("motor_coulomb_friction", Asks::kNothing, {{{"level_nm", "N m"}, kUnused, kUnused, kUnused}},
       draw_nothing, coulomb),
    of("friction_asymmetry", Asks::kNothing,
       {{{"torque_nm", "N m"}, {"sign", ""}, {"doubled_at_rad_s", "rad/s"}, kUnused}}, draw_asymmetry,
       asymmetry),
    of("stribeck_friction", Asks::kNothing,
       {{{"torque_nm", "N m"}, {"stribeck_speed_rad_s", "rad/s"}, {"exponent", ""}, kUnused}}, draw_stribeck,
       stribeck),
    of("presliding_friction", Asks::kNothing,
       {{{"level_nm", "N m"}, {"length_rad", "rad"}, {"damping_time_s", "s"}, kUnused}}, draw_presliding,
       presliding),
    of("quadratic_drag", Asks::kNothing,
       {{{"coefficient_nms2", "N m s^2"}, {"exponent", ""}, kUnused, kUnused}}, draw_drag, drag),
    of("cogging_torque", Asks::kNothing,
       {{{"amplitude_nm", "N m"}, {"periods_per_turn", "1/rev"}, {"phase_rad", "rad"}, kUnused}}, draw_line,
       cogging),
    of("viscous_drift", Asks::kNothing,
       {{{"damping_nms", "N m s"}, {"time_constant_s", "s"}, {"sign", ""}, kUnused}}, draw_drift, drift),
    of("load_unbalance", Asks::kOneRotatingBody,
       {{{"amplitude_nm", "N m"}, {"phase_rad", "rad"}, kUnused, kUnused}}, draw_phase, unbalance),
    of("constant_load_torque", Asks::kOneBody, {{{"torque_nm", "N m"}, {"sign", ""}, kUnused, kUnused}},
       draw_sign, constant),
    of("load_inertia_variation", Asks::kOneBody,
       {{{"ratio", ""}, {"time_s", "s"}, {"duration_s", "s"}, kUnused}}, draw_inertia, more_inertia),
    of("stray_sine", Asks::kNothing,
       {{{"amplitude_nm", "N m"}, {"frequency_hz", "Hz"}, {"phase_rad", "rad"}, kUnused}}, draw_stray, stray,
       false),
    of("knocks", Asks::kNothing, {{{"peak_nm", "N m"}, {"every_s", "s"}, {"duration_s", "s"}, {"draw", ""}}},
       draw_knocks, knocks, false),
};

}  // namespace

std::span<const ImplantLaw> torque_laws() { return kLaws; }

}  // namespace gapscope::internal::implant
