#include "report/diagnosis_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/text.h"
#include "gapscope/base/statistics.h"
#include "report/budget_band.h"
#include "report/detectable.h"
#include "report/diagnosis_words.h"
#include "report/error_budget.h"
#include "report/last_resort.h"
#include "report/rich_text.h"
#include "report/simulator.h"
#include "report/ticks.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kShownCandidates = 12;
constexpr double kSmallShares = 0.4;  ///< on an axis that goes to the floor these would be hard to tell apart

LineStyle before_style() { return {kVermillion, 4.0, {}}; }
LineStyle after_style() { return {kBlue, 4.0, {16, 9}}; }

Series over_time(const std::string& label, const LineStyle& style, const MismatchTrace& t,
                 const std::vector<double>& values) {
  Series s{label, style};
  for (std::size_t i = t.scored_from; i < values.size(); ++i) {
    s.x.push_back(t.time(i));
    s.y.push_back(values[i]);
  }
  return s;
}

Panel time_panel(const std::string& title, const Axis& y, const MismatchTrace& t) {
  Panel panel{title,
              {"time $t$", "s", {t.time(std::min(t.scored_from, t.x1.size() - 1)), t.time(t.x1.size() - 1)}},
              y,
              460.0};  // a correcting torque in mN·m is named in one line
  return panel;
}

/// A pair of lines, before and after; the one line alone where nothing was added.
Panel pair_panel(const DiagnosisResult& r, const MismatchTrace& t, const std::string& title, const Axis& y,
                 const std::vector<double>& before, const std::vector<double>& after) {
  Panel panel = time_panel(title, y, t);
  panel.series.push_back(over_time(added(r) ? "nominal model" : "", before_style(), t, before));
  if (added(r)) panel.series.push_back(over_time(with_added(r), after_style(), t, after));
  return panel;
}

Panel correcting_panel(const DiagnosisResult& r, const MismatchTrace& t) {
  const ErrorBudget& budget = r.diagnosis.budget;
  Panel panel = pair_panel(r, t, "Correcting " + torque_word(r) + band_words(budget, t), correction_axis(r),
                           within_band(budget, t, t.torque_before), within_band(budget, t, t.torque_after));
  const double length = draw_means_of_a_block(panel.series);
  if (length > 0.0) panel.title += ", mean of " + quantity(length, "s");
  return panel;
}

/// 100 (1 − |x − x̂|/|x − mean|) of what is scored [%].
double fit_percent(const MismatchTrace& t, const std::vector<double>& simulated) {
  const std::span<const double> x = std::span(t.x1).subspan(t.scored_from);
  const double middle = mean(x);
  double missed = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    missed += std::pow(x[i] - simulated[t.scored_from + i], 2), moved += std::pow(x[i] - middle, 2);
  return moved > 0.0 ? 100.0 * (1.0 - std::sqrt(missed / moved)) : kNaN;
}

/// A line of the model, cut where it leaves the frame that the recording needs.
Series simulated_line(const std::string& name, const LineStyle& style, const MismatchTrace& t,
                      const std::vector<double>& simulated, const Interval& frame) {
  Series s = over_time("", style, t, simulated);
  bool leaves = false;
  for (double& x : s.y)
    if (x < frame.low || x > frame.high) x = kNaN, leaves = true;
  s.label = fmt::format("{}, fit {}{}", name, fit_text(fit_percent(t, simulated), 3),
                        leaves ? " (leaves the frame)" : "");
  return s;
}

/// The first picture that one looks for: from the first sample on the model is never corrected by the
/// recording.
Panel recorded_over_simulated(const DiagnosisResult& r, const MismatchTrace& t) {
  const bool simulated = t.simulated_before.size() == t.x1.size() || t.simulated_after.size() == t.x1.size();
  Panel panel = time_panel("Held-out recording", {"displacement " + position_name(r), length_unit(r)}, t);
  panel.series.push_back(over_time(simulated ? "recorded" : "", measured_style(), t, t.x1));
  if (!simulated) return panel;
  panel.title = r.diagnosis.closed_loop ? "Recorded, and simulated under the drive's controller"
                                        : "Recorded, and simulated without a restart";
  const auto [low, high] = std::minmax_element(panel.series[0].y.begin(), panel.series[0].y.end());
  const double room = 0.5 * (*high - *low);
  const Interval frame = {*low - room, *high + room};
  if (t.simulated_before.size() == t.x1.size())
    panel.series.push_back(simulated_line("nominal model", before_style(), t, t.simulated_before, frame));
  if (t.simulated_after.size() == t.x1.size())
    panel.series.push_back(simulated_line(with_added(r), after_style(), t, t.simulated_after, frame));
  return panel;
}

