#include "config/joint_reader.h"

#include <cmath>
#include <sstream>

#include "config/mjcf_include.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"

namespace gapscope {
namespace internal::config {

using tinyxml2::XMLElement;

std::vector<double> numbers_in(const char* text, const std::string& file) {
  std::vector<double> numbers;
  if (text == nullptr) return numbers;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0' || !std::isfinite(numbers.back()))
      throw ConfigError(file, "has " + shown(text) + " in an attribute, expected numbers");
  }
  return numbers;
}

namespace {

void collect_elements(const XMLElement& top, const std::string& name, std::vector<const XMLElement*>& found) {
  for (const XMLElement* e = top.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (e->Name() == name) found.push_back(e);
    collect_elements(*e, name, found);
  }
}

}  // namespace

std::vector<const XMLElement*> elements_below(const XMLElement& top, const char* name) {
  std::vector<const XMLElement*> found;
  collect_elements(top, name, found);
  return found;
}

double inertia_about(const std::vector<double>& axis, double mass, const std::vector<double>& c,
                     const std::vector<double>& t) {
  const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const double x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
  const double own =
      t[0] * x * x + t[1] * y * y + t[2] * z * z + 2.0 * (t[3] * x * y + t[4] * x * z + t[5] * y * z);
  const double u = c[1] * z - c[2] * y, v = c[2] * x - c[0] * z, w = c[0] * y - c[1] * x;
  return own + mass * (u * u + v * v + w * w);
}

void no_such_joint(const XMLElement& top, const std::string& file, const std::string& joint) {
  std::string names;
  for (const XMLElement* e : elements_below(top, "joint"))
    if (const char* name = e->Attribute("name"); name != nullptr && names.size() < 200)
      names += (names.empty() ? "" : ", ") + printable(name, 40);
  throw ConfigError(
      file, "has no joint " + shown(joint) + ", expected one of: " + (names.empty() ? "none" : names));
}

}  // namespace internal::config

JointNumbers joint_numbers(const std::string& path, const std::string& joint) {
  using namespace internal::config;
  tinyxml2::XMLDocument document;
  if (!load_xml(path, document)) throw ConfigError(path, "cannot be read as XML, expected an MJCF or URDF");
  const tinyxml2::XMLElement& top = *document.RootElement();
  const std::string kind = top.Name();
  if (kind != "mujoco" && kind != "robot")
    throw ConfigError(path, "begins with <" + printable(kind, 40) + ">, expected <mujoco> or <robot>");
  if (kind == "mujoco") follow_includes(document, path);
  JointNumbers numbers = kind == "mujoco" ? mjcf_joint(top, path, joint) : urdf_joint(top, path, joint);
  numbers.model = path, numbers.joint = joint, numbers.of_mjcf = kind == "mujoco";
  return numbers;
}

}  // namespace gapscope
