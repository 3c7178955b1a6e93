#include "config/mjcf_gravity.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

#include "config/mjcf_mass.h"
#include "config/mjcf_turn.h"

namespace gapscope::internal::config {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

Vector3d gravity_in(const Mjcf& m) {
  Vector3d g(0.0, 0.0, -9.81);
  for (const XMLElement* option = m.top().FirstChildElement("option"); option != nullptr;
       option = option->NextSiblingElement("option")) {
    g = three_of(m, *option, "gravity", g);
    if (has_attribute(option->FirstChildElement("flag"), "gravity", "disable")) return Vector3d::Zero();
  }
  return g;
}

std::string turns_above(const XMLElement& body) {
  return body_name(body) +
         " above it turns; where that is at rest in the recording, add to effects: - load_unbalance: "
         "{amplitude_nm: {estimate: true}, phase_rad: {estimate: true}}";
}

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
    if (body.FirstChildElement("freejoint") != nullptr) unknown = turns_above(body);
    for (const XMLElement* j = body.FirstChildElement("joint"); j != nullptr;
         j = j->NextSiblingElement("joint")) {
      const std::string type = m.word(*j, "type", "hinge");
      const Vector3d axis = turn * three_of(m, *j, "axis", Vector3d::UnitZ());
      const bool upright = type == "hinge" && axis.cross(g).norm() <= 1e-9 * axis.norm() * g.norm();
      if (type != "slide" && !upright) unknown = turns_above(body);
    }
  }
};

/// Nothing where no centre of the body could make another torque of gravity about the axis.
/// @param g  in the body's frame [m/s²]
std::optional<HangingBody> hanging_body(const Mjcf& m, const XMLElement& joint, const Vector3d& axis,
                                        const Vector3d& g) {
  constexpr double kUpright = 1e-6;  // sine of the angle between the axis and gravity
  const XMLElement& body = *joint.Parent()->ToElement();
  const FixedMass own = own_mass(m, body);
  const Vector3d across = g - axis.dot(g) * axis;
  if (!(own.hanging > 0.0) || !own.unknown.empty() || across.norm() <= kUpright * g.norm()) return {};
  const Vector3d centre = own.moment / own.mass, lever = centre - three_of(m, joint, "pos");
  const Vector3d down = across.normalized(), aside = axis.cross(down);
  const Matrix3d about =
      own.inertia - own.mass * (centre.squaredNorm() * Matrix3d::Identity() - centre * centre.transpose());
  const auto three = [](const Vector3d& v) { return std::array{v.x(), v.y(), v.z()}; };
  HangingBody h;
  h.name = body_name(body);
  h.mass = own.mass, h.weighed = own.hanging, h.by_geoms = own.of_geoms;
  h.centre = three(centre), h.down = three(down), h.aside = three(aside);
  h.inertia = {about(0, 0), about(1, 1), about(2, 2), about(0, 1), about(0, 2), about(1, 2)};
  h.lever_down = lever.dot(down), h.lever_aside = lever.dot(aside);
  h.gravity = across.norm(), h.reference = m.turned(joint, "ref");
  return h;
}

}  // namespace

void read_gravity(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  constexpr double kRounding = 1e-9;  // of the torque that the mass could have
  const Vector3d down = gravity_in(m);
  const XMLElement* body = joint.Parent()->ToElement();
  Vector3d axis = three_of(m, joint, "axis", Vector3d::UnitZ());
  const double weight = down.norm();
  if (!(axis.norm() > 0.0) || weight == 0.0) return;
  axis.normalize();
  const FixedMass fixed = fixed_mass(m, *body);
  const std::string absent = !fixed.unknown.empty() ? fixed.unknown
                             : fixed.moving.empty() ? ""
                                                    : fixed.moving + " moves against it";
  const Attitude attitude(m, *body, down);
  const Vector3d at = three_of(m, joint, "pos"), g = attitude.turn.transpose() * down;
  const auto refuse = [&](const std::string& why) { n.notes.push_back("not taken: gravity, " + why); };
  if (fixed.hanging == 0.0) return absent.empty() ? void() : refuse(absent);
  if (!attitude.unknown.empty()) return refuse(attitude.unknown);
  if (n.slides) {
    if (const double force = fixed.hanging * axis.dot(g);
        std::abs(force) > kRounding * fixed.hanging * weight)
      n.weight = force;
    return;
  }
  const Vector3d r = fixed.hanging_moment - fixed.hanging * at;
  const double cosine = axis.dot(r.cross(g)), sine = r.dot(g) - r.dot(axis) * axis.dot(g);
  const double amplitude = std::hypot(cosine, sine);
  n.hanging = hanging_body(m, joint, axis, g);
  if (!absent.empty())
    n.notes.push_back("not taken: gravity on a part of what hangs on the joint, as " + absent);
  if (amplitude <= kRounding * weight * r.norm()) return;
  n.unbalance = amplitude;
  n.unbalance_phase = std::atan2(-cosine, sine) - m.turned(joint, "ref");
  if (std::abs(n.unbalance_phase) < kRounding) n.unbalance_phase = 0.0;
}

}  // namespace gapscope::internal::config
