#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/campaign_figures.h"
#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

/// What a map shows of a cell, and how bad that is from 0 (white) to 1 (dark); NaN where there is nothing to
/// show.
struct Shown {
  double value = kNaN;  ///< a share
  double badness = kNaN;
  int of = 0;  ///< runs that it is of
};
using Look = Shown (*)(const EstimatorScore&);

/// Of two columns of a journal, in which two or three maps stand [px]
constexpr double kSheetWidth = 3180.0;

constexpr Colour kNothing{214, 214, 214};
constexpr Colour kDark{8, 48, 107};
constexpr Colour kLight{247, 251, 255};

Colour shade_of(double badness) {
  const auto mix = [&](int light, int dark) {
    return static_cast<int>(std::lround(light + std::clamp(badness, 0.0, 1.0) * (dark - light)));
  };
  return {mix(kLight.red, kDark.red), mix(kLight.green, kDark.green), mix(kLight.blue, kDark.blue)};
}

/// White at 0.1 %, dark at 20 %, by the logarithm.
Shown error_look(const EstimatorScore& e) {
  const double decades = std::log10(std::max(e.median_error, 1e-12) / 1e-3) / std::log10(0.2 / 1e-3);
  return {e.median_error, std::isnan(e.median_error) ? kNaN : std::clamp(decades, 0.0, 1.0), e.judged};
}
Shown refusal_look(const EstimatorScore& e) { return {e.refusal(), e.refusal(), e.runs}; }
Shown coverage_look(const EstimatorScore& e) {
  return {e.coverage(), (0.95 - e.coverage()) / 0.95, e.claimed};
}

/// White at 0.1 %, dark at 100 %, by the logarithm.
Shown score_look(const EstimatorScore& e) {
  const double decades = std::log10(std::max(e.interval_score, 1e-12) / 1e-3) / 3.0;
  return {e.interval_score, std::isnan(e.interval_score) ? kNaN : std::clamp(decades, 0.0, 1.0), e.claimed};
}

Tile tile_at(int a, int b, const Shown& shown) {
  Tile tile{{a - 0.5, a + 0.5}, {b - 0.5, b + 0.5}, kNothing, "–", kInk};
  if (std::isnan(shown.badness)) return tile;
  tile.colour = shade_of(shown.badness);
  tile.text = percent(shown.value);
  tile.text.resize(tile.text.size() - 2);  // the title says percent
  tile.note = fmt::format("n {}", shown.of);
  if (shown.badness > 0.45) tile.ink = {255, 255, 255};
  return tile;
}

Panel empty_map(const CampaignSummary& s, const SummaryTable& table, const std::string& title) {
  return {title, campaign_axis(s.axes[table.a], {0.5, 0.5}), campaign_axis(s.axes[table.b], {0.5, 0.5}),
          std::max(260.0, 100.0 * static_cast<double>(s.axes[table.b].bins.size()))};
}

/// A map of each estimator, where any of them has a number.
void add_row(FigureData& figure, const CampaignSummary& s, const SummaryTable& table, const char* what,
             Look look) {
  std::vector<Panel> row;
  bool any = false;
  for (const CampaignEstimator& e : estimators_of(s)) {
    Panel& p = row.emplace_back(empty_map(s, table, fmt::format("{}: {}", e.name, what)));
    for (const SummaryCell& cell : table.cells) {
      const Shown shown = look(cell.*(e.score));
      any = any || std::isfinite(shown.badness);
      p.tiles.push_back(tile_at(cell.a, cell.b, shown));
    }
  }
  if (any) figure.panels.insert(figure.panels.end(), row.begin(), row.end());
}

void add_disagreement(FigureData& figure, const CampaignSummary& s, const SummaryTable& table) {
  Panel apart = empty_map(s, table, "model-free and fitted gap disagree (% where both answer)");
  Panel nearer = empty_map(s, table, "of these, model-free nearer to the truth (%)");
  for (const SummaryCell& c : table.cells) {
    const double share = c.both > 0 ? static_cast<double>(c.disagree) / c.both : kNaN;
    const double won = c.disagree > 0 ? static_cast<double>(c.model_free_nearer) / c.disagree : kNaN;
    apart.tiles.push_back(tile_at(c.a, c.b, {share, share, c.both}));
    nearer.tiles.push_back(tile_at(c.a, c.b, {won, std::isnan(won) ? kNaN : 0.0, c.disagree}));
  }
  figure.panels.push_back(std::move(apart));
  const bool any = std::any_of(table.cells.begin(), table.cells.end(),
                               [](const SummaryCell& c) { return c.disagree > 0; });
  if (any) figure.panels.push_back(std::move(nearer));
}

/// How often an estimator is there for nearly every run, and how good it is then.
std::string reading_of(const SummaryTable& table, const CampaignEstimator& e) {
  int answering = 0, good = 0;
  for (const SummaryCell& cell : table.cells) {
    const EstimatorScore& score = cell.*(e.score);
    answering += score.refusal() <= 0.1 ? 1 : 0;
    good += score.within_2 >= 0.9 * cell.runs ? 1 : 0;
  }
  return fmt::format(
      "{}: an answer in at least 90 % of the runs in {} of {} settings, within 2 % of the true gap in {}",
      e.name, answering, table.cells.size(), good);
}

/// Where the estimators contradict each other most often; empty where they never do.
std::string disagreement_of(const CampaignSummary& s, const SummaryTable& table) {
  const auto share = [](const SummaryCell& c) {
    return c.both > 0 ? static_cast<double>(c.disagree) / c.both : 0.0;
  };
  const auto most =
      std::max_element(table.cells.begin(), table.cells.end(),
                       [&](const SummaryCell& x, const SummaryCell& y) { return share(x) < share(y); });
  if (most == table.cells.end() || most->disagree == 0) return "";
  return fmt::format("they disagree most at {} and {} ({} of {} runs in which both answered)",
                     s.axes[table.a].bins[most->a].label, s.axes[table.b].bins[most->b].label, most->disagree,
                     most->both);
}

}  // namespace

FigureData campaign_map(const CampaignSummary& s, const SummaryTable& table) {
  FigureData figure;
  const auto estimators = estimators_of(s);
  figure.file = fmt::format("map_{}_{}.png", table.a + 1, table.b + 1);
  figure.title =
      literal(s.name) + ": " + literal(s.axes[table.a].name) + " × " + literal(s.axes[table.b].name);
  figure.lines = {"Percent of the n runs below each; dark is bad; – where there is nothing to judge."};
  figure.columns = static_cast<int>(estimators.size());
  figure.width = estimators.size() > 1 ? kSheetWidth : kSheetWidth / 2.0;
  for (const int axis : {table.a, table.b})
    if (const std::string key = campaign_key(s.axes[static_cast<std::size_t>(axis)]); !key.empty())
      figure.lines.push_back(key);
  add_row(figure, s, table, "median |error| (%)", error_look);
  add_row(figure, s, table, "no answer (% of the runs)", refusal_look);
  add_row(figure, s, table, "95 % interval holds the true gap (%)", coverage_look);
  add_row(figure, s, table, "mean interval score (% of the gap)", score_look);
  if (s.model_free && s.reference) add_disagreement(figure, s, table);
  std::vector<std::string> readings;
  for (const CampaignEstimator& e : estimators) readings.push_back(reading_of(table, e));
  if (const std::string most = disagreement_of(s, table); !most.empty()) readings.push_back(most);
  figure.reading = fmt::format("{}.", fmt::join(readings, "; "));
  return figure;
}

}  // namespace gapscope::internal::report
