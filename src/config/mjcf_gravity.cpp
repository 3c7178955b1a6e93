#include "config/mjcf_gravity.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>

#include "config/mjcf_turn.h"
#include "gapscope/base/shown.h"

namespace gapscope::internal::config {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

std::string body_name(const XMLElement& body) {
  return "body " +
         printable(body.Attribute("name") != nullptr ? body.Attribute("name") : "without a name", 40);
}

bool is_named(const XMLElement& e, const char* name) { return std::strcmp(e.Name(), name) == 0; }

/// Whether a body, or a frame in it, has such a part.
bool has_part(const XMLElement& body, const char* name) {
  if (body.FirstChildElement(name) != nullptr) return true;
  for (const XMLElement* e = body.FirstChildElement("frame"); e != nullptr;
       e = e->NextSiblingElement("frame"))
    if (has_part(*e, name)) return true;
  return false;
}

bool has_joint(const XMLElement& body) { return has_part(body, "joint") || has_part(body, "freejoint"); }

Vector3d gravity_in(const Mjcf& m) {
  Vector3d g(0.0, 0.0, -9.81);
  for (const XMLElement* option = m.top().FirstChildElement("option"); option != nullptr;
       option = option->NextSiblingElement("option")) {
    g = three_of(m, *option, "gravity", g);
    if (has_attribute(option->FirstChildElement("flag"), "gravity", "disable")) return Vector3d::Zero();
  }
  return g;
}

/// Mass times its place in the joint's body, of that body and of all that is fixed to it, and why some of it
/// is not there.
struct FixedMass {
  Vector3d moment = Vector3d::Zero();  ///< Σ m c [kg m]
  double mass = 0.0;                   ///< [kg]
  std::string gap;                     ///< what is not in it; empty: all is

  void add(const Mjcf& m, const XMLElement& body, const Vector3d& at, const Matrix3d& turn) {
    const XMLElement* inertial = body.FirstChildElement("inertial");
    if (inertial != nullptr)
      add_inertial(m, body, *inertial, at, turn);
    else if (is_named(body, "body") && has_part(body, "geom"))
      gap = body_name(body) + " has no inertial";
    for (const XMLElement* e = body.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (!is_named(*e, "body") && !is_named(*e, "frame")) continue;
      if (is_named(*e, "body") && has_joint(*e))
        gap = body_name(*e) + " moves against it";
      else
        add(m, *e, at + turn * three_of(m, *e, "pos"), turn * turn_of(m, *e));
    }
  }

 private:
  void add_inertial(const Mjcf& m, const XMLElement& body, const XMLElement& inertial, const Vector3d& at,
                    const Matrix3d& turn) {
    const double compensated = m.value(body, "gravcomp", 0.0);
    const double heavy = m.value(inertial, "mass", 0.0) * (1.0 - compensated);
    moment += heavy * (at + turn * three_of(m, inertial, "pos"));
    mass += heavy;
  }
};

/// The joint's body against the world, or why its gravity is not known: a joint above turns it, and not about
/// the vertical.
struct Attitude {
  Matrix3d turn = Matrix3d::Identity();
  std::string unknown;  ///< empty: it is known

  Attitude(const Mjcf& m, const XMLElement& body, const Vector3d& g) {
    std::vector<const XMLElement*> above;  // from the body outwards
    for (const XMLElement* e = &body; e != nullptr && !is_named(*e, "worldbody");
         e = e->Parent() == nullptr ? nullptr : e->Parent()->ToElement())
      above.push_back(e);
    for (auto e = above.rbegin(); e != above.rend(); ++e) {
      turn = turn * turn_of(m, **e);
      if (*e != &body && unknown.empty()) look_at_joints(m, **e, g);
    }
  }

 private:
  void look_at_joints(const Mjcf& m, const XMLElement& body, const Vector3d& g) {
    if (body.FirstChildElement("freejoint") != nullptr) unknown = body_name(body) + " above it turns";
    for (const XMLElement* j = body.FirstChildElement("joint"); j != nullptr;
         j = j->NextSiblingElement("joint")) {
      const std::string type = m.word(*j, "type", "hinge");
      const Vector3d axis = turn * three_of(m, *j, "axis", Vector3d::UnitZ());
      const bool upright = type == "hinge" && axis.cross(g).norm() <= 1e-9 * axis.norm() * g.norm();
      if (type != "slide" && !upright) unknown = body_name(body) + " above it turns";
    }
  }
};

}  // namespace

void read_gravity(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  constexpr double kRounding = 1e-9;  // of the torque that the mass could have
  const Vector3d down = gravity_in(m);
  const XMLElement* body = joint.Parent()->ToElement();
  Vector3d axis = three_of(m, joint, "axis", Vector3d::UnitZ());
  const double weight = down.norm();
  if (!(axis.norm() > 0.0) || weight == 0.0) return;
  axis.normalize();
  FixedMass fixed;
  fixed.add(m, *body, Vector3d::Zero(), Matrix3d::Identity());
  const Attitude attitude(m, *body, down);
  const Vector3d at = three_of(m, joint, "pos"), g = attitude.turn.transpose() * down;
  const auto refuse = [&](const std::string& why) { n.notes.push_back("not taken: gravity, " + why); };
  if (fixed.mass == 0.0) return fixed.gap.empty() ? void() : refuse(fixed.gap);
  if (!attitude.unknown.empty()) return refuse(attitude.unknown);
  if (n.slides) {
    if (const double force = fixed.mass * axis.dot(g); std::abs(force) > kRounding * fixed.mass * weight)
      refuse(fmt::format("{:.4g} N along the slide: effect constant_load_torque", force));
    return;
  }
  const Vector3d r = fixed.moment - fixed.mass * at;
  const double cosine = axis.dot(r.cross(g)), sine = r.dot(g) - r.dot(axis) * axis.dot(g);
  const double amplitude = std::hypot(cosine, sine);
  if (!fixed.gap.empty())
    n.notes.push_back("not taken: gravity on a part of what hangs on the joint, as " + fixed.gap);
  if (amplitude <= kRounding * weight * r.norm()) return;
  n.unbalance = amplitude;
  n.unbalance_phase = std::atan2(-cosine, sine) - m.turned(joint, "ref");
  if (std::abs(n.unbalance_phase) < kRounding) n.unbalance_phase = 0.0;
}

}  // namespace gapscope::internal::config