/// Bars as a band from zero to the share, and the expected share as a mark.
Panel map_panel(const DiagnosisResult& r, const std::string& title, const std::vector<MapShare>& map) {
  Panel panel{title, {"share of the squared correcting " + torque_word(r), "", {0.0, 1.0}}};
  Series share{"share", {kVermillion, 4.0, {}}}, expected{"if spread evenly", {kGrey, 4.0, {}}};
  share.joined = expected.joined = false;
  share.stems = true;
  share.marker = Marker::kDisc, expected.marker = Marker::kCircle;
  for (std::size_t i = 0; i < map.size(); ++i) {
    panel.y.categories.push_back(typeset(range_words(map[i].bin)));
    panel.y.remarks.push_back(fmt::format("{:.0f} %", 100.0 * map[i].share));
    const double row = static_cast<double>(i);
    share.x.push_back(map[i].share), share.y.push_back(row);
    share.x_intervals.push_back({0.0, map[i].share});
    expected.x.push_back(map[i].expected), expected.y.push_back(row);
  }
  panel.series = {share, expected};
  panel.height = 60.0 + 62.0 * static_cast<double>(map.size());
  return panel;
}

/// Whether the drive was in one place all the time, or errs as much in one as in the other: then the map says
/// nothing.
bool says_nothing(const std::vector<MapShare>& map) {
  constexpr double kAlike = 0.02;  ///< less than the marks of a panel tell apart
  return std::any_of(map.begin(), map.end(), [](const MapShare& m) { return m.expected > 0.999; }) ||
         std::all_of(map.begin(), map.end(),
                     [](const MapShare& m) { return std::abs(m.share - m.expected) < kAlike; });
}

/// Each of its steps is a new start.
std::string error_title(const std::vector<MismatchMeasure>& measures) {
  return "Error of the " + (measures.empty() ? std::string("restarted free run") : measures.front().name);
}

/// "0.99"; no minus before a zero. Of small shares a digit more.
std::string ranked_text(double share, double reach) {
  if (!std::isfinite(share)) return "diverges";
  return tick_label(share, reach < kSmallShares ? 3 : 2);
}

/// The floor of the ranking, which stands though what was added may have refuted a repetition.
const char* ranked_by(const MismatchSize& size) {
  return size.judged_by == JudgedBy::kPrediction ? floor_name(FloorSource::kRepeatability)
                                                 : floor_name(size.floor_from);
}

/// How far the axis of the shares goes: to the floor, or, where the best candidate is far from it, to that.
double ranked_reach(const std::vector<RankedEffect>& ranking, std::size_t shown) {
  double best = 0.0;
  for (std::size_t i = 0; i < shown; ++i)
    if (std::isfinite(ranking[i].rel)) best = std::max(best, ranking[i].rel);
  return best > 0.0 && best < kSmallShares ? best : 1.0;
}

}  // namespace

FigureData diagnosis_traces(const DiagnosisResult& r) {
  FigureData figure{"diagnosis_traces.png", "Recording, model and errors on held-out data"};
  const MismatchTrace* t = shown_trace(r);
  if (t == nullptr) return missing_figure(figure, "the fitted motion diverges");
  figure.panels.push_back(pair_panel(r, *t, error_title(r.diagnosis.measures),
                                     {position_name(r) + " − free run", length_unit(r)}, t->error_before,
                                     t->error_after));
  figure.panels.push_back(correcting_panel(r, *t));
  figure.panels.insert(figure.panels.begin(), recorded_over_simulated(r, *t));
  const MismatchSize& g = r.diagnosis.mismatch;
  figure.reading = fmt::format("On {} the error is {} (median over windows), the floor {}", t->file,
                               quantity(g.before, length_unit(r)), quantity(g.floor, length_unit(r)));
  figure.reading +=
      added(r) ? fmt::format("; {} it is {}.", with_added(r), quantity(g.after, length_unit(r))) : ".";
  return figure;
}

FigureData diagnosis_ranking(const DiagnosisResult& r) {
  FigureData figure{"diagnosis_ranking.png", "Candidates, each refitted alone, by the motion"};
  const auto& ranking = r.diagnosis.ranking;
  if (ranking.empty()) return missing_figure(figure, "the model is at the floor, nothing was looked for");
  Panel panel;
  const std::size_t shown = std::min(kShownCandidates, ranking.size());
  panel.title = "Each alone, free run, first step";
  if (shown < ranking.size()) panel.title += fmt::format(": {} of {}", shown, ranking.size());
  const double reach = ranked_reach(ranking, shown);
  const char* const floor = ranked_by(r.diagnosis.mismatch);
  panel.x = {"share of the way to the " + std::string(floor), "", {-0.25 * reach, 1.3 * reach}};
  Series s{"", {kBlue, 4.0, {}}};
  s.joined = false, s.marker = Marker::kDisc, s.stems = true;
  for (std::size_t i = 0; i < shown; ++i) {
    panel.y.categories.push_back(readable(ranking[i].effect));
    panel.y.remarks.push_back(ranked_text(ranking[i].rel, reach));
    const double rel = std::isfinite(ranking[i].rel) ? std::clamp(ranking[i].rel, -0.25 * reach, 1.1 * reach)
                                                     : -0.25 * reach;
    s.x.push_back(rel), s.y.push_back(static_cast<double>(i));
    s.x_intervals.push_back({std::min(0.0, rel), std::max(0.0, rel)});
  }
  panel.series.push_back(s);
  panel.x_marks.push_back({0.0, guide_style(), ""});
  if (1.3 * reach > 1.0) panel.x_marks.push_back({1.0, guide_style(), floor});
  panel.height = 80.0 + 70.0 * static_cast<double>(s.x.size());
  figure.panels.push_back(panel);
  figure.reading =
      fmt::format("{} comes first of {} candidates", readable(ranking.front().effect), ranking.size());
  if (ranking.size() > 1) figure.reading += fmt::format(", {} second", readable(ranking[1].effect));
  figure.reading += budget_decides(r.diagnosis) ? ", each alone; the error budget decides, for " +
                                                      readable(r.diagnosis.effects.front()) + "."
                                                : ".";
  return figure;
}

