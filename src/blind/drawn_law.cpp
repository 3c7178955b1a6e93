#include "blind/drawn_law.h"

#include "base/require.h"
#include "gapscope/plant/effect.h"

namespace gapscope::blind {
namespace {

using independent_plant::AngleHarmonic;
using independent_plant::Effects;
using Numbers = std::vector<double>;

/// Amplitude of sin(n y) in sin(y + k sin y).
double harmonic(int n, double k) {
  const double lower = std::cyl_bessel_j(n - 1.0, k), upper = std::cyl_bessel_j(n + 1.0, k);
  return n % 2 == 0 ? lower + upper : lower - upper;
}

Numbers series(const AngleHarmonic& h) {
  GAPSCOPE_REQUIRE(h.second == 0.0 && h.third == 0.0);
  const double first = harmonic(1, h.skew);
  return {h.amplitude * first, h.periods_per_turn, h.phase_rad, harmonic(2, h.skew) / first};
}

struct Entry {
  const char* effect;
  LawForm form;
  Numbers (*numbers)(const Effects&);
};

/// In the order of the catalogue's specifications. What is not here has another law.
constexpr Entry kEntries[] = {
    {"motor_coulomb_friction", LawForm::kSame,
     [](const Effects& e) { return Numbers{e.motor.friction.level_nm}; }},
    {"friction_asymmetry", LawForm::kSame,
     [](const Effects& e) {
       const independent_plant::MotorFriction& f = e.motor.friction;
       return Numbers{f.level_nm, f.coulomb_ratio, f.viscous_ratio};
     }},
    {"stribeck_friction", LawForm::kSame,
     [](const Effects& e) {
       const independent_plant::MotorFriction& f = e.motor.friction;
       return Numbers{f.level_nm, f.stiction_ratio, f.stribeck_speed_rad_s, f.stribeck_exponent};
     }},
    {"presliding_friction", LawForm::kSame,
     [](const Effects& e) {
       const independent_plant::BristleFriction& b = e.motor.bristle;
       return Numbers{b.level_nm, b.length_rad, b.damping_nms};
     }},
    {"quadratic_drag", LawForm::kSame,
     [](const Effects& e) {
       return Numbers{e.motor.drag_nms2, e.motor.drag_exponent};
     }},
    {"cogging_torque", LawForm::kSeries, [](const Effects& e) { return series(e.motor.cogging); }},
    {"torque_ripple", LawForm::kSeries, [](const Effects& e) { return series(e.command.ripple); }},
    {"load_unbalance", LawForm::kSame,
     [](const Effects& e) {
       return Numbers{e.load.unbalance_nm, e.load.unbalance_phase_rad, e.load.unbalance_periods};
     }},
    {"constant_load_torque", LawForm::kSame,
     [](const Effects& e) { return Numbers{e.load.constant_torque_nm}; }},
    {"input_dead_zone", LawForm::kSame, [](const Effects& e) { return Numbers{e.command.dead_zone}; }},
    {"input_delay", LawForm::kSame, [](const Effects& e) { return Numbers{e.command.delay_s}; }},
    {"actuator_lag", LawForm::kSame, [](const Effects& e) { return Numbers{e.command.lag_s}; }},
    {"shaft_compliance", LawForm::kSame,
     [](const Effects& e) { return Numbers{e.contact.stiffness_nm_rad}; }},
    {"impact_damping", LawForm::kSame, [](const Effects& e) { return Numbers{e.contact.damping_nms_rad}; }},
    {"gap_eccentricity", LawForm::kSame,
     [](const Effects& e) {
       const independent_plant::ContactEffects& c = e.contact;
       return Numbers{c.eccentricity_rad, c.eccentricity_phase_rad, c.eccentricity_periods};
     }},
    {"contact_adhesion", LawForm::kSame, [](const Effects& e) { return Numbers{e.contact.release_nm}; }},
    {"encoder_eccentricity", LawForm::kSame,
     [](const Effects& e) {
       const independent_plant::SensorEffects& s = e.sensor;
       return Numbers{s.eccentricity_rad, s.eccentricity_phase_rad, s.eccentricity_periods};
     }},
    {"encoder_quantization", LawForm::kSame, [](const Effects& e) { return Numbers{e.sensor.quantum_rad}; }},
    {"measurement_lag", LawForm::kSame, [](const Effects& e) { return Numbers{e.sensor.lag_s}; }},
    {"viscous_drift", LawForm::kSame,
     [](const Effects& e) {
       return Numbers{e.motor.viscous_drift_ratio, e.motor.viscous_drift_time_s};
     }},
};

const Entry* entry_of(std::string_view effect) {
  for (const Entry& entry : kEntries)
    if (entry.effect == effect) return &entry;
  return nullptr;
}

}  // namespace

LawForm form_of(std::string_view effect) {
  const Entry* entry = entry_of(effect);
  return entry == nullptr ? LawForm::kAnother : entry->form;
}

DrawnLaw drawn_law(const Effects& effects, std::string_view effect) {
  DrawnLaw law{std::string(effect), form_of(effect), {}};
  const Entry* entry = entry_of(effect);
  if (entry == nullptr) return law;
  const EffectEntry* told = find_effect(law.effect);
  GAPSCOPE_REQUIRE(told != nullptr);
  const Numbers numbers = entry->numbers(effects);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    law.numbers.push_back({told->parameters[i].key, told->parameters[i].unit, numbers[i], {}});
  return law;
}

}  // namespace gapscope::blind
