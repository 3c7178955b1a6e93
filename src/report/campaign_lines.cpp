#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/campaign_figures.h"
#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

constexpr double kAside = 0.04;

using Number = double (*)(const EstimatorScore&);

/// One line per estimator, a point per value of the axis.
std::vector<Series> series_of(const CampaignSummary& s, const SummaryTable& table, Number number) {
  std::vector<Series> all;
  for (const CampaignEstimator& e : estimators_of(s)) {
    Series line;
    line.label = e.name;
    line.style = e.style;
    line.marker = e.marker;
    const double aside = kAside * static_cast<double>(all.size());  // so that no mark hides the other
    for (const SummaryCell& cell : table.cells) {
      line.x.push_back(cell.a + aside);
      line.y.push_back(number(cell.*(e.score)));
    }
    all.push_back(std::move(line));
  }
  return all;
}

Panel panel(const std::string& title, const SummaryAxis& axis, const std::string& y_name) {
  return {title, campaign_axis(axis, {0.4, 0.4}), {y_name, "%"}, 420.0};
}

double log_percent(double error) { return error > 0.0 ? std::log10(100.0 * error) : kNaN; }

/// Decades of percent: a solid line with marks, and a thinner one beyond it.
Panel decades_panel(const CampaignSummary& s, const SummaryTable& table, const std::string& title,
                    const std::string& y_name, Number first, Number second, const std::string& second_name) {
  Panel p = panel(title, s.axes[table.a], y_name);
  p.series = series_of(s, table, first);
  for (Series& high : series_of(s, table, second)) {
    high.label += second_name;
    high.style.width = 2.0;
    high.marker = Marker::kNone;
    p.series.push_back(std::move(high));
  }
  Interval range{0.0, 0.0};
  for (const Series& line : p.series)
    for (const double y : line.y)
      if (std::isfinite(y)) range = {std::min(range.low, std::floor(y)), std::max(range.high, std::ceil(y))};
  std::erase_if(p.series, [](const Series& line) {
    return std::none_of(line.y.begin(), line.y.end(), [](double y) { return std::isfinite(y); });
  });
  p.y.range = {range.low - 0.1, std::max(1.0, range.high) + 0.1};
  for (double decade = range.low; decade <= std::max(1.0, range.high); ++decade)
    p.y.places.push_back({decade, fmt::format("{:g}", std::pow(10.0, decade))});
  return p;
}

Panel error_panel(const CampaignSummary& s, const SummaryTable& table) {
  return decades_panel(
      s, table, "Error: median and 90 % limit", "|error|",
      [](const EstimatorScore& e) { return log_percent(e.median_error); },
      [](const EstimatorScore& e) { return log_percent(e.error_90); }, ", 90 % of the runs below");
}

Panel interval_panel(const CampaignSummary& s, const SummaryTable& table) {
  return decades_panel(
      s, table, "95 % interval: median width, mean score", "of the gap",
      [](const EstimatorScore& e) { return log_percent(e.median_width); },
      [](const EstimatorScore& e) { return log_percent(e.interval_score); }, ", score");
}

/// With the 95 % intervals of the medians, cut where they would flatten everything else.
Panel bias_panel(const CampaignSummary& s, const SummaryTable& table) {
  constexpr double kRoom = 1.5;
  Panel p = panel("Bias: median of the signed error, 95 % interval", s.axes[table.a], "error");
  p.series = series_of(s, table, [](const EstimatorScore& e) { return 100.0 * e.bias; });
  double largest = 0.01;
  for (const Series& line : p.series)
    for (const double y : line.y) largest = std::fmax(largest, std::abs(y));
  p.y.range = {-kRoom * largest, kRoom * largest};
  const auto estimators = estimators_of(s);
  for (std::size_t k = 0; k < p.series.size(); ++k)
    for (const SummaryCell& cell : table.cells) {
      const Interval& ci = (cell.*(estimators[k].score)).bias_ci;
      p.series[k].y_intervals.push_back(
          {std::max(100.0 * ci.low, p.y.range.low), std::min(100.0 * ci.high, p.y.range.high)});
    }
  p.y_marks.push_back({0.0, guide_style(), ""});
  return p;
}

