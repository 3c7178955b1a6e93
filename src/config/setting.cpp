#include <fmt/format.h>

#include <algorithm>

#include "base/shown.h"
#include "config/overlaid.h"
#include "config/yaml_document.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace internal::config {
namespace {

constexpr std::size_t kLongestKey = 200;

std::string setting_place(const Setting& setting) {
  return setting.place.empty() ? "--set " + setting.key : setting.place;
}

std::vector<std::string> keys_of(const Setting& setting) {
  std::vector<std::string> keys(1);
  for (const char c : setting.key)
    if (c == '.')
      keys.emplace_back();
    else
      keys.back() += c;
  if (setting.key.size() > kLongestKey ||
      std::any_of(keys.begin(), keys.end(), [](const std::string& k) { return k.empty(); }))
    throw ConfigError(
        fmt::format("gapscope: --set has the key {}, expected keys with dots between them, at "
                    "most {} characters, e.g. model.parameters.gap",
                    shown(setting.key.substr(0, kLongestKey)), kLongestKey));
  return keys;
}

/// A message of the value's own text without the line in it.
std::string without_line(const std::string& message, const Setting& setting) {
  const std::string place = setting_place(setting) + ":";
  const std::size_t after = message.find_first_not_of("0123456789", place.size());
  const bool has_line = message.starts_with(place) && after != message.npos && after > place.size();
  return has_line ? setting_place(setting) + message.substr(after) : message;
}

YAML::Node node_of(const Setting& setting) {
  YAML::Node node;
  try {
    node = parse_tree(setting.yaml, setting_place(setting));
  } catch (const ConfigError& error) {
    throw ConfigError(without_line(error.what(), setting));
  }
  if (!node.IsNull()) return node;
  throw ConfigError(setting_place(setting), "is empty, expected a value, --set KEY=VALUE");
}

/// One setting on its way down the tree. Maps and lists on the way are made anew, since an alias may share
/// them with another place.
class Overlay {
 public:
  Overlay(const Setting& setting, std::size_t number, Source& source)
      : setting_(setting),
        number_(number),
        source_(source),
        keys_(keys_of(setting)),
        value_(setting.removed ? YAML::Node() : node_of(setting)) {}

  YAML::Node over(const YAML::Node& root) { return laid(root, 0, ""); }

 private:
  YAML::Node laid(const YAML::Node& node, std::size_t depth, const std::string& path) {
    if (depth == keys_.size()) return take_over(path), value_;
    if (node.IsSequence()) return in_list(node, depth, path);
    if (node.IsMap() || node.IsNull()) return in_map(node, depth, path);
    throw ConfigError(
        setting_place(setting_),
        fmt::format("{} is {}, which holds no key {}, expected --set '{}={{{}: ...}}' to put a map there",
                    path, shown(node.Scalar()), shown(keys_[depth]), path, keys_[depth]));
  }

  YAML::Node in_map(const YAML::Node& node, std::size_t depth, const std::string& path) {
    const std::string& key = keys_[depth];
    const std::string below = path.empty() ? key : path + "." + key;
    YAML::Node out(YAML::NodeType::Map);
    bool found = false;
    for (const auto& entry : node) {
      const bool is_it = !found && entry.first.IsScalar() && entry.first.Scalar() == key;
      found = found || is_it;
      if (is_it && setting_.removed && depth + 1 == keys_.size()) continue;
      out.force_insert(entry.first, is_it ? laid(entry.second, depth + 1, below) : entry.second);
    }
    if (!found && !setting_.removed) {
      source_.laid_over[below] = number_;
      const auto kind = key == "effects" ? YAML::NodeType::Sequence : YAML::NodeType::Null;
      out.force_insert(key, laid(YAML::Node(kind), depth + 1, below));
    }
    return out;
  }

  YAML::Node in_list(const YAML::Node& node, std::size_t depth, const std::string& path) {
    const std::string& key = keys_[depth];
    const bool by_place = key.find_first_not_of("0123456789") == key.npos;
    const std::size_t place = by_place ? place_in(node, key, path) : item_with(node, key);
    YAML::Node out(YAML::NodeType::Sequence);
    for (std::size_t i = 0; i < std::max(node.size(), place + 1); ++i) {
      const std::string item = fmt::format("{}[{}]", path, i);
      if (i >= node.size()) source_.laid_over[item] = number_;
      const YAML::Node there = i < node.size() ? node[i] : YAML::Node(YAML::NodeType::Null);
      out.push_back(i == place ? laid(there, depth + (by_place ? 1 : 0), item) : there);
    }
    return out;
  }

