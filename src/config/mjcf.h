#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/joint_reader.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::config {

inline bool is_named(const tinyxml2::XMLElement& e, std::string_view name) { return e.Name() == name; }

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
    for (const tinyxml2::XMLElement* e = top.FirstChildElement("compiler"); e != nullptr;
         e = e->NextSiblingElement("compiler")) {
      if (e->Attribute("angle") != nullptr) degrees_ = !has_attribute(e, "angle", "radian");
      if (e->Attribute("eulerseq") != nullptr) euler_sequence_ = e->Attribute("eulerseq");
      if (e->Attribute("autolimits") != nullptr) auto_limits_ = !has_attribute(e, "autolimits", "false");
    }
  }

  const tinyxml2::XMLElement& top() const { return top_; }
  const std::string& file() const { return file_; }
  double angle_unit() const { return degrees_ ? kPi / 180.0 : 1.0; }  ///< of the compiler [rad]
  /// Axes of euler="a b c": small letters turn with the body, capital ones stand still.
  const std::string& euler_sequence() const { return euler_sequence_; }

  /// What an element says or, where it does not, its class or one around that; null: nobody does.
  const char* text(const tinyxml2::XMLElement& e, const char* attribute) const {
    if (const char* own = e.Attribute(attribute)) return own;
    for (std::string of = class_of(e);;) {
      const auto found = classes_.find(of);
      if (found == classes_.end()) return nullptr;
      for (auto part = found->second.parts.rbegin(); part != found->second.parts.rend(); ++part)
        for (auto kind = (*part)->LastChildElement(); kind != nullptr; kind = kind->PreviousSiblingElement())
          if ((is_named(*kind, e.Name()) || of_all_actuators(e, attribute)) && kind->Attribute(attribute))
            return kind->Attribute(attribute);
      if (found->second.parent.empty()) return nullptr;
      of = found->second.parent;
    }
  }

  std::string word(const tinyxml2::XMLElement& e, const char* attribute, const char* otherwise) const {
    const char* const found = text(e, attribute);
    return found == nullptr ? otherwise : found;
  }

  std::vector<double> values(const tinyxml2::XMLElement& e, const char* attribute) const {
    return numbers_in(text(e, attribute), file_);
  }

  double value(const tinyxml2::XMLElement& e, const char* attribute, double otherwise) const {
    const auto found = values(e, attribute);
    return found.empty() ? otherwise : found[0];
  }

  /// Of what nobody takes a negative number for.  @throws ConfigError
  double amount_of(const tinyxml2::XMLElement& e, const char* attribute, double otherwise) const {
    return amount(file_, e, attribute, value(e, attribute, otherwise));
  }

  bool slides(const tinyxml2::XMLElement& joint) const { return word(joint, "type", "hinge") == "slide"; }

  /// An angle of a joint, or a length of a slide, in rad or m.
  double turned(const tinyxml2::XMLElement& joint, const char* attribute) const {
    return value(joint, attribute, 0.0) * (slides(joint) ? 1.0 : angle_unit());
  }

  /// Whether a range holds.
  /// @param attribute  limited, ctrllimited, forcelimited
  bool limited(const tinyxml2::XMLElement& e, const char* attribute = "limited") const {
    const std::string told = word(e, attribute, "auto");
    return told == "true" || (told == "auto" && auto_limits_);
  }

  /// Of a joint, in rad or m; NaN: it has no range that holds.
  double range_width(const tinyxml2::XMLElement& joint) const {
    const auto range = values(joint, "range");
    if (range.size() < 2 || !limited(joint)) return kNaN;
    return (range[1] - range[0]) * (slides(joint) ? 1.0 : angle_unit());
  }

 private:
  /// MuJoCo keeps one default for actuators of every kind; only what makes the kind is that kind's.
  static bool of_all_actuators(const tinyxml2::XMLElement& e, std::string_view attribute) {
    const tinyxml2::XMLNode* const parent = e.Parent();
    const bool shared =
        attribute == "gear" || attribute.starts_with("ctrl") || attribute.starts_with("force");
    return shared && parent != nullptr && parent->ToElement() != nullptr &&
           is_named(*parent->ToElement(), "actuator");
  }

  struct DefaultClass {
    std::vector<const tinyxml2::XMLElement*> parts;  ///< of several files; a later one comes first
    std::string parent;
  };

  void add_class(const tinyxml2::XMLElement& e, const std::string& otherwise, const std::string& parent) {
    const std::string name = e.Attribute("class") != nullptr ? e.Attribute("class") : otherwise;
    classes_.insert({name, {{}, parent}}).first->second.parts.push_back(&e);
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
  bool degrees_ = true, auto_limits_ = true;
  std::string euler_sequence_ = "xyz";
};

}  // namespace gapscope::internal::config
