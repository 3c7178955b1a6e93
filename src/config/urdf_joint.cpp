#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "config/joint_reader.h"

namespace gapscope::internal::config {
namespace {

using tinyxml2::XMLElement;

const XMLElement* named(const XMLElement& robot, const std::string& file, const char* kind,
                        const std::string& name) {
  std::vector<const XMLElement*> found;
  for (const XMLElement* e = robot.FirstChildElement(kind); e != nullptr; e = e->NextSiblingElement(kind))
    if (e->Attribute("name") != nullptr && e->Attribute("name") == name) found.push_back(e);
  return only_one(file, found);
}

double attribute(const XMLElement* e, const char* name, const std::string& file) {
  const auto found = numbers_in(e == nullptr ? nullptr : e->Attribute(name), file);
  return found.empty() ? kNaN : found[0];
}

/// The same of what is not negative.
double amount_of(const XMLElement* e, const char* name, const std::string& file) {
  const double value = attribute(e, name, file);
  return e == nullptr ? value : amount(file, *e, name, value);
}

std::vector<double> three(const XMLElement* e, const char* name, const std::string& file) {
  auto found = numbers_in(e == nullptr ? nullptr : e->Attribute(name), file);
  found.resize(3, 0.0);
  return found;
}

/// x where nothing is said.
std::vector<double> axis_of(const XMLElement& joint, const std::string& file) {
  const XMLElement* const axis = joint.FirstChildElement("axis");
  if (axis == nullptr || axis->Attribute("xyz") == nullptr) return {1.0, 0.0, 0.0};
  const std::vector<double> along = three(axis, "xyz", file);
  require_direction(file, *axis, along);
  return along;
}

constexpr double kWeightOfOne = 9.81;  // N/kg

void read_link(const XMLElement& link, const std::vector<double>& along, const std::string& file,
               JointNumbers& n) {
  const XMLElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  const double mass = amount_of(inertial->FirstChildElement("mass"), "value", file);
  n.notes.push_back("the inertia is that of the link alone, not of what hangs behind it");
  if (n.slides) {
    n.inertia = mass;
    return;
  }
  const XMLElement* origin = inertial->FirstChildElement("origin");
  const double off = std::sqrt(inertia_about(along, 1.0, three(origin, "xyz", file), std::vector<double>(6)));
  if (off * mass > 0.0)
    n.notes.push_back(fmt::format(
        "not taken: gravity on the link, at most {:.3g} N m: a URDF does not say how its base stands; effect "
        "load_unbalance",
        kWeightOfOne * mass * off));
  const XMLElement* tensor = inertial->FirstChildElement("inertia");
  std::vector<double> t;
  for (const char* key : {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"}) {
    const bool own = key[1] == key[2];
    const double value = own ? amount_of(tensor, key, file) : attribute(tensor, key, file);
    t.push_back(std::isnan(value) ? 0.0 : value);
  }
  for (const double angle : three(origin, "rpy", file))
    if (angle != 0.0) {
      n.notes.push_back("the link's inertia is given in turned axes and was not taken");
      return;
    }
  n.inertia = inertia_about(along, std::isnan(mass) ? 0.0 : mass, three(origin, "xyz", file), t);
}

}  // namespace

JointNumbers urdf_joint(const XMLElement& robot, const std::string& file, const std::string& name) {
  const XMLElement* joint = named(robot, file, "joint", name);
  if (joint == nullptr) no_such_joint(robot, file, name);
  JointNumbers n;
  const char* type = joint->Attribute("type");
  require_type(file, *joint, type == nullptr ? "" : type, {"revolute", "continuous", "prismatic"});
  n.slides = std::strcmp(type, "prismatic") == 0;
  const std::vector<double> axis = axis_of(*joint, file);
  const XMLElement* dynamics = joint->FirstChildElement("dynamics");
  n.damping = amount_of(dynamics, "damping", file);
  n.friction = amount_of(dynamics, "friction", file);
  n.torque_constant = 1.0;
  n.notes.push_back("URDF has no actuator: u is taken as the joint's effort");
  const XMLElement* child = joint->FirstChildElement("child");
  const char* link_name = child == nullptr ? nullptr : child->Attribute("link");
  const XMLElement* link = link_name == nullptr ? nullptr : named(robot, file, "link", link_name);
  if (link != nullptr) read_link(*link, axis, file, n);
  return n;
}

}  // namespace gapscope::internal::config
