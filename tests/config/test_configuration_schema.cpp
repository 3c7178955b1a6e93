// The schema of a configuration says what the readers take: every map of it has the keys that the reader
// names when it refuses one.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "config/configuration.h"
#include "config/configuration_schema.h"
#include "config/texts.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

using nlohmann::json;
using testing::kRecorded;
using testing::kSimulated;

constexpr const char* kUnknown = "a_key_that_nobody_knows";

struct Step {
  std::string key;                    ///< "0": the first item of a list
  std::vector<std::string> required;  ///< keys that must stand beside it
};

struct MapPlace {
  std::vector<Step> path;
  std::set<std::string> keys;
};

/// Every map of a schema with its path.
void collect(const json& schema, const std::vector<Step>& path, std::vector<MapPlace>& maps) {
  const auto deeper = [&](const json& inner, const std::string& key) {
    std::vector<Step> next = path;
    next.push_back({key, schema.value("required", std::vector<std::string>())});
    collect(inner, next, maps);
  };
  if (schema.contains("properties")) {
    MapPlace map{path, {}};
    for (const auto& [key, inner] : schema["properties"].items()) {
      map.keys.insert(key);
      deeper(inner, key);
    }
    maps.push_back(map);
  }
  if (schema.contains("items")) deeper(schema["items"], "0");
  if (schema.contains("anyOf"))
    for (const json& choice : schema["anyOf"]) collect(choice, path, maps);
}

/// A map with that one key, within maps and lists down to it.
YAML::Node unknown_below(const std::vector<Step>& path, std::size_t from) {
  YAML::Node node;
  if (from == path.size()) {
    node[kUnknown] = 1;
  } else if (path[from].key == "0") {
    node.push_back(unknown_below(path, from + 1));
  } else {
    for (const std::string& beside : path[from].required) node[beside] = 1;
    node[path[from].key] = unknown_below(path, from + 1);
  }
  return node;
}

/// A configuration that is right but for an unknown key in that map.
std::string with_unknown_key(const MapPlace& map) {
  const std::vector<Step>& path = map.path;
  const bool simulated = !path.empty() && path.front().key == "simulation";
  YAML::Node root = YAML::Load(simulated ? kSimulated : kRecorded);
  if (path.empty())
    root[kUnknown] = 1;
  else if (path.size() > 1 && root[path[0].key])
    root[path[0].key][path[1].key] = unknown_below(path, 2);
  else
    root[path[0].key] = unknown_below(path, 1);
  return YAML::Dump(root);
}

/// The keys that the reader names when it refuses an unknown one.
std::set<std::string> keys_of_refusal(const std::string& message) {
  std::smatch found;
  const std::string list = std::regex_search(message, found, std::regex("one of ([^(]*) \\(nearest"))
                               ? found[1].str()
                               : std::regex_replace(message, std::regex("^.*expected "), "");
  std::set<std::string> keys;
  const std::regex key("[A-Za-z0-9_]+");
  for (auto k = std::sregex_iterator(list.begin(), list.end(), key); k != std::sregex_iterator(); ++k)
    keys.insert(k->str());
  return keys;
}

std::string refused_with(const std::string& text) {
  try {
    parse_configuration(text, "c.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "(accepted)";
}

/// An effect is named, not looked up among keys: its name is refused in words of its own.
bool names_an_effect(const MapPlace& map) {
  return map.path.size() == 3 && map.path[1].key == "effects" && map.path[2].key == "0";
}

TEST(ConfigurationSchema, EveryMapHasTheKeysThatTheReaderTakes) {
  std::vector<MapPlace> maps;
  collect(json::parse(configuration_schema()), {}, maps);
  int compared = 0;
  for (const MapPlace& map : maps) {
    if (names_an_effect(map)) continue;
    const std::string text = with_unknown_key(map), message = refused_with(text);
    ASSERT_NE(message.find("unknown key '" + std::string(kUnknown)), std::string::npos) << message << "\n"
                                                                                        << text;
    EXPECT_EQ(keys_of_refusal(message), map.keys) << message;
    ++compared;
  }
  EXPECT_GT(compared, 100);  // the parameters of every effect among them
}

TEST(ConfigurationSchema, EveryBlockSaysWhatItIsForAndEveryParameterItsUnit) {
  const json root = json::parse(configuration_schema())["properties"];
  for (const auto& [key, block] : root.items()) EXPECT_FALSE(block.value("description", "").empty()) << key;
  for (const auto& [key, parameter] : root["model"]["properties"]["parameters"]["properties"].items())
    EXPECT_EQ(parameter.value("description", "").ends_with("]"), key != "mass_ratio") << key;
}

}  // namespace
}  // namespace gapscope
