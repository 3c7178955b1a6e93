#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "config/joint_reader.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

using tinyxml2::XMLElement;

/// A joint whose range is below this stands for a gap where it has a neighbour on its body [rad].
constexpr double kWidestGap = 0.35;

bool has_attribute(const XMLElement* e, const char* name, const std::string& value) {
  return e != nullptr && e->Attribute(name) != nullptr && e->Attribute(name) == value;
}

/// An MJCF with its defaults: what an element does not say its class does, and the class around that.
class Mjcf {
 public:
  Mjcf(const XMLElement& top, const std::string& file) : top_(top), file_(file) {
    for (const XMLElement* e = top.FirstChildElement("default"); e != nullptr;
         e = e->NextSiblingElement("default"))
      add_class(*e, "main", "");
    const XMLElement* compiler = top.FirstChildElement("compiler");
    degrees_ = !has_attribute(compiler, "angle", "radian");
    includes_ = !elements_below(top, "include").empty();
  }

  const XMLElement& top() const { return top_; }
  const std::string& file() const { return file_; }
  bool includes() const { return includes_; }

  std::vector<double> values(const XMLElement& e, const char* attribute) const {
    if (const char* own = e.Attribute(attribute)) return numbers_in(own, file_);
    for (std::string of = class_of(e);;) {
      const auto found = classes_.find(of);
      if (found == classes_.end()) return {};
      const XMLElement* defaults = found->second.element->FirstChildElement(e.Name());
      if (defaults != nullptr && defaults->Attribute(attribute) != nullptr)
        return numbers_in(defaults->Attribute(attribute), file_);
      if (found->second.parent.empty()) return {};
      of = found->second.parent;
    }
  }

  double value(const XMLElement& e, const char* attribute, double otherwise) const {
    const auto found = values(e, attribute);
    return found.empty() ? otherwise : found[0];
  }

  /// Of a joint, in rad or m.
  double range_width(const XMLElement& joint) const {
    const auto range = values(joint, "range");
    if (range.size() < 2) return kNaN;
    const bool turned = degrees_ && !has_attribute(&joint, "type", "slide");
    return (range[1] - range[0]) * (turned ? kPi / 180.0 : 1.0);
  }

 private:
  struct DefaultClass {
    const XMLElement* element;
    std::string parent;
  };

  void add_class(const XMLElement& e, const std::string& otherwise, const std::string& parent) {
    const std::string name = e.Attribute("class") != nullptr ? e.Attribute("class") : otherwise;
    classes_.insert({name, {&e, parent}});
    for (const XMLElement* in = e.FirstChildElement("default"); in != nullptr;
         in = in->NextSiblingElement("default"))
      add_class(*in, "main", name);
  }

  std::string class_of(const XMLElement& e) const {
    if (e.Attribute("class") != nullptr) return e.Attribute("class");
    for (const tinyxml2::XMLNode* up = e.Parent(); up != nullptr; up = up->Parent())
      if (up->ToElement() != nullptr && up->ToElement()->Attribute("childclass") != nullptr)
        return up->ToElement()->Attribute("childclass");
    return "main";
  }

  const XMLElement& top_;
  std::string file_;
  std::map<std::string, DefaultClass> classes_;
  bool degrees_ = true, includes_ = false;
};

const XMLElement* joint_named(const Mjcf& m, const std::string& name) {
  for (const XMLElement* e : elements_below(m.top(), "joint"))
    if (has_attribute(e, "name", name) && std::strcmp(e->Parent()->Value(), "body") == 0) return e;
  return nullptr;
}

