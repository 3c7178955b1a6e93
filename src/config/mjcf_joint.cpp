#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "config/mjcf.h"
#include "config/mjcf_actuator.h"
#include "config/mjcf_gravity.h"
#include "config/mjcf_mass.h"
#include "config/mjcf_turn.h"

namespace gapscope::internal::config {
namespace {

using tinyxml2::XMLElement;

/// A joint whose range is below this stands for a gap where it has a neighbour on its body [rad].
constexpr double kWidestGap = 0.35;

constexpr double kRounding = 1e-9;  ///< of a number that is written

/// @throws ConfigError for one that neither turns nor slides, and where there are two
const XMLElement* joint_named(const Mjcf& m, const std::string& name) {
  std::vector<const XMLElement*> found;
  for (const XMLElement* e : elements_below(m.top(), "joint"))
    if (has_attribute(e, "name", name) && std::strcmp(e->Parent()->Value(), "body") == 0) found.push_back(e);
  const XMLElement* const joint = only_one(m.file(), found);
  if (joint == nullptr) return nullptr;
  require_type(m.file(), *joint, m.word(*joint, "type", "hinge"), {"hinge", "slide"});
  if (const auto axis = m.values(*joint, "axis"); !axis.empty()) require_direction(m.file(), *joint, axis);
  return joint;
}

/// How the compiled model tells what this file does not.
constexpr const char* kCompiled =
    "write an <inertial> (body_mass, body_ipos, body_iquat, body_inertia of the compiled model), or give the "
    "file that mj_saveLastXML writes under <compiler saveinertial=\"true\"/>";

/// Of the joint's own body, with what is fixed to it, about its axis; NaN where it is not known.
double body_inertia_of(const Mjcf& m, const XMLElement& joint, std::vector<std::string>& notes) {
  const FixedMass fixed = fixed_mass(m, *joint.Parent()->ToElement());
  if (!fixed.unknown.empty())
    notes.push_back(fmt::format("{}, which is not read: {}", fixed.unknown, kCompiled));
  if (!fixed.unknown.empty() || fixed.mass == 0.0) {
    notes.push_back("of the inertia only the armature was taken: the body's own is not known");
    return kNaN;
  }
  if (!fixed.moving.empty())
    notes.push_back(
        "the inertia is that of the joint's own body and the armature, not of the bodies behind it");
  if (m.slides(joint)) return fixed.mass;
  const Eigen::Vector3d axis = three_of(m, joint, "axis", Eigen::Vector3d::UnitZ());
  return fixed.inertia_about(axis, three_of(m, joint, "pos"));
}

/// With the armature.
double inertia_with(const Mjcf& m, const XMLElement& joint, double body) {
  const double armature = m.amount_of(joint, "armature", 0.0);
  if (std::isfinite(body)) return armature + body;
  return armature > 0.0 ? armature : kNaN;
}

/// Stiffness and damping of a tendon's limit, if it is told by them.
void read_contact(const Mjcf& m, const XMLElement& fixed, double mobility, JointNumbers& n) {
  const auto contact = m.values(fixed, "solreflimit");
  if (contact.size() == 2 && contact[0] < 0.0)
    n.stiffness = -contact[0] / mobility, n.contact_damping = -contact[1] / mobility;
}

void read_load(const Mjcf& m, const XMLElement& load, const std::string& name, JointNumbers& n) {
  n.load_joint = name;
  n.load_body_inertia = body_inertia_of(m, load, n.notes);
  n.load_inertia = inertia_with(m, load, n.load_body_inertia);
  n.load_damping = m.amount_of(load, "damping", 0.0);
  n.load_friction = m.amount_of(load, "frictionloss", 0.0);
  n.load_constant_torque = actuation_of(m, name).constant;
}

/// A fixed tendon joint − other with a range: the gap of two bodies; of the joint alone, if it is narrow: to
/// the ground.  @returns the other joint
const XMLElement* read_tendon(const Mjcf& m, const std::string& joint, JointNumbers& n) {
  for (const XMLElement* fixed : elements_below(m.top(), "fixed")) {
    std::string other;
    double own = 0.0, others = 0.0;  // coef
    std::size_t count = 0;
    for (const XMLElement* j = fixed->FirstChildElement("joint"); j != nullptr;
         j = j->NextSiblingElement("joint")) {
      const char* name = j->Attribute("joint");
      if (name == nullptr) continue;
      ++count;
      if (name == joint)
        own = std::abs(m.value(*j, "coef", 1.0));
      else
        other = name, others = std::abs(m.value(*j, "coef", 1.0));
    }
    const auto range = m.values(*fixed, "range");
    if (own == 0.0 || range.size() < 2 || !m.limited(*fixed)) continue;
    if (count > 2 || (count == 2 && std::abs(own - others) > kRounding * own)) {
      n.notes.push_back(fmt::format(
          "not taken: the range of the tendon of line {}, which is no gap between two joints that go "
          "alike (coef)",
          fixed->GetLineNum()));
      continue;
    }
    const double width = (range[1] - range[0]) / own;
    if (other.empty()) {
      if (!(width < kWidestGap)) continue;
      n.gap = width, n.locked = true;
      read_contact(m, *fixed, 1.0 / n.inertia, n);
      return nullptr;
    }
    const XMLElement* load = joint_named(m, other);
    if (load == nullptr) continue;
    n.gap = width;
    read_load(m, *load, other, n);
    read_contact(m, *fixed, 1.0 / n.inertia + 1.0 / n.load_inertia, n);
    return load;
  }
  return nullptr;
}

void read_actuation(const Mjcf& m, const std::string& joint, JointNumbers& n) {
  const Actuation a = actuation_of(m, joint);
  n.torque_constant = a.gain, n.constant_torque = a.constant, n.lag = a.lag, n.input_limit = a.limit;
  n.servo = a.servo;
  if (a.back_emf > 0.0) n.damping = (std::isnan(n.damping) ? 0.0 : n.damping) + a.back_emf;
  n.notes.insert(n.notes.end(), a.notes.begin(), a.notes.end());
}

void note_untaken(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  if (const auto by = m.values(joint, "springdamper"); by.size() == 2 && by[0] > 0.0 && by[1] > 0.0)
    n.notes.emplace_back(
        "not taken: springdamper of the joint, which MuJoCo turns into stiffness and damping: give these");
  if (m.text(joint, "actuatorfrcrange") != nullptr)
    n.notes.emplace_back("not taken: actuatorfrcrange of the joint: give it as the actuator's forcerange");
  const double stiffness = m.value(joint, "stiffness", 0.0);
  if (stiffness == 0.0) return;
  n.notes.push_back(fmt::format(
      "not taken: the joint's stiffness {:.4g} about springref {:.4g}: no effect is a spring to the ground",
      stiffness, m.turned(joint, "springref")));
}

/// A second, narrow joint of the same body about the same axis.
void read_neighbour(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  const auto axis = [&](const XMLElement& j) { return three_of(m, j, "axis", Eigen::Vector3d::UnitZ()); };
  const Eigen::Vector3d own = axis(joint).normalized();
  for (const XMLElement* j = joint.Parent()->FirstChildElement("joint"); j != nullptr;
       j = j->NextSiblingElement("joint")) {
    if (j == &joint || m.slides(*j) != n.slides || own.cross(axis(*j).normalized()).norm() > 1e-6) continue;
    if (const double width = m.range_width(*j); width > 0.0 && width < kWidestGap) {
      n.gap = width;
      n.notes.push_back(
          "the gap is the range of a second joint of the same body: there the load's friction and damping have no "
          "place of their own, so they are left to the fit");
      return;
    }
  }
}

/// Where another body on the same axis would stand.
void read_place(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  for (const char* key : {"pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"})
    if (const char* value = joint.Parent()->ToElement()->Attribute(key); value != nullptr)
      n.body_place += fmt::format(" {}=\"{}\"", key, value);
  const Eigen::Vector3d axis = three_of(m, joint, "axis", Eigen::Vector3d::UnitZ()),
                        at = three_of(m, joint, "pos");
  n.axis_place = fmt::format("axis=\"{} {} {}\"", axis.x(), axis.y(), axis.z());
  if (at.norm() > 0.0) n.axis_place += fmt::format(" pos=\"{} {} {}\"", at.x(), at.y(), at.z());
}

}  // namespace

JointNumbers mjcf_joint(const XMLElement& mujoco, const std::string& file, const std::string& name) {
  const Mjcf m(mujoco, file);
  const XMLElement* joint = joint_named(m, name);
  if (joint == nullptr) no_such_joint(mujoco, file, name);
  JointNumbers n;
  read_place(m, *joint, n);
  n.slides = m.slides(*joint);
  n.body_inertia = body_inertia_of(m, *joint, n.notes);
  n.inertia = inertia_with(m, *joint, n.body_inertia);
  n.damping = m.amount_of(*joint, "damping", 0.0);
  n.friction = m.amount_of(*joint, "frictionloss", 0.0);
  read_actuation(m, name, n);
  const XMLElement* const load = read_tendon(m, name, n);
  if (!(n.gap > 0.0)) read_neighbour(m, *joint, n);
  read_gravity(m, load != nullptr ? *load : *joint, n);
  (load != nullptr ? n.load_constant_torque : n.constant_torque) += n.weight;
  note_untaken(m, *joint, n);
  return n;
}

}  // namespace gapscope::internal::config
