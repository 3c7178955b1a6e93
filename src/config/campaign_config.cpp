#include "config/campaign_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "config/axis_reader.h"
#include "config/campaign_point.h"
#include "config/configuration_reader.h"
#include "config/yaml_document.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace internal::config {
namespace {

const std::vector<std::string> kKeys = {"name", "base", "axes", "drawn", "sampling", "estimators"};

void read_base(const Section& root, const std::string& text, CampaignConfig& c) {
  const Value base = root.require("base", "a configuration, or the file of one");
  c.base_inline = base.is_map();
  if (c.base_inline) {
    c.base_text = text;
    c.base_file = c.file;
    return;
  }
  c.base_file = (std::filesystem::path(c.file).parent_path() / base.text()).lexically_normal().string();
  if (std::error_code unreachable; !std::filesystem::is_regular_file(c.base_file, unreachable))
    base.fail(fmt::format("names {}, which is not there, expected the file of a configuration", base.text()));
  c.base_text = read_text(c.base_file);
}

LatinHypercube read_hypercube(const Value& value) {
  const Section section(value, {"samples", "seed"});
  LatinHypercube cube;
  cube.samples = section.require("samples", "the number of runs").natural(kMostCounted);
  if (const auto seed = section.find("seed")) cube.seed = seed->natural(~std::uint64_t{0});
  if (cube.samples == 0) value.fail("has 0 samples, expected at least 1");
  return cube;
}

void read_sampling(const Value& value, CampaignConfig& c) {
  if (value.is_map()) {
    c.hypercube = read_hypercube(
        Section(value, {"latin_hypercube"}).require("latin_hypercube", "{samples: ..., seed: ...}"));
  } else if (!value.is_text() || value.text() != "full_factorial") {
    value.fail_expecting("full_factorial or {latin_hypercube: {samples: ..., seed: ...}}");
  }
}

void read_estimators(const Value& value, CampaignConfig& c) {
  c.literal = c.model_free = c.reference = false;
  bool* const asked[] = {&c.literal, &c.model_free, &c.reference};
  for (const Value& item : value.items()) *asked[item.word({"literal", "model_free", "reference"})] = true;
  if (!c.literal && !c.model_free && !c.reference)
    value.fail("is an empty list, expected some of literal, model_free and reference");
}

/// No path twice, and none within another one: what is written would depend on the order.
void require_separate_paths(const CampaignConfig& c) {
  std::vector<std::pair<std::string, int>> paths;
  for (const CampaignAxis& axis : c.axes) paths.emplace_back(axis.path + ".", axis.line);
  for (const CampaignDraw& draw : c.draws) paths.emplace_back(draw.path + ".", draw.line);
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto& [a, line] = paths[i];
      const std::string& b = paths[k].first;
      if (a.starts_with(b) || b.starts_with(a))
        throw ConfigError(c.file, line,
                          fmt::format("{} and {} write to the same place, expected separate parameters",
                                      b.substr(0, b.size() - 1), a.substr(0, a.size() - 1)));
    }
}

void require_possible_number(const CampaignConfig& c, const std::vector<WrittenAxis>& axes, const Value& at) {
  double runs = c.hypercube ? static_cast<double>(c.hypercube->samples) : 1.0, values = 0.0;
  for (const WrittenAxis& a : axes) {
    values += static_cast<double>(a.count);
    if (!c.hypercube) runs *= static_cast<double>(a.count);
    if (values > kMostCampaignRuns)
      throw ConfigError(c.file, a.axis.line,
                        fmt::format("{} brings the values of all axes to {:.0f}, expected at most {:.0f}",
                                    a.axis.path, values, kMostCampaignRuns));
  }
  if (runs > kMostCampaignRuns)
    at.fail(fmt::format("{} {:.0f} runs, expected at most {:.0f}", c.hypercube ? "asks for" : "give", runs,
                        kMostCampaignRuns));
}

void read_variation(const Section& root, CampaignConfig& c) {
  const Value axes = root.require("axes", "{path: values}, e.g. simulation.rate: [1000, 5000]");
  std::vector<WrittenAxis> written;
  for (const auto& [path, value] : axes.entries())
    written.push_back(read_axis(path, value, c.hypercube.has_value()));
  if (written.empty()) axes.fail("is an empty map, expected at least one parameter to vary");
  require_possible_number(c, written, c.hypercube ? *root.find("sampling") : axes);
  for (WrittenAxis& axis : written) c.axes.push_back(filled(std::move(axis)));
  if (const auto drawn = root.find("drawn"))
    for (const auto& [path, value] : drawn->entries()) c.draws.push_back(read_draw(path, value));
  require_separate_paths(c);
}