Panel share_panel(const std::string& title, const CampaignSummary& s, const SummaryTable& table,
                  const std::string& name, Number number) {
  Panel p = panel(title, s.axes[table.a], name);
  p.series = series_of(s, table, number);
  p.y.range = {-4.0, 104.0};
  return p;
}

Panel coverage_panel(const CampaignSummary& s, const SummaryTable& table) {
  Panel p = share_panel("Coverage of the 95 % intervals", s, table, "true gap inside",
                        [](const EstimatorScore& e) { return 100.0 * e.coverage(); });
  p.y_marks.push_back({95.0, guide_style(), "95 %"});
  const auto estimators = estimators_of(s);
  double lowest = 90.0;
  for (std::size_t k = 0; k < p.series.size(); ++k)
    for (const SummaryCell& cell : table.cells) {
      const EstimatorScore& e = cell.*(estimators[k].score);
      const Interval limits = e.claimed > 0 ? wilson(e.covered, e.claimed) : Interval{};
      p.series[k].y_intervals.push_back({100.0 * limits.low, 100.0 * limits.high});
      lowest = std::fmin(lowest, 100.0 * limits.low);
    }
  p.y.range.low = 10.0 * std::floor(lowest / 10.0) - 4.0;
  return p;
}

bool has_data(const Panel& p) {
  return std::any_of(p.series.begin(), p.series.end(), [](const Series& line) {
    return std::any_of(line.y.begin(), line.y.end(), [](double y) { return std::isfinite(y); });
  });
}

/// "falls from 3 % at 250 Hz to 0.4 % at 8 kHz"
std::string course(const CampaignSummary& s, const SummaryTable& table, const CampaignEstimator& e) {
  const SummaryCell *first = nullptr, *last = nullptr;
  for (const SummaryCell& cell : table.cells) {
    if (std::isnan((cell.*(e.score)).median_error)) continue;
    if (first == nullptr) first = &cell;
    last = &cell;
  }
  if (first == nullptr) return fmt::format("{}: no answer anywhere", e.name);
  const auto& bins = s.axes[table.a].bins;
  const auto said = [&](const SummaryCell& c) {
    return fmt::format("{} at {} (no answer in {} of the runs)", percent((c.*(e.score)).median_error),
                       bins[c.a].label, percent((c.*(e.score)).refusal()));
  };
  return first == last ? fmt::format("{}: median error {}", e.name, said(*first))
                       : fmt::format("{}: median error {}, {}", e.name, said(*first), said(*last));
}

}  // namespace

FigureData campaign_line(const CampaignSummary& s, const SummaryTable& table) {
  const SummaryAxis& axis = s.axes[table.a];
  FigureData figure{fmt::format("along_{}.png", table.a + 1),
                    literal(s.name) + ": along the " + literal(axis.name)};
  figure.width = 3200.0;
  figure.columns = 2;
  if (const std::string key = campaign_key(axis); !key.empty()) figure.lines = {key};
  figure.panels = {
      error_panel(s, table),
      share_panel("No answer", s, table, "share of the runs",
                  [](const EstimatorScore& e) { return 100.0 * e.refusal(); }),
      bias_panel(s, table),
      coverage_panel(s, table),
      interval_panel(s, table),
      share_panel("Within 5 % of the true gap", s, table, "share of the runs",
                  [](const EstimatorScore& e) { return e.runs > 0 ? 100.0 * e.within_5 / e.runs : kNaN; })};
  std::erase_if(figure.panels, [](const Panel& p) { return !has_data(p); });
  std::vector<std::string> courses;
  for (const CampaignEstimator& e : estimators_of(s)) courses.push_back(course(s, table, e));
  figure.reading = fmt::format("All other axes taken together. {}.", fmt::join(courses, "; "));
  return figure;
}

}  // namespace gapscope::internal::report
