#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/campaign_figures.h"
#include "report/rich_text.h"
#include "report/ticks.h"

namespace gapscope::internal::report {
namespace {

/// What a run costs [its unit]; NaN where that is not known.
using Cost = std::vector<double>;

Axis decades(const std::string& name, const std::string& unit, const std::vector<double>& values,
             double least_high) {
  Interval range{kNaN, least_high};
  for (const double v : values)
    if (std::isfinite(v)) range = {std::fmin(range.low, std::floor(v)), std::fmax(range.high, std::ceil(v))};
  Axis axis{name, unit, {range.low - 0.2, range.high + 0.2}};
  for (double decade = range.low; decade <= range.high; ++decade)
    axis.places.push_back({decade, fmt::format("{:g}", std::pow(10.0, decade))});
  return axis;
}

Series mark_of(const CampaignEstimator& e, double x, double y, const Interval& around) {
  Series s;
  s.label = e.name;
  s.style = {e.style.colour, e.style.width, {}};
  s.marker = e.marker;
  s.joined = false;
  s.x = {x};
  s.y = {y};
  s.y_intervals = {around};
  return s;
}

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> logs;
  for (const double v : values) logs.push_back(v > 0.0 ? std::log10(v) : kNaN);
  return logs;
}

/// Median error, up to what 90 % of the runs do not exceed.
Panel error_over(const CampaignSummary& s, const std::string& name, const std::string& unit,
                 const Cost& cost) {
  const auto estimators = estimators_of(s);
  const std::vector<double> x = logarithms(cost);
  std::vector<double> heights;
  Panel p;
  p.title = "Error: median, up to the 90 % limit";
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    const EstimatorScore& e = s.total.*(estimators[i].score);
    const double low = std::log10(100.0 * e.median_error), high = std::log10(100.0 * e.error_90);
    if (!std::isfinite(low) || !std::isfinite(high) || std::isnan(x[i])) continue;
    heights.insert(heights.end(), {low, high});
    p.series.push_back(mark_of(estimators[i], x[i], low, {low, high}));
  }
  p.x = decades(name, unit, x, kNaN);
  p.y = decades("|error|", "%", heights, 1.0);
  p.height = 420.0;
  return p;
}

/// Share of the runs that come out within 5 %, with Wilson's limits.
Panel share_over(const CampaignSummary& s, const std::string& name, const std::string& unit,
                 const Cost& cost) {
  const auto estimators = estimators_of(s);
  const std::vector<double> x = logarithms(cost);
  Panel p;
  p.title = "Within 5 % of the true gap";
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    const EstimatorScore& e = s.total.*(estimators[i].score);
    if (e.runs == 0 || std::isnan(x[i])) continue;
    const Interval limits = wilson(e.within_5, e.runs);
    p.series.push_back(
        mark_of(estimators[i], x[i], 100.0 * e.within_5 / e.runs, {100.0 * limits.low, 100.0 * limits.high}));
  }
  p.x = decades(name, unit, x, kNaN);
  p.y = {"share of the runs", "%", {-4.0, 104.0}};
  p.height = 420.0;
  return p;
}

}  // namespace

FigureData campaign_cost(const CampaignSummary& s) {
  FigureData figure{"cost.png", literal(s.name) + ": what it costs"};
  Cost passes;
  bool judged = false;
  for (const CampaignEstimator& e : estimators_of(s)) {
    const EstimatorScore& score = s.total.*(e.score);
    judged = judged || score.judged > 0;
    passes.push_back(score.passes);
  }
  if (!judged) return missing_figure(figure, "no run has a true gap and an estimate of it");
  figure.width = 3200.0;
  figure.columns = 2;
  figure.lines = {
      fmt::format("n = {} runs, recordings of {:.0f} samples, {:g} s (medians). A pass runs every sample "
                  "once through a differentiator or a model.",
                  s.total.runs, s.samples, s.recorded)};
  figure.panels = {error_over(s, "work", "passes over the recording", passes),
                   share_over(s, "work", "passes over the recording", passes)};
  std::vector<std::string> told;
  for (const CampaignEstimator& e : estimators_of(s))
    told.push_back(fmt::format("{} {:.0f}", e.name, (s.total.*(e.score)).passes));
  figure.reading =
      fmt::format("Passes over the recording, median: {}. The times of this machine are in timing.json.",
                  fmt::join(told, ", "));
  return figure;
}

}  // namespace gapscope::internal::report