/// The place of the first axis that the base does not take by itself, else of all axes.
int line_to_blame(const CampaignConfig& c, const Value& axes) {
  for (const CampaignAxis& axis : c.axes) {
    CampaignConfig alone = c;
    alone.axes = {axis};
    alone.draws.clear();
    try {
      campaign_run(alone, 0);
    } catch (const ConfigError&) {
      return axis.line;
    }
  }
  return axes.line();
}

CampaignConfig read_campaign(const std::string& text, const std::string& file) {
  const Value document = parse_document(text, file);
  const Section root(document, kKeys);
  CampaignConfig c;
  c.file = file;
  c.name = read_name(root, file);
  read_base(root, text, c);
  if (const auto sampling = root.find("sampling")) read_sampling(*sampling, c);
  if (const auto estimators = root.find("estimators")) read_estimators(*estimators, c);
  read_variation(root, c);
  base_configuration(c);  // told with its own place where it is wrong by itself
  try {
    const Configuration first = campaign_run(c, 0);
    if (c.reference) require_reference_model(first);
    const bool has_bound = first.detector.literal.has_value();
    if (const auto estimators = root.find("estimators"); estimators && c.literal && !has_bound)
      estimators->fail(
          "names literal, expected detector: {literal: L}, its bound [rad/s^2], in the base or an axis");
    if (const auto estimators = root.find("estimators");
        estimators && c.literal && c.model_free && first.detector.method == DetectorMethod::kLiteral)
      estimators->fail(
          "has literal twice: detector: {method: literal} makes model_free S1 to S6 as well, expected detector: "
          "{literal: L} without a method");
    c.literal = c.literal && has_bound;
  } catch (const ConfigError& error) {
    throw ConfigError(file, line_to_blame(c, *root.find("axes")),
                      fmt::format("the first run cannot be made: {}", error.what()));
  }
  return c;
}

std::string identity_of(const CampaignAxis& axis) {
  std::vector<std::string> values;
  for (const AxisValue& v : axis.values) values.push_back(v.yaml);
  const std::string range = values.empty()
                                ? fmt::format("{} {} to {}", axis.logarithmic ? "log_range" : "range",
                                              axis.range.low, axis.range.high)
                                : fmt::format("{}", fmt::join(values, ", "));
  return fmt::format("axis {}{}: {}\n", axis.path, axis.repeat ? " (repeat)" : "", range);
}

}  // namespace
}  // namespace internal::config

std::uint64_t CampaignConfig::runs() const {
  if (hypercube) return hypercube->samples;
  std::uint64_t product = 1;
  for (const CampaignAxis& axis : axes) product *= axis.values.size();
  return product;
}

CampaignConfig load_campaign(const std::string& path) {
  return internal::config::read_campaign(internal::config::read_text(path), path);
}

std::string estimator_names(bool literal, bool model_free, bool reference) {
  std::vector<std::string> names;
  if (literal) names.emplace_back("literal");
  if (model_free) names.emplace_back("model_free");
  if (reference) names.emplace_back("reference");
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string campaign_identity(const CampaignConfig& c) {
  std::string text = fmt::format("estimators: {}\n", estimator_names(c.literal, c.model_free, c.reference));
  text += c.hypercube ? fmt::format("sampling: latin_hypercube of {} samples, seed {}\n",
                                    c.hypercube->samples, c.hypercube->seed)
                      : std::string("sampling: full_factorial\n");
  for (const CampaignAxis& axis : c.axes) text += internal::config::identity_of(axis);
  for (const CampaignDraw& draw : c.draws)
    text += fmt::format("drawn {}: {} {} to {}\n", draw.path, draw.logarithmic ? "log_uniform" : "uniform",
                        draw.range.low, draw.range.high);
  Configuration first = campaign_run(c, 0);
  first.name = "first_run";  // a name decides nothing
  return text + resolved_yaml(first);
}

}  // namespace gapscope
