#include "config/mjcf_actuator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/shown.h"

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

/// Of a general actuator, whose force is gain · ctrl + b0 + b1 · length + b2 · speed.
void read_bias(const Mjcf& m, const XMLElement& e, double gear, Actuation& a) {
  const std::string type = m.word(e, "biastype", "none");
  if (!is_named(e, "general") || type == "none") return;
  auto bias = m.values(e, "biasprm");
  bias.resize(std::max<std::size_t>(bias.size(), 3), 0.0);
  if (type == "affine") a.constant += gear * bias[0];
  if (type != "affine" || bias[1] != 0.0 || bias[2] != 0.0)
    a.notes.push_back("not taken: an actuator's bias that is no constant torque (biastype " +
                      printable(type, 20) + ")");
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
  const bool limited = m.word(e, (of + "limited").c_str(), "auto") != "false";
  if (!limited || range.size() < 2 || !(range[0] < range[1])) return kInfinity;
  if (std::abs(range[0] + range[1]) <= 1e-9 * range[1]) return range[1];
  a.notes.push_back(
      fmt::format("not taken: the actuator's {}range {:.4g} to {:.4g}, which is not alike both ways", of,
                  range[0], range[1]));
  return kInfinity;
}

/// @param gain  of the force per control, before the gear
void read_drive(const Mjcf& m, const XMLElement& e, double gain, double gear, Actuation& a) {
  const std::string kind = e.Name();
  a.gain = gear * gain;
  if (kind != "motor" && kind != "general")
    return a.notes.push_back("the actuator is of kind " + kind +
                             ": its control is no torque, so torque_constant is the gear");
  read_filter(m, e, a);
  a.limit = std::min(limit_of(m, e, "ctrl", a), limit_of(m, e, "force", a) / std::abs(gain));
}

}  // namespace

Actuation actuation_of(const Mjcf& m, const std::string& joint) {
  Actuation a;
  for (const XMLElement* e : actuators_of(m, joint)) {
    const double gear = m.value(*e, "gear", 1.0), first = m.value(*e, "gainprm", 1.0);
    read_bias(m, *e, gear, a);
    if (first == 0.0) continue;
    if (std::isfinite(a.gain))
      a.notes.push_back(fmt::format("not taken: a further actuator of the joint, a {}", e->Name()));
    else
      read_drive(m, *e, is_named(*e, "general") ? first : 1.0, gear, a);
  }
  return a;
}

}  // namespace gapscope::internal::config
