#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "config/joint_reader.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::config {

inline bool has_attribute(const tinyxml2::XMLElement* e, const char* name, const std::string& value) {
  return e != nullptr && e->Attribute(name) != nullptr && e->Attribute(name) == value;
}

/// An MJCF with its defaults: what an element does not say its class does, and the class around that.
class Mjcf {
 public:
  Mjcf(const tinyxml2::XMLElement& top, const std::string& file) : top_(top), file_(file) {
    for (const tinyxml2::XMLElement* e = top.FirstChildElement("default"); e != nullptr;
         e = e->NextSiblingElement("default"))
      add_class(*e, "main", "");
    const tinyxml2::XMLElement* compiler = top.FirstChildElement("compiler");
    degrees_ = !has_attribute(compiler, "angle", "radian");
  }

  const tinyxml2::XMLElement& top() const { return top_; }
  const std::string& file() const { return file_; }

  std::vector<double> values(const tinyxml2::XMLElement& e, const char* attribute) const {
    if (const char* own = e.Attribute(attribute)) return numbers_in(own, file_);
    for (std::string of = class_of(e);;) {
      const auto found = classes_.find(of);
      if (found == classes_.end()) return {};
      const tinyxml2::XMLElement* defaults = found->second.element->FirstChildElement(e.Name());
      if (defaults != nullptr && defaults->Attribute(attribute) != nullptr)
        return numbers_in(defaults->Attribute(attribute), file_);
      if (found->second.parent.empty()) return {};
      of = found->second.parent;
    }
  }

  double value(const tinyxml2::XMLElement& e, const char* attribute, double otherwise) const {
    const auto found = values(e, attribute);
    return found.empty() ? otherwise : found[0];
  }

  /// An angle of a joint, or a length of a slide, in rad or m.
  double turned(const tinyxml2::XMLElement& joint, const char* attribute) const {
    const bool angle = degrees_ && !has_attribute(&joint, "type", "slide");
    return value(joint, attribute, 0.0) * (angle ? kPi / 180.0 : 1.0);
  }

  /// Of a joint, in rad or m.
  double range_width(const tinyxml2::XMLElement& joint) const {
    const auto range = values(joint, "range");
    if (range.size() < 2) return kNaN;
    const bool turned = degrees_ && !has_attribute(&joint, "type", "slide");
    return (range[1] - range[0]) * (turned ? kPi / 180.0 : 1.0);
  }

 private:
  struct DefaultClass {
    const tinyxml2::XMLElement* element;
    std::string parent;
  };

  void add_class(const tinyxml2::XMLElement& e, const std::string& otherwise, const std::string& parent) {
    const std::string name = e.Attribute("class") != nullptr ? e.Attribute("class") : otherwise;
    classes_.insert({name, {&e, parent}});
    for (const tinyxml2::XMLElement* in = e.FirstChildElement("default"); in != nullptr;
         in = in->NextSiblingElement("default"))
      add_class(*in, "main", name);
  }

  std::string class_of(const tinyxml2::XMLElement& e) const {
    if (e.Attribute("class") != nullptr) return e.Attribute("class");
    for (const tinyxml2::XMLNode* up = e.Parent(); up != nullptr; up = up->Parent())
      if (up->ToElement() != nullptr && up->ToElement()->Attribute("childclass") != nullptr)
        return up->ToElement()->Attribute("childclass");
    return "main";
  }

  const tinyxml2::XMLElement& top_;
  std::string file_;
  std::map<std::string, DefaultClass> classes_;
  bool degrees_ = true;
};

}  // namespace gapscope::internal::config
