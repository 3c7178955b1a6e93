#include "independent_plant/dynamics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/require.h"

namespace gapscope::independent_plant {
namespace {

/// Where a body goes: along its speed; from rest where the torque overcomes the friction level; else nowhere.
int direction_of(double w, double torque, double level_plus, double level_minus) {
  if (w != 0.0) return w > 0.0 ? 1 : -1;
  if (torque > level_plus) return 1;
  return torque < -level_minus ? -1 : 0;
}

void fill_friction_guards(double* guards, int direction, double w, double torque, double level_plus,
                          double level_minus) {
  if (direction != 0) {
    guards[0] = direction * w;
  } else {
    guards[0] = level_plus - torque;
    guards[1] = level_minus + torque;
  }
}

constexpr double kMostOfTorque = 10.0;  ///< that gears with a ratio of at most 0.9 carry of what drives them
constexpr int kHalvings = 60;

void require_sound(const BlindDrive& d) {
  GAPSCOPE_REQUIRE(d.motor_inertia > 0.0 && d.load_inertia > 0.0 && d.gap >= 0.0 && d.load_coulomb >= 0.0);
  GAPSCOPE_REQUIRE(d.restitution >= 0.0 && d.restitution <= 1.0);
  const Effects& e = d.effects;
  GAPSCOPE_REQUIRE(e.motor.bristle.length_rad > 0.0 && e.load.bristle.length_rad > 0.0 &&
                   e.motor.friction.stribeck_speed_rad_s > 0.0);
  GAPSCOPE_REQUIRE(e.command.delay_s >= 0.0 && e.command.jitter_s >= 0.0);
  if (d.contact != ContactKind::kRigid) return;
  GAPSCOPE_REQUIRE(e.contact.eccentricity_rad == 0.0 && e.contact.growth_rad_s == 0.0 &&
                   e.contact.release_nm == 0.0 && e.motor.friction.gear_ratio == 0.0);
}

}  // namespace

Dynamics::Dynamics(const BlindDrive& drive, std::vector<Knock> knocks)
    : drive_(drive), knocks_(std::move(knocks)) {
  require_sound(drive_);
  const Effects& e = drive_.effects;
  if (!std::isnan(e.contact.stiffness_nm_rad)) drive_.contact_stiffness = e.contact.stiffness_nm_rad;
  if (!std::isnan(e.contact.damping_nms_rad)) drive_.contact_damping = e.contact.damping_nms_rad;
  motor_signed_ = e.motor.friction.level_nm > 0.0 || e.motor.friction.gear_ratio > 0.0 ||
                  e.motor.friction.viscous_ratio != 0.0 || e.motor.bristle.level_nm > 0.0 ||
                  e.motor.drag_nms2 != 0.0 || e.command.sag_per_w != 0.0;  // all have a kink at w1 = 0
  load_signed_ =
      drive_.load == BlindLoad::kFree && (drive_.load_coulomb > 0.0 || e.load.bristle.level_nm > 0.0);
  hidden_states_ = e.motor.bristle.level_nm > 0.0 || e.load.bristle.level_nm > 0.0 || e.command.lag_s > 0.0 ||
                   e.sensor.lag_s > 0.0 || e.load.resonator_inertia > 0.0;
  for (const Knock& knock : knocks_) {
    kinks_.push_back(knock.start_s);
    kinks_.push_back(knock.start_s + e.motor.knocks.duration_s);
  }
  if (e.load.inertia_ratio != 0.0) {
    kinks_.push_back(e.load.inertia_time_s);
    kinks_.push_back(e.load.inertia_time_s + e.load.inertia_duration_s);
  }
  std::sort(kinks_.begin(), kinks_.end());
}

double Dynamics::half_gap(double t, double x2) const {
  const ContactEffects& e = drive_.effects.contact;
  double beta = 0.5 * drive_.gap;
  if (e.eccentricity_rad != 0.0)
    beta += e.eccentricity_rad * std::sin(e.eccentricity_periods * x2 + e.eccentricity_phase_rad);
  if (e.growth_rad_s != 0.0)
    beta += 0.5 * e.growth_rad_s *
            (std::isinf(e.growth_time_s) ? t : -e.growth_time_s * std::expm1(-t / e.growth_time_s));
  return beta;
}

double Dynamics::overlap(double t, const State& s, int flank) const {
  const double beta = drive_.contact == ContactKind::kBonded ? 0.0 : half_gap(t, s[kX2]);
  return flank * (s[kX1] - s[kX2]) - beta;
}

double Dynamics::contact_law(double t, const State& s, int flank) const {
  const double p = overlap(t, s, flank);
  const ContactEffects& e = drive_.effects.contact;
  const double knees = p / e.hardening_knee_rad;
  const double spring =
      drive_.contact_stiffness * p * (1.0 + e.hardening_per_rad2 * p * p / (1.0 + knees * knees));
  return spring + drive_.contact_damping * flank * (s[kW1] - s[kW2]);
}

double Dynamics::contact_torque(double t, const State& s, const Regime& r) const {
  if (drive_.load == BlindLoad::kNone || r.contact != Regime::Contact::kClosed || is_rigid()) return 0.0;
  return r.flank * contact_law(t, s, r.flank);
}

double Dynamics::stored_energy(double t, const State& s, const Regime& r) const {
  double energy = 0.5 * motor_inertia(t) * s[kW1] * s[kW1];
  if (drive_.load == BlindLoad::kFree) energy += 0.5 * load_inertia(t) * s[kW2] * s[kW2];
  if (is_rigid() || drive_.load == BlindLoad::kNone || r.contact == Regime::Contact::kOpen) return energy;
  const double p = overlap(t, s, r.flank);
  const ContactEffects& e = drive_.effects.contact;
  const double knee = e.hardening_knee_rad;
  const double fourth = std::isinf(knee)
                            ? 0.5 * p * p * p * p
                            : knee * knee * (p * p - knee * knee * std::log1p(p * p / (knee * knee)));
  return energy + 0.5 * drive_.contact_stiffness * (p * p + e.hardening_per_rad2 * fourth);
}

State Dynamics::rates(double t, const State& s, const Regime& r, double held) const {
  State rate{};
  if (is_joined(r)) {
    joined_rates(t, s, r, held, rate);
  } else {
    const double contact = contact_torque(t, s, r);
    if (r.motor != 0) {
      const double of_load = load_on_one_body(s);
      const double drive = motor_drive(t, s, r.motor, held);
      const double gears =
          drive_.load == BlindLoad::kNone ? gears_of_one_body(drive, s[kW1], r.motor) : contact;
      const double torque = drive + of_load - contact - r.motor * motor_level(r.motor, s[kW1], gears);
      rate[kX1] = s[kW1];
      rate[kW1] = torque / motor_inertia(t);
    }
    if (r.load != 0) {
      const double level = load_signed_ ? load_level() : 0.0;
      rate[kX2] = s[kW2];
      rate[kW2] = (contact + load_drive(s) - r.load * level) / load_inertia(t);
    }
  }
  if (hidden_states_) hidden_rates(s, held, rate);
  return rate;
}

/// What is left of the motor's torque after friction that grows with just this: by halving, as the friction
/// grows more slowly than the torque.
double Dynamics::gears_of_one_body(double drive, double w, int direction) const {
  if (drive_.effects.motor.friction.gear_ratio == 0.0) return 0.0;
  double low = -kMostOfTorque * (std::abs(drive) + motor_level(direction, w, 0.0)), high = -low;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (middle + direction * motor_level(direction, w, middle) < drive ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Rigid contact: one body of both inertias.
void Dynamics::joined_rates(double t, const State& s, const Regime& r, double held, State& rate) const {
  if (r.motor == 0) return;
  const double friction = motor_level(r.motor, s[kW1], 0.0) + (load_signed_ ? load_level() : 0.0);
  const double torque = motor_drive(t, s, r.motor, held) + load_drive(s) - r.motor * friction;
  rate[kX1] = s[kW1];
  rate[kX2] = s[kW2];
  rate[kW1] = rate[kW2] = torque / (motor_inertia(t) + load_inertia(t));
}

/// The push between the joined bodies; at rest the largest that both frictions can balance.
double Dynamics::joined_push(double t, const State& s, const Regime& r, double held) const {
  const double motor = motor_drive(t, s, r.motor, held);
  if (r.motor == 0) {
    const double by_motor = r.flank * motor + motor_level(-r.flank, 0.0, 0.0);
    return std::min(by_motor, -r.flank * load_drive(s) + load_level());
  }
  const State rate = rates(t, s, r, held);
  return r.flank * (motor - r.motor * motor_level(r.motor, s[kW1], 0.0) - motor_inertia(t) * rate[kW1]);
}

Guards Dynamics::guards(double t, const State& s, const Regime& r, double held) const {
  Guards g;
  g.fill(1.0);
  if (is_joined(r)) {
    g[0] = joined_push(t, s, r, held);
    if (drive_.load == BlindLoad::kLocked) return g;
    const double torque = motor_drive(t, s, r.motor, held) + load_drive(s), load = load_level();
    fill_friction_guards(&g[2], r.motor, s[kW1], torque, motor_level(1, 0.0, 0.0) + load,
                         motor_level(-1, 0.0, 0.0) + load);
    return g;
  }
  if (has_contact_events()) {
    if (r.contact == Regime::Contact::kOpen) {
      g[0] = -overlap(t, s, 1);
      g[1] = -overlap(t, s, -1);
    } else if (r.contact == Regime::Contact::kParting) {
      g[0] = -contact_law(t, s, r.flank);
      g[1] = overlap(t, s, r.flank);
    } else {
      g[0] = contact_law(t, s, r.flank) + drive_.effects.contact.release_nm;
    }
  }
  const double contact = contact_torque(t, s, r);
  if (load_signed_) {
    const double level = load_level();
    fill_friction_guards(&g[2], r.load, s[kW2], contact + load_drive(s), level, level);
  }
  if (motor_signed_) {
    const double of_load = load_on_one_body(s);
    const double torque = r.motor == 0 ? motor_drive(t, s, 0, held) + of_load - contact : 0.0;
    const double gears = contact + of_load;
    fill_friction_guards(&g[4], r.motor, s[kW1], torque, motor_level(1, 0.0, gears),
                         motor_level(-1, 0.0, gears));
  }
  return g;
}

void Dynamics::settle_friction(double t, const State& s, Regime& r, double held) const {
  if (is_joined(r)) {
    const double torque = motor_drive(t, s, 0, held) + load_drive(s), load = load_level();
    r.motor = r.load =
        direction_of(s[kW1], torque, motor_level(1, 0.0, 0.0) + load, motor_level(-1, 0.0, 0.0) + load);
    if (joined_push(t, s, r, held) >= 0.0) return;
    r.contact = Regime::Contact::kOpen;
  }
  const double contact = contact_torque(t, s, r);
  const double of_load = load_on_one_body(s);
  const double torque = motor_drive(t, s, 0, held) + of_load - contact, gears = contact + of_load;
  r.motor = motor_signed_
                ? direction_of(s[kW1], torque, motor_level(1, 0.0, gears), motor_level(-1, 0.0, gears))
                : 1;
  const double level = load_level();
  if (drive_.load != BlindLoad::kFree)
    r.load = 0;
  else
    r.load = load_signed_ ? direction_of(s[kW2], contact + load_drive(s), level, level) : 1;
}

}  // namespace gapscope::independent_plant
