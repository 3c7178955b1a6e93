#include "exports/flat.h"

#include <fmt/format.h>

#include "exports/flat_joint.h"
#include "exports/offset_mass.h"

namespace gapscope::internal::exports {
namespace {

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
