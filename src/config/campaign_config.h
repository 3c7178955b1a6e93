#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/configuration.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

/// A value of an axis: what is written into the configuration, and its number where it is one.
struct AxisValue {
  std::string yaml;      ///< "2500", "auto", "{from_model: {...}}"
  double number = kNaN;  ///< NaN where it is no number
};

AxisValue axis_value(const std::string& yaml);

/// `axes: {path: ...}` – what one parameter of the configuration goes through:
///   a list                                         its items, of any kind
///   {range: [low, high], count: n}                 n numbers in equal steps, ends included
///   {log_range: [low, high], count: n}             n numbers in equal ratios
///   {repeat: n, seed: first}                       whole numbers from `seed` (default 1) upwards
struct CampaignAxis {
  std::string path;               ///< "simulation.rate": keys from the root, a place in a list as its number
  std::vector<AxisValue> values;  ///< empty for a range without a count: a hypercube draws from all of it
  Interval range;                 ///< of range and log_range
  bool logarithmic = false;
  bool repeat = false;  ///< only seeds: summaries average over it
  int line = 0;
};

/// `drawn: {path: {uniform: [low, high]}}` or `log_uniform` – a number of its own for each run, from its
/// place in the campaign alone: variety that adds no runs.
struct CampaignDraw {
  std::string path;
  Interval range;
  bool logarithmic = false;
  int line = 0;
};

/// `sampling: {latin_hypercube: {samples, seed}}`: every axis is divided into `samples` strata, each of which
/// is met exactly once, in an order of its own per axis.
struct LatinHypercube {
  std::uint64_t samples = 0;
  std::uint64_t seed = 1;
};

/// A campaign: one configuration, and what is varied in it.
struct CampaignConfig {
  std::string name;
  std::string file;          ///< the YAML itself, for messages
  std::string base_text;     ///< YAML that holds the base configuration
  std::string base_file;     ///< where that text is from; paths in it are relative to its folder
  bool base_inline = false;  ///< the base stands under `base:` of the campaign's own YAML
  std::vector<CampaignAxis> axes;
  std::vector<CampaignDraw> draws;
  std::optional<LatinHypercube> hypercube;  ///< absent: every combination
  /// `estimators:`; `literal`, S1 to S6 as printed, only where the first run has `detector: literal:`
  bool literal = true, model_free = true, reference = true;

  std::uint64_t runs() const;  ///< how many runs it has
};

/// More runs than this are refused.
constexpr double kMostCampaignRuns = 1e7;

/// Reads a campaign, and resolves its first run so that a path that leads nowhere is told here.
/// @throws ConfigError "file:line: what is wrong, what was expected"
CampaignConfig load_campaign(const std::string& path);

/// What run `index` writes into the configuration, in the order of axes, then draws. The last axis changes
/// fastest. A pure function of the campaign and the index.
std::vector<AxisValue> campaign_point(const CampaignConfig& campaign, std::uint64_t index);

/// The configuration of run `index`.  @throws ConfigError where its values contradict each other.
Configuration campaign_run(const CampaignConfig& campaign, std::uint64_t index);

/// "literal, model_free, reference", without those that are not asked.
std::string estimator_names(bool literal, bool model_free, bool reference);

/// All that decides the results of a campaign, line by line, in a form that comments and spaces do not
/// change.
std::string campaign_identity(const CampaignConfig& campaign);

}  // namespace gapscope