/// Of the joint's own body about its axis, and the armature.
double inertia_of(const Mjcf& m, const XMLElement& joint, std::vector<std::string>& notes) {
  const double armature = m.value(joint, "armature", 0.0);
  const XMLElement* body = joint.Parent()->ToElement();
  const XMLElement* inertial = body == nullptr ? nullptr : body->FirstChildElement("inertial");
  if (inertial == nullptr || inertial->Attribute("quat") != nullptr ||
      inertial->Attribute("euler") != nullptr) {
    notes.push_back(
        "of the inertia only the armature was taken: the body's own is not given by an upright inertial");
    return armature > 0.0 ? armature : kNaN;
  }
  if (body->FirstChildElement("body") != nullptr)
    notes.push_back(
        "the inertia is that of the joint's own body and the armature, not of the bodies behind it");
  const double mass = m.value(*inertial, "mass", 0.0);
  if (has_attribute(&joint, "type", "slide")) return armature + mass;
  auto tensor = m.values(*inertial, "fullinertia");
  if (tensor.empty()) tensor = m.values(*inertial, "diaginertia");
  tensor.resize(6, 0.0);
  auto axis = m.values(joint, "axis"), centre = m.values(*inertial, "pos"), at = m.values(joint, "pos");
  if (axis.size() != 3) axis = {0.0, 0.0, 1.0};
  centre.resize(3, 0.0), at.resize(3, 0.0);
  for (std::size_t i = 0; i < 3; ++i) centre[i] -= at[i];
  return armature + inertia_about(axis, mass, centre, tensor);
}

double gear_of(const Mjcf& m, const std::string& joint, std::vector<std::string>& notes) {
  const XMLElement* actuators = m.top().FirstChildElement("actuator");
  if (actuators == nullptr) return kNaN;
  for (const XMLElement* e = actuators->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string kind = e->Name();
    const auto gain = m.values(*e, "gainprm");
    if (!has_attribute(e, "joint", joint) || (!gain.empty() && gain[0] == 0.0)) continue;
    if (kind != "motor" && kind != "general")
      notes.push_back("the actuator is of kind " + kind +
                      ": its control is no torque, so torque_constant is the gear");
    return m.value(*e, "gear", 1.0) * (kind == "general" && !gain.empty() ? gain[0] : 1.0);
  }
  return kNaN;
}

/// A fixed tendon joint − other with a range: the gap of two bodies.
bool read_tendon(const Mjcf& m, const std::string& joint, JointNumbers& n) {
  for (const XMLElement* fixed : elements_below(m.top(), "fixed")) {
    std::string other;
    bool mine = false;
    for (const XMLElement* j = fixed->FirstChildElement("joint"); j != nullptr;
         j = j->NextSiblingElement("joint")) {
      const char* name = j->Attribute("joint");
      if (name == nullptr) continue;
      if (name == joint)
        mine = true;
      else
        other = name;
    }
    const auto range = m.values(*fixed, "range");
    if (!mine || other.empty() || range.size() < 2) continue;
    const XMLElement* load = joint_named(m, other);
    if (load == nullptr) continue;
    n.gap = range[1] - range[0];
    n.load_inertia = inertia_of(m, *load, n.notes);
    n.load_damping = m.value(*load, "damping", 0.0);
    n.load_friction = m.value(*load, "frictionloss", 0.0);
    const double mobility = 1.0 / n.inertia + 1.0 / n.load_inertia;
    const auto contact = m.values(*fixed, "solreflimit");
    if (contact.size() == 2 && contact[0] < 0.0)
      n.stiffness = -contact[0] / mobility, n.contact_damping = -contact[1] / mobility;
    return true;
  }
  return false;
}

/// A second, narrow joint of the same body.
void read_neighbour(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  for (const XMLElement* j = joint.Parent()->FirstChildElement("joint"); j != nullptr;
       j = j->NextSiblingElement("joint"))
    if (const double width = m.range_width(*j); j != &joint && width > 0.0 && width < kWidestGap) {
      n.gap = width;
      n.notes.push_back(
          "the gap is the range of a second joint of the same body: there the load's friction and damping "
          "have no "
          "place of their own, so they are left to the fit");
      return;
    }
}

}  // namespace

JointNumbers mjcf_joint(const XMLElement& mujoco, const std::string& file, const std::string& name) {
  const Mjcf m(mujoco, file);
  const XMLElement* joint = joint_named(m, name);
  if (joint == nullptr) no_such_joint(mujoco, file, name);
  JointNumbers n;
  n.slides = has_attribute(joint, "type", "slide");
  n.inertia = inertia_of(m, *joint, n.notes);
  n.damping = m.value(*joint, "damping", 0.0);
  n.friction = m.value(*joint, "frictionloss", 0.0);
  n.torque_constant = gear_of(m, name, n.notes);
  if (!read_tendon(m, name, n)) read_neighbour(m, *joint, n);
  if (m.includes()) n.notes.push_back("included files were not read");
  return n;
}

}  // namespace gapscope::internal::config
