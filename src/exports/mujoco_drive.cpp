#include "exports/mujoco_drive.h"

#include <algorithm>

#include "exports/stiff_contact.h"

namespace gapscope::internal::exports {
namespace {

constexpr Fidelity kApproximate = Fidelity::kApproximate;

constexpr const char* kOtherwise =
    "MJCF of MuJoCo 2.2 has no element for it; --to c gives it as code for a callback or your loop";

/// Levels of dry friction as an MJCF has them: what holds only at rest, or only under torque, is not theirs.
void set_motor_friction(const ExportSource& s, MujocoDrive& d) {
  const double spared = effect_value(s, "stribeck_friction", "level_nm") *
                        effect_value(s, "stribeck_friction", "stiction_ratio");
  const double bristle = effect_value(s, "presliding_friction", "level_nm");
  const double plus = s.plant.motor_friction_plus - spared + bristle;
  const double minus = s.plant.motor_friction_minus - spared + bristle;
  d.friction[0] = std::max(0.5 * (plus + minus), 0.0);
  d.constant[0] = 0.5 * (minus - plus);
}

}  // namespace

MujocoDrive mujoco_drive(const ExportSource& s) {
  const DriveParameters<double>& p = s.plant.drive;
  MujocoDrive d;
  d.has_load = s.plant.structure.has_load;
  d.locked = d.has_load && s.plant.structure.load == LoadKind::kLocked;
  d.inertia[0] = p.motor_inertia, d.inertia[1] = p.motor_inertia * p.mass_ratio;
  d.damping[0] = p.motor_damping, d.damping[1] = p.load_damping;
  set_motor_friction(s, d);
  d.friction[1] = p.load_coulomb_friction;
  d.constant[d.has_load ? 1 : 0] += s.plant.load_torque;
  d.torque_constant = p.torque_constant;
  d.lag = effect_value(s, "actuator_lag", "time_constant_s");
  const double knee = effect_value(s, "torque_saturation", "knee");
  if (knee > 0.0) d.input_limit = knee;
  d.first_input = s.u.front();
  d.half_gap = 0.5 * p.gap, d.stiffness = p.contact_stiffness, d.contact_damping = p.contact_damping;
  d.load_place = s.initial.x2;
  if (hangs_from_the_axis(s)) {
    d.unbalance = effect_value(s, "load_unbalance", "amplitude_nm");
    d.unbalance_phase = effect_value(s, "load_unbalance", "phase_rad");
    d.hangs = s.hangs;
  }
  d.place[0] = s.initial.x1, d.place[1] = s.initial.x2;
  d.speed[0] = s.initial.w1, d.speed[1] = s.initial.w2;
  if (d.has_load && s.plant.structure.contact == ContactLaw::kRigid) {
    const StiffContact stiff = stiff_contact(s.plant.structure, d.contact_mobility());
    d.stiffness = stiff.stiffness, d.contact_damping = stiff.damping;
  }
  return d;
}

std::vector<CarriedPart> mujoco_parts(const ExportSource& s) {
  std::vector<CarriedPart> parts = carried_parts(s, carriage_of("mjcf"), kOtherwise);
  for (CarriedPart& part : parts) {
    if (part.part == "gap" && s.drive.structure.contact == ContactLaw::kRigid)
      part = {"gap", kApproximate, "range of the fixed tendon; a stiff contact in place of the impact law"};
    if (part.part == "load_unbalance" && !hangs_from_the_axis(s))
      part = {"load_unbalance", Fidelity::kLeftOut, kOtherwise};
  }
  return parts;
}

}  // namespace gapscope::internal::exports