  std::size_t place_in(const YAML::Node& list, const std::string& digits, const std::string& path) const {
    if (digits.size() < 6 && std::stoul(digits) < list.size()) return std::stoul(digits);
    throw ConfigError(
        setting_place(setting_),
        fmt::format("{} has {} items, expected a place from 0 on and below that, or the key of an item", path,
                    list.size()));
  }

  /// The item that is a map with the key; past the last one if there is none.
  static std::size_t item_with(const YAML::Node& list, const std::string& key) {
    std::size_t i = 0;
    while (i < list.size() && !(list[i].IsMap() && list[i][key].IsDefined())) ++i;
    return i;
  }

  /// What earlier settings wrote below the path is gone.
  void take_over(const std::string& path) {
    std::erase_if(source_.laid_over, [&](const auto& entry) {
      const std::string& other = entry.first;
      return other.starts_with(path) && other.size() > path.size() &&
             (other[path.size()] == '.' || other[path.size()] == '[');
    });
    source_.laid_over[path] = number_;
  }

  const Setting& setting_;
  std::size_t number_;
  Source& source_;
  std::vector<std::string> keys_;
  YAML::Node value_;
};

/// "file:-2: what is wrong" as "--set KEY: what is wrong": no line of a file is below 0. Empty for another
/// message.
std::string told_of_settings(const std::string& message, std::span<const Setting> settings) {
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const std::string line = fmt::format(":{}: ", line_of_setting(i));
    if (const std::size_t at = message.find(line); at != message.npos)
      return setting_place(settings[i]) + ": " + message.substr(at + line.size());
  }
  return "";
}

}  // namespace

Value overlaid(const Value& document, std::span<const Setting> settings) {
  if (settings.empty()) return document;
  Source source{document.file()};
  YAML::Node root = document.node();
  for (const Setting& setting : settings) {
    const std::size_t number = source.settings.size();
    source.settings.push_back(setting_place(setting));
    root = Overlay(setting, number, source).over(root);
  }
  return {root, document.path(), std::make_shared<const Source>(std::move(source)), document.line()};
}

}  // namespace internal::config

Setting read_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0)
    throw ConfigError(fmt::format(
        "gapscope: --set is {}, expected KEY=VALUE, e.g. --set model.parameters.gap=0.02", shown(text)));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::vector<Setting> model_from(const std::string& file) {
  using internal::config::parse_tree;
  const YAML::Node root = parse_tree(internal::config::read_text(file), file);
  std::vector<Setting> all;
  for (const char* key : {"model", "anchor"})
    all.push_back({key, "", fmt::format("--model-from {}: {}", file, key), true, true});
  for (Setting& s : all)
    if (root.IsMap() && root[s.key].IsDefined()) s.yaml = YAML::Dump(root[s.key]), s.removed = false;
  if (all.front().removed)
    throw ConfigError(file, "has no model:, expected a configuration, such as the fitted.yaml of a report");
  return all;
}

std::vector<Setting> over_both_models(const std::string& file, const std::vector<Setting>& settings) {
  using internal::config::parse_tree;
  const auto of_model = [](const Setting& s) { return s.key == "model" || s.key.starts_with("model."); };
  if (std::none_of(settings.begin(), settings.end(), of_model)) return settings;
  const YAML::Node root = parse_tree(internal::config::read_text(file), file);
  const auto has = [](const YAML::Node& map, const char* key) { return map.IsMap() && map[key].IsDefined(); };
  if (!has(root, "model") || !has(root, "simulation") || !has(root["simulation"], "model") ||
      YAML::Dump(root["model"]) != YAML::Dump(root["simulation"]["model"]))
    return settings;
  std::vector<Setting> both;
  for (const Setting& s : settings) {
    both.push_back(s);
    if (!of_model(s)) continue;
    const std::string place = s.place.empty() ? "--set " + s.key : s.place;
    both.push_back({"simulation." + s.key, s.yaml, place, s.removed, false});
  }
  return both;
}

void telling_settings(std::span<const Setting> settings, const std::function<void()>& work) {
  try {
    work();
  } catch (const ConfigError& error) {
    const std::string told = internal::config::told_of_settings(error.what(), settings);
    if (told.empty()) throw;
    throw ConfigError(told);
  }
}

}  // namespace gapscope
