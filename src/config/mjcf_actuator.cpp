#include "config/mjcf_actuator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shown.h"

namespace gapscope::internal::config {
namespace {

using tinyxml2::XMLElement;

std::vector<const XMLElement*> actuators_of(const Mjcf& m, const std::string& joint) {
  std::vector<const XMLElement*> found;
  for (const XMLElement* s = m.top().FirstChildElement("actuator"); s != nullptr;
       s = s->NextSiblingElement("actuator"))
    for (const XMLElement* e = s->FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      if (has_attribute(e, "joint", joint)) found.push_back(e);
  return found;
}

/// force = gain · ctrl + b0 + b1 · length + b2 · speed, of whatever kind.
struct AffineForce {
  double gain = 1.0, constant = 0.0, by_length = 0.0, by_speed = 0.0;
  bool is_affine = true;

  /// Whether the control is a goal of the length, or of the speed.
  bool holds_position() const { return gain > 0.0 && is_gain(-by_length); }
  bool holds_speed() const { return gain > 0.0 && by_length == 0.0 && is_gain(-by_speed); }
  bool is_constant() const { return is_affine && by_length == 0.0 && by_speed == 0.0; }

 private:
  bool is_gain(double other) const { return std::abs(gain - other) <= 1e-9 * gain; }
};

AffineForce force_of(const Mjcf& m, const XMLElement& e) {
  if (is_named(e, "position")) {
    const double kp = m.value(e, "kp", 1.0);
    return {kp, 0.0, -kp, -m.value(e, "kv", 0.0)};
  }
  if (is_named(e, "velocity")) {
    const double kv = m.value(e, "kv", 1.0);
    return {kv, 0.0, 0.0, -kv};
  }
  if (!is_named(e, "general")) return {};
  const std::string type = m.word(e, "biastype", "none");
  auto bias = m.values(e, "biasprm");
  bias.resize(std::max<std::size_t>(bias.size(), 3), 0.0);
  AffineForce force{m.value(e, "gainprm", 1.0)};
  if (type == "affine") force.constant = bias[0], force.by_length = bias[1], force.by_speed = bias[2];
  force.is_affine = type == "affine" || type == "none";
  return force;
}

void read_filter(const Mjcf& m, const XMLElement& e, Actuation& a) {
  const std::string type = m.word(e, "dyntype", "none");
  if (type == "filter" || type == "filterexact")
    a.lag = m.value(e, "dynprm", 1.0);
  else if (type != "none")
    a.notes.push_back("not taken: the actuator's dynamics (dyntype " + printable(type, 20) + ")");
}

/// @param of  "ctrl", "force"
double limit_of(const Mjcf& m, const XMLElement& e, const std::string& of, Actuation& a) {
  const auto range = m.values(e, (of + "range").c_str());
  if (!m.limited(e, (of + "limited").c_str()) || range.size() < 2 || !(range[0] < range[1])) return kInfinity;
  if (std::abs(range[0] + range[1]) <= 1e-9 * range[1]) return range[1];
  a.notes.push_back(
      fmt::format("not taken: the actuator's {}range {:.4g} to {:.4g}, which is not alike both ways", of,
                  range[0], range[1]));
  return kInfinity;
}

/// A goal of the position, or of the speed. What pulls against the speed is the inner loop of a cascade, as
/// the limit of force takes hold of both.
/// @param length  of the actuator per turn of the joint
void read_servo(const Mjcf& m, const XMLElement& e, const AffineForce& force, double length, Actuation& a) {
  constexpr double kRounding = 1e-9;
  DriveController c;
  const double by_position = -length * length * force.by_length, by_speed = -length * length * force.by_speed;
  if (force.holds_speed())
    c.kind = ControllerKind::kVelocity, c.gain = 0.0, c.speed_gain = by_speed;
  else if (by_speed > 0.0)
    c.kind = ControllerKind::kCascade, c.gain = by_position / by_speed, c.speed_gain = by_speed;
  else
    c.gain = by_position;
  if (std::abs(length - 1.0) > kRounding)
    a.notes.push_back(
        fmt::format("the actuator's goal is {:.4g} times that of the joint (gear): give the target "
                    "in units of the joint",
                    length));
  c.goal_filter = is_named(e, "position") ? m.value(e, "timeconst", 0.0) : a.lag;
  c.saturation = std::abs(length) * limit_of(m, e, "force", a);
  a.servo = c, a.gain = 1.0, a.lag = 0.0;
  if (m.value(e, "dampratio", 0.0) > 0.0)
    a.notes.push_back(
        "not taken: dampratio of the actuator, which MuJoCo turns into kv as it compiles: give kv");
}

/// A motor under a voltage: K/R (V − K w).
void read_dcmotor(const Mjcf& m, const XMLElement& e, double gear, Actuation& a) {
  const auto constants = m.values(e, "motorconst");
  const double resistance = m.value(e, "resistance", 0.0);
  if (constants.empty() || !(resistance > 0.0))
    return a.notes.push_back("not taken: a dcmotor without motorconst and resistance");
  const double torque = constants[0], emf = constants.size() > 1 ? constants[1] : constants[0];
  a.gain = gear * torque / resistance;
  a.back_emf = gear * gear * torque * emf / resistance;
  a.limit = limit_of(m, e, "ctrl", a);
}

void read_actuator(const Mjcf& m, const XMLElement& e, const AffineForce& force, double gear, Actuation& a) {
  const std::string kind = e.Name();
  if (kind == "dcmotor") return read_dcmotor(m, e, gear, a);
  if (is_named(e, "general")) read_filter(m, e, a);
  if (force.holds_position() || force.holds_speed()) return read_servo(m, e, force, gear, a);
  a.gain = gear * force.gain;
  if (kind != "motor" && kind != "general")
    return a.notes.push_back("the actuator is of kind " + kind +
                             ": its control is no torque, so torque_constant is the gear");
  if (is_named(e, "motor")) read_filter(m, e, a);
  a.limit = std::min(limit_of(m, e, "ctrl", a), limit_of(m, e, "force", a) / std::abs(force.gain));
}

}  // namespace

Actuation actuation_of(const Mjcf& m, const std::string& joint) {
  Actuation a;
  for (const XMLElement* e : actuators_of(m, joint)) {
    const double gear = m.value(*e, "gear", 1.0);
    const AffineForce force = force_of(m, *e);
    a.constant += gear * force.constant;
    if (!force.is_constant() && !force.holds_position() && !force.holds_speed())
      a.notes.push_back("not taken: an actuator's bias that is no constant torque (biastype " +
                        printable(m.word(*e, "biastype", "none"), 20) + ")");
    if (force.gain == 0.0) continue;
    if (std::isfinite(a.gain))
      a.notes.push_back(fmt::format("not taken: a further actuator of the joint, a {}", e->Name()));
    else
      read_actuator(m, *e, force, gear, a);
  }
  if (a.gain < 0.0)
    a.notes.push_back(
        fmt::format("not taken: the actuator's {:.4g} per unit of control, as a torque constant "
                    "is above 0: give u, or x1, the other sign",
                    a.gain));
  return a;
}

}  // namespace gapscope::internal::config
