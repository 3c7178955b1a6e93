#pragma once

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>

namespace gapscope::testing {

/// What an editor makes of YAML: plain scalars are numbers and truth values where they look like it.
inline nlohmann::json as_json(const YAML::Node& node) {
  nlohmann::json out;
  if (node.IsSequence())
    for (const YAML::Node& item : (out = nlohmann::json::array(), node)) out.push_back(as_json(item));
  if (node.IsMap())
    for (const auto& entry : (out = nlohmann::json::object(), node))
      out[entry.first.Scalar()] = as_json(entry.second);
  if (!node.IsScalar()) return out;
  long long whole = 0;
  double number = 0.0;
  bool truth = false;
  if (node.Tag() == "!") return node.Scalar();
  if (YAML::convert<long long>::decode(node, whole)) return whole;
  if (YAML::convert<double>::decode(node, number)) return number;
  if (YAML::convert<bool>::decode(node, truth)) return truth;
  return node.Scalar();
}

}  // namespace gapscope::testing
