#include "config/mjcf_gravity.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>

#include "gapscope/base/shown.h"

namespace gapscope::internal::config {
namespace {

using tinyxml2::XMLElement;
using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector vector_of(std::vector<double> values, const Vector& otherwise) {
  if (values.size() != 3) return otherwise;
  return {values[0], values[1], values[2]};
}

std::string body_name(const XMLElement& body) {
  return "body " +
         printable(body.Attribute("name") != nullptr ? body.Attribute("name") : "without a name", 40);
}

bool is_turned(const XMLElement& e) {
  for (const char* attribute : {"quat", "euler", "axisangle", "xyaxes", "zaxis"})
    if (e.Attribute(attribute) != nullptr) return true;
  return false;
}

bool has_joint(const XMLElement& body) {
  return body.FirstChildElement("joint") != nullptr || body.FirstChildElement("freejoint") != nullptr;
}

Vector gravity_in(const Mjcf& m) {
  Vector g = {0.0, 0.0, -9.81};
  for (const XMLElement* option = m.top().FirstChildElement("option"); option != nullptr;
       option = option->NextSiblingElement("option")) {
    g = vector_of(numbers_in(option->Attribute("gravity"), m.file()), g);
    if (has_attribute(option->FirstChildElement("flag"), "gravity", "disable")) return {};
  }
  return g;
}

/// Mass times its place, of a body and of all that is fixed to it, and why some of it is not there.
struct FixedMass {
  Vector moment{};    ///< Σ m c [kg m]
  double mass = 0.0;  ///< [kg]
  std::string gap;    ///< what is not in it; empty: all is

  void add(const Mjcf& m, const XMLElement& body, const Vector& at) {
    const XMLElement* inertial = body.FirstChildElement("inertial");
    if (inertial != nullptr)
      add_inertial(m, body, *inertial, at);
    else if (body.FirstChildElement("geom") != nullptr)
      gap = body_name(body) + " has no inertial";
    for (const XMLElement* e = body.FirstChildElement("body"); e != nullptr;
         e = e->NextSiblingElement("body")) {
      if (has_joint(*e) || is_turned(*e)) {
        gap = body_name(*e) + (has_joint(*e) ? " moves against it" : " is turned against it");
        continue;
      }
      const Vector off = vector_of(m.values(*e, "pos"), {});
      add(m, *e, {at[0] + off[0], at[1] + off[1], at[2] + off[2]});
    }
  }

 private:
  void add_inertial(const Mjcf& m, const XMLElement& body, const XMLElement& inertial, const Vector& at) {
    const double compensated = m.value(body, "gravcomp", 0.0);
    const double heavy = m.value(inertial, "mass", 0.0) * (1.0 - compensated);
    const Vector centre = vector_of(m.values(inertial, "pos"), {});
    for (std::size_t i = 0; i < 3; ++i) moment[i] += heavy * (at[i] + centre[i]);
    mass += heavy;
  }
};

/// Why the direction of gravity in the joint's body is not known; empty: it is.
std::string turned_above(const XMLElement& body) {
  const XMLElement* at = &body;
  for (; at != nullptr && std::strcmp(at->Name(), "body") == 0; at = at->Parent()->ToElement()) {
    if (is_turned(*at)) return body_name(*at) + " is turned against the world";
    for (const XMLElement* j = at->FirstChildElement("joint"); at != &body && j != nullptr;
         j = j->NextSiblingElement("joint"))
      if (!has_attribute(j, "type", "slide")) return body_name(*at) + " above it turns";
  }
  return "";
}

}  // namespace

void read_gravity(const Mjcf& m, const XMLElement& joint, JointNumbers& n) {
  constexpr double kRounding = 1e-9;  // of the torque that the mass could have
  const Vector g = gravity_in(m);
  const XMLElement* body = joint.Parent()->ToElement();
  Vector axis = vector_of(m.values(joint, "axis"), {0.0, 0.0, 1.0});
  const double length = std::sqrt(dot(axis, axis)), weight = std::sqrt(dot(g, g));
  if (!(length > 0.0) || weight == 0.0) return;
  for (double& a : axis) a /= length;
  FixedMass fixed;
  fixed.add(m, *body, {});
  const std::string turned = turned_above(*body);
  const Vector at = vector_of(m.values(joint, "pos"), {});
  const auto refuse = [&](const std::string& why) { n.notes.push_back("not taken: gravity, " + why); };
  if (fixed.mass == 0.0) return fixed.gap.empty() ? void() : refuse(fixed.gap);
  if (!turned.empty()) return refuse(turned);
  if (n.slides) {
    if (const double force = fixed.mass * dot(axis, g); std::abs(force) > kRounding * fixed.mass * weight)
      refuse(fmt::format("{:.4g} N along the slide: effect constant_load_torque", force));
    return;
  }
  Vector r = fixed.moment;
  for (std::size_t i = 0; i < 3; ++i) r[i] -= fixed.mass * at[i];
  const double cosine = dot(axis, cross(r, g)), sine = dot(r, g) - dot(r, axis) * dot(axis, g);
  const double amplitude = std::hypot(cosine, sine);
  if (!fixed.gap.empty())
    n.notes.push_back("not taken: gravity on a part of what hangs on the joint, as " + fixed.gap);
  if (amplitude <= kRounding * weight * std::sqrt(dot(r, r))) return;
  n.unbalance = amplitude;
  n.unbalance_phase = std::atan2(-cosine, sine) - m.turned(joint, "ref");
  if (std::abs(n.unbalance_phase) < kRounding) n.unbalance_phase = 0.0;
}

}  // namespace gapscope::internal::config
