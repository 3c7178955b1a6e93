#include "config/campaign_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/require.h"
#include "config/axis_reader.h"
#include "config/configuration_reader.h"
#include "config/yaml_document.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace internal::config {
namespace {

constexpr int kDrawnDigits = 9;

/// Mixes a word thoroughly (the finaliser of splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// The number at a share of a range.
AxisValue at_share(const Interval& range, bool logarithmic, double share) {
  const double value = logarithmic ? range.low * std::pow(range.high / range.low, share)
                                   : range.low + share * (range.high - range.low);
  return axis_number(std::clamp(value, range.low, range.high), kDrawnDigits);
}

/// A share in [0, 1) for one path of one run.
double drawn_share(std::uint64_t seed, const std::string& path, std::uint64_t index) {
  std::mt19937_64 generator = random_stream(seed, fmt::format("campaign {} {}", path, index));
  return uniform(generator, 0.0, 1.0);
}

AxisValue hypercube_value(const LatinHypercube& cube, const CampaignAxis& axis, std::uint64_t index) {
  const std::uint64_t key = random_stream(cube.seed, "hypercube " + axis.path)();
  const std::uint64_t stratum = permuted(index, cube.samples, key);
  if (axis.values.empty()) {
    const double share = (static_cast<double>(stratum) + drawn_share(cube.seed, axis.path, index)) /
                         static_cast<double>(cube.samples);
    return at_share(axis.range, axis.logarithmic, share);
  }
  return axis.values[stratum * axis.values.size() / cube.samples];
}

/// The item of a list of effects that is called so; its size where none is.
std::size_t place_of_name(const YAML::Node& list, const std::string& name) {
  std::size_t i = 0;
  while (i < list.size() && !(list[i].IsMap() && list[i][name].IsDefined())) ++i;
  return i;
}

/// Writes a value into a tree of maps and lists, whose items are counted from 0 or called by their only key;
/// maps that are missing are made.
void write_at(YAML::Node node, const std::string& path, const std::string& whole, const YAML::Node& value) {
  const std::size_t dot = path.find('.');
  const std::string key = path.substr(0, dot);
  if (node.IsSequence()) {
    if (const std::size_t named = place_of_name(node, key); named < node.size())
      return write_at(node[named], path, whole, value);
    const bool is_place = !key.empty() && key.size() < 6 && key.find_first_not_of("0123456789") == key.npos;
    if (!is_place || std::stoul(key) >= node.size())
      throw ConfigError(
          fmt::format("{}: '{}' is no place in a list of {}, expected 0 to {} or the name of an item", whole,
                      key, node.size(), node.size() - 1));
    if (dot == path.npos)
      node[std::stoul(key)] = value;
    else
      write_at(node[std::stoul(key)], path.substr(dot + 1), whole, value);
    return;
  }
  if (!node.IsMap() && !node.IsNull())
    throw ConfigError(fmt::format(
        "{}: there is no map that holds '{}', expected a path of keys to a parameter", whole, key));
  if (dot == path.npos) {
    node[key] = value;
    return;
  }
  if (!node[key].IsDefined()) node[key] = YAML::Node(YAML::NodeType::Map);
  write_at(node[key], path.substr(dot + 1), whole, value);
}

Value base_document(const CampaignConfig& c) {
  const Value document = parse_document(c.base_text, c.base_file);
  if (!c.base_inline) return document;
  const YAML::Node base = document.node()["base"];
  return {base, "", std::make_shared<const Source>(Source{c.base_file}), base.Mark().line + 1};
}

}  // namespace

std::uint64_t permuted(std::uint64_t index, std::uint64_t size, std::uint64_t key) {
  GAPSCOPE_REQUIRE(index < size);
  int half = 1;  // bits of each half; a Feistel network permutes [0, 4^half)
  while (std::uint64_t{1} << (2 * half) < size) ++half;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {  // walks until it is back among the indices
    std::uint64_t left = index >> half, right = index & mask;
    for (std::uint64_t round = 0; round < 4; ++round) {
      const std::uint64_t turned = left ^ (mixed(right + (key ^ mixed(round + 1))) & mask);
      left = right;
      right = turned;
    }
    index = left << half | right;
  } while (index >= size);
  return index;
}

void base_configuration(const CampaignConfig& c) { read_configuration(base_document(c)); }

}  // namespace internal::config

std::vector<AxisValue> campaign_point(const CampaignConfig& c, std::uint64_t index) {
  GAPSCOPE_REQUIRE(index < c.runs());
  std::vector<AxisValue> point(c.axes.size());
  std::uint64_t rest = index;
  for (std::size_t i = c.axes.size(); i-- > 0;) {
    const CampaignAxis& axis = c.axes[i];
    if (c.hypercube) {
      point[i] = internal::config::hypercube_value(*c.hypercube, axis, index);
      continue;
    }
    point[i] = axis.values[rest % axis.values.size()];
    rest /= axis.values.size();
  }
  for (const CampaignDraw& draw : c.draws)
    point.push_back(internal::config::at_share(draw.range, draw.logarithmic,
                                               internal::config::drawn_share(1, draw.path, index)));
  return point;
}

Configuration campaign_run(const CampaignConfig& c, std::uint64_t index) {
  const internal::config::Value document = internal::config::base_document(c);
  const std::vector<AxisValue> point = campaign_point(c, index);
  for (std::size_t i = 0; i < point.size(); ++i) {
    const std::string& path = i < c.axes.size() ? c.axes[i].path : c.draws[i - c.axes.size()].path;
    internal::config::write_at(document.node(), path, path, YAML::Load(point[i].yaml));
  }
  Configuration run = internal::config::read_configuration(document);
  run.name = fmt::format("{}_run_{}", c.name, index + 1);
  return run;
}

}  // namespace gapscope
