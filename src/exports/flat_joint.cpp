#include "exports/flat_joint.h"

#include <algorithm>
#include <cmath>

#include "exports/left_out.h"
#include "exports/target_errors.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope::internal::exports {
namespace {

constexpr const char* kNotFlat =
    "one joint with inertia, damping and friction has no place for it; --to mjcf has one for a gap, --to c for most";

bool is_free(const ExportSource& s) {
  return s.plant.structure.has_load && s.plant.structure.load == LoadKind::kFree;
}

/// The same drive as the target has it.
ExportSource flattened(const ExportSource& s, bool with_unbalance) {
  const FlatJoint joint = flat_joint(s);
  ExportSource flat = s;
  DriveParameters<double> drive = s.plant.drive;
  DriveStructure structure;
  structure.has_load = joint.limited;
  if (joint.limited)
    structure.load = LoadKind::kLocked, structure.contact = ContactLaw::kRigid, structure.restitution = 0.0;
  drive.motor_inertia = joint.armature + joint.link;
  drive.motor_damping = joint.damping;
  flat.plant = gapscope::plant_model(drive, structure);
  flat.plant.load_sticks = false;
  flat.plant.motor_sticks = joint.friction > 0.0;
  flat.plant.motor_friction_plus = flat.plant.motor_friction_minus = joint.friction;
  if (with_unbalance && joint.unbalance > 0.0) {
    const double parameters[] = {joint.unbalance, joint.unbalance_phase, 1.0};
    add_effect<double>(flat.plant, *find_effect("load_unbalance"), parameters);
  }
  return flat;
}

}  // namespace

FlatJoint flat_joint(const ExportSource& s) {
  const DriveParameters<double>& p = s.plant.drive;
  const auto of = [&](const char* effect, const char* key) { return effect_value(s, effect, key); };
  FlatJoint joint;
  joint.armature = p.motor_inertia;
  joint.damping = p.motor_damping;
  joint.break_away = of("stribeck_friction", "level_nm") * of("stribeck_friction", "stiction_ratio");
  joint.stribeck_speed = of("stribeck_friction", "stribeck_speed_rad_s");
  joint.stribeck_exponent = of("stribeck_friction", "exponent");
  joint.load_share = of("load_dependent_friction", "ratio");
  joint.friction = 0.5 * (s.plant.motor_friction_plus + s.plant.motor_friction_minus) - joint.break_away +
                   of("presliding_friction", "level_nm");
  joint.friction = std::max(joint.friction, 0.0);
  if (is_free(s)) {
    joint.link = p.motor_inertia * p.mass_ratio;
    joint.damping += p.load_damping;
    joint.friction += p.load_coulomb_friction;
  }
  if (hangs_from_the_axis(s)) {
    joint.unbalance = of("load_unbalance", "amplitude_nm");
    joint.unbalance_phase = of("load_unbalance", "phase_rad");
    joint.hangs = s.hangs;
  }
  joint.limited = s.plant.structure.has_load && s.plant.structure.load == LoadKind::kLocked;
  joint.low = s.initial.x2 - 0.5 * p.gap, joint.high = s.initial.x2 + 0.5 * p.gap;
  for (const double u : s.u) joint.effort = std::max(joint.effort, std::abs(p.torque_constant * u));
  return joint;
}

Certificate flat_certificate(const ExportSource& s, std::span<const Carriage> table, bool with_unbalance) {
  Certificate c;
  c.parts = carried_parts(s, table, kNotFlat);
  for (CarriedPart& part : c.parts)
    if (part.part == "load_unbalance" && !hangs_from_the_axis(s))
      part = {"load_unbalance", Fidelity::kLeftOut, kNotFlat};
  add_loop_lines(s, {"q", "dq", "effort", s.plant.drive.torque_constant, "effort", s.dt}, c);
  std::vector<double> times;
  for (std::size_t i = 0; i <= s.u.size(); ++i) times.push_back(s.dt * static_cast<double>(i));
  const std::vector<double> model = model_motion(s, times);
  const std::vector<double> target = model_motion(flattened(s, with_unbalance), times);
  TargetError e = compared(model, target);
  e.integrator = "an engine without error";
  e.within_encoder = e.rms <= s.encoder_floor;
  c.errors.push_back(e);
  c.travel = range_of(model);
  return c;
}

}  // namespace gapscope::internal::exports
