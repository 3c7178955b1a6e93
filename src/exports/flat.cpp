#include "exports/flat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "exports/carried.h"
#include "exports/left_out.h"
#include "exports/offset_mass.h"
#include "exports/target_errors.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope::internal::exports {
namespace {

/// What is left of a drive in one joint.
struct FlatJoint {
  double armature = 0.0;                                 ///< inertia of the motor [kg m²]
  double link = 0.0;                                     ///< of the load [kg m²]
  double damping = 0.0;                                  ///< of both [N m s/rad]
  double friction = 0.0;                                 ///< of both, at speed [N m]
  double break_away = 0.0;                               ///< beyond it, at rest [N m]
  double stribeck_speed = 0.0, stribeck_exponent = 2.0;  ///< at which that has gone [rad/s]
  double load_share = 0.0;                               ///< friction per torque of the gears [-]
  double unbalance = 0.0, unbalance_phase = 0.0;
  KnownMass hangs = {};          ///< what is known to make it
  bool limited = false;          ///< the output is held: the joint moves within the gap
  double low = 0.0, high = 0.0;  ///< [rad]
  double effort = 0.0;           ///< most torque that the input brings [N m]
};

constexpr const char* kNotFlat =
    "one joint with inertia, damping and friction has no place for it; --to mjcf has one for a gap, --to c for most";

bool is_free(const ExportSource& s) {
  return s.plant.structure.has_load && s.plant.structure.load == LoadKind::kFree;
}

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

/// The certificate of a format of this kind: its table's rows, and the error of inertia, damping, friction
/// and, where the format has it, unbalance, in an engine that makes no error of its own.
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

/// The link that turns or slides, in the words that URDF and SDF share.
OffsetMass link_mass(const FlatJoint& joint, bool turns) {
  const double inertia = joint.armature + joint.link;
  OffsetMass m = offset_mass(inertia, joint.unbalance, joint.unbalance_phase, joint.hangs);
  if (!turns) m.mass = inertia;
  return m;
}

std::string urdf_text(const ExportSource& s, const FlatJoint& j) {
  const bool turns = s.coordinates.rotational();
  const OffsetMass m = link_mass(j, turns);
  const std::string type = !turns ? "prismatic" : j.limited ? "revolute" : "continuous";
  const std::string range = type == "continuous" ? ""
                            : j.limited          ? fmt::format(" lower=\"{}\" upper=\"{}\"", j.low, j.high)
                                                 : " lower=\"-1000\" upper=\"1000\"";
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {0} by gapscope: inertia, damping and friction; certificate.md names "
      "what is lost. -->\n<robot name=\"{0}\">\n  <link name=\"{0}_base\"/>\n  <link name=\"{0}_output\">\n  "
      "  <inertial>\n"
      "      <origin xyz=\"{1:.12g} 0 {2:.12g}\"/>\n      <mass value=\"{3:.12g}\"/>\n      <inertia "
      "ixx=\"{4:.12g}\" ixy=\"0\" ixz=\"0\" "
      "iyy=\"{4:.12g}\" iyz=\"0\" izz=\"{4:.12g}\"/>\n    </inertial>\n  </link>\n  <joint "
      "name=\"{0}_joint\" type=\"{5}\">\n"
      "    <parent link=\"{0}_base\"/>\n    <child link=\"{0}_output\"/>\n    <axis xyz=\"{6}\"/>\n    "
      "<limit effort=\"{7:.12g}\" velocity=\"1000\"{8}/>\n    <dynamics damping=\"{9:.12g}\" "
      "friction=\"{10:.12g}\"/>\n  </joint>\n</robot>\n",
      s.stem, m.x, m.z, m.mass, m.own, type, turns ? "0 1 0" : "1 0 0", j.effort, range, j.damping,
      j.friction);
}

