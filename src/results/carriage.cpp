#include "results/carriage.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"

namespace gapscope {
namespace {

constexpr Fidelity kWhole = Fidelity::kExact, kNearly = Fidelity::kApproximate, kNot = Fidelity::kLeftOut;
constexpr const char* kSummed = "in the joint's own, which is right while motor and load move together";

constexpr Carriage kByMjcf[] = {
    {"motor_inertia", kWhole, "inertial of the motor's body"},
    {"torque_constant", kWhole, "gear of the actuator; ctrl is u"},
    {"motor_damping", kWhole, "damping of the motor's joint"},
    {"mass_ratio", kWhole, "inertial of the load's body"},
    {"gap", kWhole, "range of the fixed tendon motor − load"},
    {"load_damping", kWhole, "damping of the load's joint"},
    {"load_coulomb_friction", kWhole,
     "frictionloss with solreffriction and solimpfriction that hold; the defaults creep"},
    {"contact_stiffness", kWhole, "solreflimit of the tendon: −k (1/m1 + 1/m2), solimplimit 1e-4"},
    {"contact_damping", kWhole, "solreflimit of the tendon: −c (1/m1 + 1/m2)"},
    {"motor_coulomb_friction", kWhole, "frictionloss of the motor's joint"},
    {"friction_asymmetry", kNearly,
     "frictionloss of the mean level and a constant actuator for the difference; the viscous part is the mean of "
     "both directions, the rest needs qfrc_applied in your loop",
     "viscous_ratio"},
    {"stribeck_friction", kNearly,
     "frictionloss of the level at speed; what break-away needs beyond it calls for MuJoCo 3.7 (dcmotor with lugre)"},
    {"presliding_friction", kNearly,
     "frictionloss of the level; the bristle needs MuJoCo 3.7 (dcmotor with lugre)"},
    {"load_dependent_friction", kNearly,
     "frictionloss of the level; what grows with the torque needs qfrc_applied in your loop"},
    {"constant_load_torque", kWhole, "a general actuator with a bias and no gain"},
    {"load_unbalance",
     kWhole,
     "a mass beside the axis, under gravity 9.81 m/s² along −z; only m g r is known, and the mass stands for it "
     "at an arm that is assumed",
     {},
     "periods_per_turn"},
    {"shaft_compliance", kWhole, "solreflimit of the tendon"},
    {"impact_damping", kWhole, "solreflimit of the tendon"},
    {"contact_hardening", kNearly, "the stiffness at first touch"},
    {"backlash", kNearly, "a stiff contact in place of an impact"},
    {"torque_saturation", kNearly, "ctrlrange: a hard limit at the knee"},
    {"actuator_lag", kWhole, "dyntype filter of the actuator"},
};

constexpr Carriage kByC[] = {
    {"motor_inertia", kWhole, "m1"},
    {"torque_constant", kWhole, "km"},
    {"motor_damping", kWhole, "d1_plus, d1_minus"},
    {"mass_ratio", kWhole, "m2"},
    {"gap", kWhole, "half_gap; closing and opening at their own instants"},
    {"load_damping", kWhole, "d2"},
    {"load_coulomb_friction", kWhole, "f2, set-valued at rest"},
    {"contact_stiffness", kWhole, "k"},
    {"contact_damping", kWhole, "c"},
    {"motor_coulomb_friction", kWhole, "f1_plus, f1_minus, set-valued at rest"},
    {"friction_asymmetry", kWhole, "f1_plus, f1_minus, d1_plus, d1_minus"},
    {"stribeck_friction", kWhole, "f1 at rest, stiction at speed"},
    {"quadratic_drag", kWhole, "drag"},
    {"cogging_torque", kWhole, "cogging"},
    {"torque_ripple", kWhole, "ripple"},
    {"load_unbalance", kWhole, "unbalance"},
    {"constant_load_torque", kWhole, "load_torque"},
    {"torque_saturation", kWhole, "knee, sharpness"},
    {"input_dead_zone", kWhole, "dead_zone"},
    {"input_delay", kWhole, "delay, fractions of a step too"},
    {"actuator_lag", kWhole, "lag"},
    {"shaft_compliance", kWhole, "k"},
    {"impact_damping", kWhole, "c"},
    {"contact_adhesion", kWhole, "adhesion"},
    {"presliding_friction", kNearly, "f1 of its level; the bristle is left out"},
    {"load_dependent_friction", kNearly, "f1 of its level; what grows with the torque is left out"},
    {"contact_hardening", kNearly, "k at first touch"},
    {"backlash", kNearly, "a stiff contact in place of an impact"},
};

constexpr Carriage kByLink[] = {
    {"torque_constant", kNot, "yours to apply: the torque of the joint is torque_constant times u"},
    {"motor_inertia", kNearly, "in the link's inertia: the format has no armature"},
    {"mass_ratio", kNearly, "in the link's inertia, which is right while motor and load move together"},
    {"motor_damping", kWhole, "damping of the joint"},
    {"load_damping", kNearly, kSummed},
    {"load_coulomb_friction", kNearly, kSummed},
    {"motor_coulomb_friction", kWhole,
     "friction of the joint; whether it holds at rest is the engine's affair"},
    {"friction_asymmetry", kNearly, "friction of the joint: the mean level"},
    {"stribeck_friction", kNearly, "friction of the joint: the level at speed"},
    {"presliding_friction", kNearly, "friction of the joint: the level"},
    {"load_dependent_friction", kNearly, "friction of the joint: the level without torque"},
    {"load_unbalance",
     kWhole,
     "a mass beside the axis, under gravity 9.81 m/s² along −z",
     {},
     "periods_per_turn"},
};

constexpr Carriage kByIsaac[] = {
    {"torque_constant", kNot, "yours to apply: the torque of the joint is torque_constant times u"},
    {"motor_inertia", kWhole, "armature"},
    {"mass_ratio", kNearly, "the link's own inertia, which the file gives as a comment"},
    {"motor_damping", kWhole, "viscous_friction; damping is a gain of the controller there"},
    {"load_damping", kNearly, kSummed},
    {"load_coulomb_friction", kNearly, kSummed},
    {"motor_coulomb_friction", kWhole, "friction and dynamic_friction"},
    {"friction_asymmetry", kNearly, "friction: the mean level"},
    {"stribeck_friction", kNearly, "friction at rest, dynamic_friction at speed; nothing between"},
    {"presliding_friction", kNearly, "friction: the level"},
    {"load_dependent_friction", kNearly, "friction: the level without torque"},
};

constexpr Carriage kByBam[] = {
    {"torque_constant", kNot, "yours to apply: the torque of the joint is torque_constant times u"},
    {"motor_inertia", kWhole, "armature"},
    {"mass_ratio", kNearly, "the inertia that the simulation has behind the joint"},
    {"motor_damping", kWhole, "friction_viscous"},
    {"load_damping", kNearly, kSummed},
    {"load_coulomb_friction", kNearly, kSummed},
    {"motor_coulomb_friction", kWhole, "friction_base"},
    {"friction_asymmetry", kNearly, "friction_base: the mean level"},
    {"stribeck_friction", kWhole, "friction_base, friction_stribeck, dtheta_stribeck, alpha"},
    {"presliding_friction", kNearly, "friction_base: the level"},
    {"load_dependent_friction", kNearly,
     "friction_base and load_friction_base, per torque of the motor less that outside"},
};

constexpr TargetTable kTables[] = {{"mjcf", kByMjcf}, {"c", kByC},         {"sdf", kByLink},
                                   {"urdf", kByLink}, {"isaac", kByIsaac}, {"bam", kByBam}};

double number_of(const AddedEffect& added, std::string_view key) {
  for (const NamedValue& p : added.parameters)
    if (p.key == key) return p.value;
  return kNaN;
}

bool has_exactly(std::span<const Carriage> table, std::string_view part) {
  return std::ranges::any_of(
      table, [&](const Carriage& c) { return c.part == part && c.fidelity == Fidelity::kExact; });
}

bool has_exactly(std::span<const Carriage> table, const AddedEffect& added) {
  constexpr double kRounding = 1e-9;
  const auto by = std::ranges::find(table, added.effect, &Carriage::part);
  if (by == table.end()) return false;
  if (!by->only_at_one.empty() && !(std::abs(number_of(added, by->only_at_one) - 1.0) < kRounding))
    return false;
  return by->fidelity == Fidelity::kExact ||
         (!by->exact_without.empty() && number_of(added, by->exact_without) == 0.0);
}

}  // namespace

std::span<const TargetTable> target_tables() { return kTables; }

std::span<const Carriage> carriage_of(std::string_view format) {
  const auto table = std::ranges::find(kTables, format, &TargetTable::format);
  GAPSCOPE_REQUIRE(table != std::end(kTables));
  return table->parts;
}

std::vector<std::string> carriers_of(std::span<const AddedEffect> added, bool gap) {
  std::vector<std::string> formats;
  for (const TargetTable& t : kTables) {
    const bool drive = has_exactly(t.parts, "motor_inertia") && (!gap || has_exactly(t.parts, "gap"));
    const bool all =
        std::ranges::all_of(added, [&](const AddedEffect& a) { return has_exactly(t.parts, a); });
    if (drive && all) formats.emplace_back(t.format);
  }
  return formats;
}

std::vector<std::string> carried_by_none(std::span<const AddedEffect> added) {
  std::vector<std::string> effects;
  for (const AddedEffect& a : added)
    if (std::ranges::none_of(kTables, [&](const TargetTable& t) { return has_exactly(t.parts, a); }))
      effects.push_back(a.effect);
  return effects;
}

}  // namespace gapscope