FigureData diagnosis_where(const DiagnosisResult& r) {
  FigureData figure{"diagnosis_where.png", "Where the nominal model errs"};
  const MismatchPlace& w = r.diagnosis.where;
  if (w.mode.empty()) return missing_figure(figure, "the fitted motion diverges");
  figure.width = 3200.0;
  figure.columns = 2;
  const std::pair<const char*, const std::vector<MapShare>&> maps[] = {
      {"Mode", w.mode},
      {"Direction of motion", w.direction},
      {"Speed (the observer's estimate)", w.speed},
      {r.coordinates.rotational() ? "Motor angle" : "Displacement", w.angle},
      {r.coordinates.rotational() ? "Torque of the input" : "Force of the input", w.input},
      {"Frequency", w.frequency},
      {"Time", w.time}};
  for (const auto& [title, map] : maps)
    if (!says_nothing(map)) figure.panels.push_back(map_panel(r, title, map));
  if (figure.panels.empty()) return missing_figure(figure, "the error is alike everywhere");
  figure.reading = "The correcting " + torque_word(r) + " " + w.headline + ".";
  return figure;
}

namespace {

/// The first panels of a figure, as many as it has.
void borrow(FigureData& sheet, const std::vector<FigureData>& figures, const std::string& file,
            std::size_t count) {
  for (const FigureData& figure : figures)
    if (figure.file == file && figure.missing.empty())
      for (std::size_t i = 0; i < std::min(count, figure.panels.size()); ++i)
        sheet.panels.push_back(figure.panels[i]);
}

FigureData sheet(const DiagnosisResult& r, const std::vector<FigureData>& figures) {
  FigureData sheet{"diagnosis.png", literal(r.name) + ": what the simulation lacks"};
  sheet.lines.push_back(literal(r.diagnosis.sentence));
  if (const auto& traces = r.diagnosis.traces; traces.size() > 1)
    sheet.lines.push_back(fmt::format("Drawn over time: {}, the first of {} held-out recordings.",
                                      literal(traces.front().file), traces.size()));
  sheet.width = 3200.0, sheet.scale = kSheetScale;
  sheet.columns = 2;
  borrow(sheet, figures, "diagnosis_budget.png", 1);
  borrow(sheet, figures, "diagnosis_traces.png", 3);
  if (budget_decides(r.diagnosis))  // what each does alone to the free run did not
    sheet.panels.push_back(budget_shares(r));
  else
    borrow(sheet, figures, "diagnosis_ranking.png", 1);
  borrow(sheet, figures, r.diagnosis.laws.empty() ? "diagnosis_torque_map.png" : "diagnosis_law.png", 1);
  borrow(sheet, figures, "diagnosis_where.png", sheet.panels.size() % 2 == 0 ? 2 : 1);
  for (std::size_t i = 0; i + 1 < sheet.panels.size(); i += 2)  // neighbours are equally high
    sheet.panels[i].height = sheet.panels[i + 1].height =
        std::max(sheet.panels[i].height, sheet.panels[i + 1].height);
  sheet.reading = r.diagnosis.sentence;
  if (sheet.lines.size() > 1) sheet.reading += " " + plain_text(sheet.lines.back());
  if (sheet.panels.empty()) return missing_figure(sheet, "there is nothing to draw");
  return sheet;
}

}  // namespace

std::vector<FigureData> diagnosis_figures(const DiagnosisResult& r) {
  std::vector<FigureData> figures = {diagnosis_budget(r),     diagnosis_traces(r),     diagnosis_ranking(r),
                                     diagnosis_where(r),      diagnosis_torque_map(r), diagnosis_law(r),
                                     diagnosis_detectable(r), diagnosis_simulator(r)};
  figures.insert(figures.begin(), sheet(r, figures));
  return figures;
}

}  // namespace gapscope::internal::report