std::string sdf_text(const ExportSource& s, const FlatJoint& j) {
  const bool turns = s.coordinates.rotational();
  const OffsetMass m = link_mass(j, turns);
  const std::string limit =
      j.limited ? fmt::format("<limit><lower>{}</lower><upper>{}</upper></limit>", j.low, j.high) : "";
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {0} by gapscope: inertia, damping and friction; certificate.md names "
      "what is lost. -->\n<sdf version=\"1.9\">\n  <model name=\"{0}\">\n    <link name=\"{0}_base\"/>\n    "
      "<joint name=\"{0}_fixed\" type=\"fixed\"><parent>world</parent><child>{0}_base</child></joint>\n    "
      "<link name=\"{0}_output\">\n      <inertial>\n        <pose>{1:.12g} 0 {2:.12g} 0 0 0</pose>\n        "
      "<mass>{3:.12g}</mass>\n"
      "        <inertia><ixx>{4:.12g}</ixx><iyy>{4:.12g}</iyy><izz>{4:.12g}</izz></inertia>\n      "
      "</inertial>\n    </link>\n"
      "    <joint name=\"{0}_joint\" type=\"{5}\">\n      <parent>{0}_base</parent>\n      "
      "<child>{0}_output</child>\n"
      "      <axis>\n        <xyz>{6}</xyz>\n        {7}\n        "
      "<dynamics><damping>{8:.12g}</damping><friction>{9:.12g}"
      "</friction></dynamics>\n      </axis>\n    </joint>\n  </model>\n</sdf>\n",
      s.stem, m.x, m.z, m.mass, m.own, turns ? "revolute" : "prismatic", turns ? "0 1 0" : "1 0 0", limit,
      j.damping, j.friction);
}

std::string isaac_text(const ExportSource& s, const FlatJoint& j) {
  return fmt::format(
      "# {0} by gapscope for Isaac Lab: inertia, damping and friction; certificate.md names what is lost.\n"
      "# The link behind the joint has {1:.12g} kg m^2 beside what else hangs there (kg on a slide).\n"
      "from isaaclab.actuators import ImplicitActuatorCfg\n\n{2} = ImplicitActuatorCfg(\n"
      "    joint_names_expr=[\"{0}_joint\"],\n    stiffness=0.0,  # effort targets; gains of a controller of "
      "yours go here\n    damping=0.0,\n    armature={3:.12g},\n    friction={4:.12g},  # at rest\n    "
      "dynamic_friction={5:.12g},\n"
      "    viscous_friction={6:.12g},\n)\n",
      s.stem, j.link, s.stem + "_cfg", j.armature, j.friction + j.break_away, j.friction, j.damping);
}

/// The least of BAM's friction models that has what the drive has.
std::string bam_text(const ExportSource& s, const FlatJoint& j) {
  const bool stribeck = j.break_away != 0.0, loaded = j.load_share > 0.0;
  std::string text = fmt::format(
      "{{\n  \"model\": \"{}\",\n  \"actuator\": \"{}\",\n  \"armature\": {:.12g},\n  \"friction_base\": "
      "{:.12g},\n  \"friction_viscous\": {:.12g}",
      loaded ? (stribeck ? "m4" : "m3") : (stribeck ? "m2" : "m1"), s.stem, j.armature, j.friction,
      j.damping);
  if (stribeck)
    text += fmt::format(
        ",\n  \"friction_stribeck\": {:.12g},\n  \"dtheta_stribeck\": {:.12g},\n  \"alpha\": {:.12g}",
        j.break_away, j.stribeck_speed, j.stribeck_exponent);
  if (loaded) text += fmt::format(",\n  \"load_friction_base\": {:.12g}", j.load_share);
  if (loaded && stribeck) text += ",\n  \"load_friction_stribeck\": 0.0";
  return text + "\n}\n";
}

DriveExport flat_export(const ExportSource& s, const char* format, const std::string& file,
                        std::span<const Carriage> table, bool with_unbalance,
                        std::string (*text)(const ExportSource&, const FlatJoint&)) {
  DriveExport out;
  out.certificate = flat_certificate(s, table, with_unbalance);
  out.certificate.format = format;
  out.files = {{file, text(s, flat_joint(s))}};
  return out;
}

}  // namespace

DriveExport export_urdf(const ExportSource& s) {
  return flat_export(s, "urdf", s.stem + ".urdf", carriage_of("urdf"), true, urdf_text);
}

DriveExport export_sdf(const ExportSource& s) {
  return flat_export(s, "sdf", s.stem + ".sdf", carriage_of("sdf"), true, sdf_text);
}

DriveExport export_isaac(const ExportSource& s) {
  return flat_export(s, "isaac", s.stem + "_cfg.py", carriage_of("isaac"), false, isaac_text);
}

DriveExport export_bam(const ExportSource& s) {
  DriveExport out = flat_export(s, "bam", s.stem + "_bam.json", carriage_of("bam"), false, bam_text);
  out.certificate.warnings.push_back(
      "kt and R are not in the file: a recording of u and x1 has only their quotient (torque_constant, with "
      "u in volts) and, in motor_damping, the back-EMF. Take them from the data sheet, and kt²/R off "
      "friction_viscous.");
  return out;
}

}  // namespace gapscope::internal::exports
