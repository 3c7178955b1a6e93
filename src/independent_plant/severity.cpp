#include "independent_plant/severity.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "independent_plant/outside_effects.h"

namespace gapscope::independent_plant {
namespace {

MotionScale scale_of(const BlindCase& c) {
  BlindOptions options = c.options;
  options.tolerance = kFastTolerance;
  return scale_of_motion(c, simulate_blind(c.drive, c.excitation, {}, options), 1.0 / c.excitation.frequency);
}

// Motor side
void motor_coulomb_friction(BlindCase& c, EffectScale& s) {
  c.drive.effects.motor.friction.level_nm = s.torque * s.between(0.02, 0.2);
}
void friction_asymmetry(BlindCase& c, EffectScale& s) {
  MotorFriction& f = c.drive.effects.motor.friction;
  f.level_nm = s.torque * s.between(0.05, 0.15);
  f.coulomb_ratio = s.sign() * s.between(0.1, 0.6);
  f.viscous_ratio = s.sign() * s.between(0.05, 0.4);
}
void stribeck_friction(BlindCase& c, EffectScale& s) {
  MotorFriction& f = c.drive.effects.motor.friction;
  f.level_nm = s.torque * s.between(0.03, 0.15);
  f.stiction_ratio = s.between(0.4, 2.0);
  f.stribeck_speed_rad_s = s.speed * s.any(0.05, 0.3);
  f.stribeck_exponent = s.any(0.8, 2.0);
}
void load_dependent_friction(BlindCase& c, EffectScale& s) {
  MotorFriction& f = c.drive.effects.motor.friction;
  f.gear_ratio = s.between(0.05, 0.4);
  f.gear_knee_nm = 0.02 * s.torque;
}
void presliding_friction(BlindCase& c, EffectScale& s) {
  BristleFriction& b = c.drive.effects.motor.bristle;
  b.level_nm = s.torque * s.between(0.03, 0.25);
  b.length_rad = s.travel * s.any(0.01, 0.05);
  b.damping_nms = 0.2 * std::sqrt(b.level_nm / b.length_rad * c.drive.motor_inertia);
}
void quadratic_drag(BlindCase& c, EffectScale& s) {
  MotorEffects& m = c.drive.effects.motor;
  m.drag_exponent = s.any(1.9, 2.1);
  m.drag_nms2 = s.torque * s.between(0.05, 0.5) / std::pow(s.speed, m.drag_exponent);
}
void cogging_torque(BlindCase& c, EffectScale& s) {
  c.drive.effects.motor.cogging = {s.torque * s.between(0.02, 0.2), s.periods_per_turn(), s.phase(), kSkew};
}
void viscous_drift(BlindCase& c, EffectScale& s) {
  c.drive.effects.motor.viscous_drift_ratio = s.sign() * s.between(0.1, 0.7);
  c.drive.effects.motor.viscous_drift_time_s = s.record * s.any(0.2, 0.6);
}

// Command
void torque_ripple(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.ripple = {s.between(0.03, 0.3), s.periods_per_turn(), s.phase(), kSkew};
}
void torque_saturation(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.saturation_knee = s.input * s.between(2.5, 0.7);
}
void supply_sag(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.sag_per_w = s.between(0.3, 2.0) / (s.torque * s.speed);
  c.drive.effects.command.sag_exponent = 4.0;
}
void input_dead_zone(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.dead_zone = s.input * s.between(0.02, 0.2);
}
void input_delay(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.delay_s = s.period * s.between(5e-4, 5e-3);
}
void actuator_lag(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.lag_s = s.period * s.between(5e-4, 5e-3);
}

// Load
void load_unbalance(BlindCase& c, EffectScale& s) {
  c.drive.effects.load.unbalance_nm = s.torque * s.between(0.03, 0.3);
  c.drive.effects.load.unbalance_phase_rad = s.phase();
}
void constant_load_torque(BlindCase& c, EffectScale& s) {
  c.drive.effects.load.constant_torque_nm = s.sign() * s.torque * s.between(0.02, 0.2);
}
void load_inertia_variation(BlindCase& c, EffectScale& s) {
  LoadEffects& e = c.drive.effects.load;
  e.inertia_ratio = s.between(0.1, 1.0);
  e.inertia_time_s = s.record * s.any(0.3, 0.5);
  e.inertia_duration_s = s.record * s.any(0.0, 0.3);
}
void load_resonance(BlindCase& c, EffectScale& s) {
  LoadEffects& e = c.drive.effects.load;
  const double inertia = c.drive.load == BlindLoad::kNone ? c.drive.motor_inertia : c.drive.load_inertia;
  const double omega = 2.0 * kPi * s.any(4.0, 15.0) / s.period;
  e.resonator_inertia = inertia * s.between(0.05, 0.5);
  e.resonator_stiffness = e.resonator_inertia * omega * omega;
  e.resonator_drag = 2.0 * 0.03 * e.resonator_inertia * omega;
}

// Contact
void shaft_compliance(BlindCase& c, EffectScale& s) {
  c.drive.effects.contact.stiffness_nm_rad =
      c.drive.contact_stiffness * std::pow(s.between(1.3, 4.0), s.sign());
}
void impact_damping(BlindCase& c, EffectScale& s) {
  c.drive.effects.contact.damping_nms_rad = c.drive.contact_damping * std::pow(s.between(1.5, 6.0), s.sign());
}
void backlash(BlindCase& c, EffectScale& s) {
  BlindDrive& d = c.drive;
  if (d.load == BlindLoad::kNone) {
    const double share = s.any(0.3, 0.7);
    d.load = BlindLoad::kFree;
    d.load_inertia = share * d.motor_inertia;
    d.motor_inertia -= d.load_inertia;
    d.load_damping = share * d.motor_damping;
    d.motor_damping -= d.load_damping;
    d.load_coulomb = 0.02 * s.torque;
    d.x2 = d.x1, d.w2 = d.w1;
  }
  d.contact = ContactKind::kCompliant;
  d.gap = s.travel * s.between(0.03, 0.3);
}
void gap_eccentricity(BlindCase& c, EffectScale& s) {
  c.drive.effects.contact.eccentricity_rad = 0.5 * c.drive.gap * s.between(0.1, 0.8);
  c.drive.effects.contact.eccentricity_phase_rad = s.phase();
}
void gap_growth(BlindCase& c, EffectScale& s) {
  ContactEffects& e = c.drive.effects.contact;
  e.growth_time_s = s.record * s.any(0.3, 1.0);
  e.growth_rad_s =
      c.drive.gap * s.between(0.1, 1.0) / (-e.growth_time_s * std::expm1(-s.record / e.growth_time_s));
}
void contact_adhesion(BlindCase& c, EffectScale& s) {
  c.drive.effects.contact.release_nm = s.torque * s.between(0.03, 0.3);
}
void contact_hardening(BlindCase& c, EffectScale& s) {
  const double overlap = s.torque / c.drive.contact_stiffness;
  c.drive.effects.contact.hardening_per_rad2 = s.between(0.3, 10.0) / (overlap * overlap);
}

// Sensor
void encoder_eccentricity(BlindCase& c, EffectScale& s) {
  c.drive.effects.sensor.eccentricity_rad = std::max(3.0 * s.quantum, s.between(0.3e-3, 10e-3));
  c.drive.effects.sensor.eccentricity_phase_rad = s.phase();
}
void encoder_quantization(BlindCase& c, EffectScale& s) {
  GAPSCOPE_REQUIRE(s.quantum > 0.0);
  c.drive.effects.sensor.quantum_rad = s.quantum * std::exp2(std::round(1.0 + 3.0 * s.severity));
}
void measurement_lag(BlindCase& c, EffectScale& s) {
  c.drive.effects.sensor.lag_s = s.period * s.between(5e-4, 5e-3);
}

double cogging_cycles(const BlindCase& c) { return c.drive.effects.motor.cogging.periods_per_turn; }
double ripple_cycles(const BlindCase& c) { return c.drive.effects.command.ripple.periods_per_turn; }

constexpr DrawnEffect kEntries[] = {
    {"motor_coulomb_friction", true, Needs::kNothing, motor_coulomb_friction, {.of_the_bearing = true}},
    {"friction_asymmetry", true, Needs::kNothing, friction_asymmetry, {.of_the_bearing = true}},
    {"stribeck_friction", true, Needs::kNothing, stribeck_friction, {.of_the_bearing = true}},
    {"load_dependent_friction", true, Needs::kContact, load_dependent_friction, {.another_law = true}},
    {"presliding_friction", true, Needs::kNothing, presliding_friction, {.another_law = true}},
    {"quadratic_drag", true, Needs::kNothing, quadratic_drag},
    {"cogging_torque", true, Needs::kNothing, cogging_torque, {.cycles_per_turn = cogging_cycles}},
    {"torque_ripple", true, Needs::kNothing, torque_ripple, {.cycles_per_turn = ripple_cycles}},
    {"load_unbalance", true, Needs::kNothing, load_unbalance},
    {"load_resonance", true, Needs::kNothing, load_resonance, {.another_law = true}},
    {"constant_load_torque", true, Needs::kNothing, constant_load_torque},
    {"supply_sag", true, Needs::kNothing, supply_sag, {.another_law = true}},
    {"torque_saturation", true, Needs::kNothing, torque_saturation},
    {"input_dead_zone", true, Needs::kNothing, input_dead_zone},
    {"input_delay", true, Needs::kNothing, input_delay},
    {"actuator_lag", true, Needs::kNothing, actuator_lag},
    {"shaft_compliance", true, Needs::kContact, shaft_compliance},
    {"impact_damping", true, Needs::kContact, impact_damping},
    {"backlash", true, Needs::kNoGap, backlash},
    {"gap_eccentricity", true, Needs::kGap, gap_eccentricity, {.another_law = true}},
    {"gap_growth", true, Needs::kGap, gap_growth},
    {"contact_adhesion", true, Needs::kGap, contact_adhesion},
    {"contact_hardening", true, Needs::kContact, contact_hardening, {.another_law = true}},
    {"encoder_eccentricity", true, Needs::kNothing, encoder_eccentricity, {.another_law = true}},
    {"encoder_quantization", true, Needs::kNothing, encoder_quantization},
    {"measurement_lag", true, Needs::kNothing, measurement_lag},
    {"viscous_drift", true, Needs::kNothing, viscous_drift, {.another_law = true}},
    {"load_inertia_variation", true, Needs::kNothing, load_inertia_variation, {.another_law = true}},
    {"external_knocks", false, Needs::kNothing, external_knocks},
    {"input_jitter", false, Needs::kNothing, input_jitter},
    {"input_noise", false, Needs::kNothing, input_noise},
    {"lost_counts", false, Needs::kNothing, lost_counts},
    {"supply_wander", false, Needs::kNothing, supply_wander},
    {"friction_hump", false, Needs::kNothing, friction_hump},
    {"cable_pull", false, Needs::kNothing, cable_pull},
    {"one_sided_gain", false, Needs::kNothing, one_sided_gain},
    {"flux_weakening", false, Needs::kNothing, flux_weakening},
    {"tight_spots", false, Needs::kNothing, tight_spots},
    {"worn_detents", false, Needs::kNothing, worn_detents},
    {"stray_sine", false, Needs::kNothing, stray_sine},
    {"snag", false, Needs::kNothing, snag},
};

}  // namespace

std::span<const DrawnEffect> effect_entries() { return kEntries; }

const DrawnEffect* find_drawn_effect(std::string_view name) {
  for (const DrawnEffect& entry : kEntries)
    if (entry.name == name) return &entry;
  return nullptr;
}

bool can_have(const BlindDrive& drive, const DrawnEffect& entry) {
  const bool has_contact = drive.load != BlindLoad::kNone;
  const bool has_gap = has_contact && drive.contact != ContactKind::kBonded;
  switch (entry.needs) {
    case Needs::kNothing:
      return true;
    case Needs::kContact:
      return has_contact;
    case Needs::kGap:
      return has_gap;
    case Needs::kNoGap:
      return !has_gap;
  }
  return false;
}

MotionScale scale_of_motion(const BlindCase& c, const BlindRun& run, double period) {
  double input = 0.0, speed = 0.0;
  for (const double u : run.recording.u) input = std::max(input, std::abs(u));
  for (const double w : run.truth.w1) speed = std::max(speed, std::abs(w));
  const auto [low, high] = std::minmax_element(run.truth.x1.begin(), run.truth.x1.end());
  return {c.drive.torque_constant * input,
          input,
          *high - *low,
          speed,
          period,
          c.options.duration,
          c.sensor.quantum};
}

void give_effect(BlindCase& c, std::string_view name, double severity, std::uint64_t seed) {
  give_effect(c, name, severity, seed, scale_of(c));
}

void give_effect(BlindCase& c, std::string_view name, double severity, std::uint64_t seed,
                 const MotionScale& scale) {
  const DrawnEffect* entry = find_drawn_effect(name);
  GAPSCOPE_REQUIRE(entry != nullptr);
  GAPSCOPE_REQUIRE(can_have(c.drive, *entry));
  EffectScale full{scale, severity, random_stream(seed, "blind effect")};
  entry->give(c, full);
}

}  // namespace gapscope::independent_plant
