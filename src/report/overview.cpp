#include <fmt/format.h>

#include <array>

#include "base/parallel.h"
#include "report/figures.h"
#include "report/rich_text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// A panel of another figure, under a title of its own where one is given.
void borrow(FigureData& sheet, const std::vector<FigureData>& figures, const std::string& file,
            std::size_t index, double height, const std::string& title = "") {
  for (const FigureData& figure : figures) {
    if (figure.file != file || !figure.missing.empty() || index >= figure.panels.size()) continue;
    Panel& panel = sheet.panels.emplace_back(figure.panels[index]);
    if (!title.empty()) panel.title = title;
    panel.height = height;
    panel.x_labels = true;
  }
}

std::string title_of(const std::vector<FigureData>& figures, const std::string& file) {
  for (const FigureData& figure : figures)
    if (figure.file == file) return figure.title;
  return "";
}

/// Which of several recordings the figures over time show.
std::string drawn_recording(const ReportView& view) {
  if (view.recording == nullptr || view.run.recordings.size() < 2) return "";
  return fmt::format("Drawn over time: {}, one of {} recordings.", view.recording->file,
                     view.run.recordings.size());
}

/// Passages that were all set aside without a verdict look like estimates, and are none.
bool has_something_to_compare(const ReportView& view) {
  const bool denied = view.run.model_free && view.run.model_free->verdict == GapVerdict::kNone;
  return denied || parameter(view.run, "gap") != nullptr || !view.accepted().empty();
}

/// What the card says of the gap, without the asides that a heading has no room for.
std::string first_line(const RunResult& run) {
  const bool card = run.answer && !run.answer->card.brief.gap.empty();
  return card ? run.answer->card.brief.gap : headline(run);
}

}  // namespace

FigureData overview(const ReportView& view, const std::vector<FigureData>& figures) {
  FigureData sheet{"overview.png", literal(view.run.name) + ": overview"};
  sheet.width = 3200.0, sheet.scale = kSheetScale;
  sheet.columns = 2;
  sheet.lines.push_back(literal(first_line(view.run)));
  if (const std::string line = fit_quality(view.run); !line.empty()) sheet.lines.push_back(line);
  const std::string drawn = drawn_recording(view);
  if (!drawn.empty()) sheet.lines.push_back(literal(drawn));
  borrow(sheet, figures, "fig2_input_and_displacement.png", 0, 420.0);
  borrow(sheet, figures, "fig5_displacement_and_error.png", 0, 420.0);
  if (sheet.panels.size() < 2) borrow(sheet, figures, "fig2_input_and_displacement.png", 1, 420.0);
  borrow(sheet, figures, "fig6_one_period.png", 0, 480.0, title_of(figures, "fig6_one_period.png"));
  borrow(sheet, figures, "fig6_one_period.png", 1, 480.0, view.error_title("Its estimation error"));
  if (sheet.panels.size() < 3) borrow(sheet, figures, "fig5_displacement_and_error.png", 1, 420.0);
  borrow(sheet, figures, "lost_motion_loop.png", 0, 480.0, "Displacement against input");
  borrow(sheet, figures, "reversal_shelf.png", 0, 480.0, "Input behind the reversals");
  if (has_something_to_compare(view))
    for (const std::size_t i : {0u, 1u}) borrow(sheet, figures, "estimates.png", i, 400.0);
  borrow(sheet, figures, "fig3_backlash_map.png", 1, 420.0, "Backlash map");
  borrow(sheet, figures, "residuals.png", 0, 420.0);
  if (sheet.panels.empty()) return missing_figure(sheet, "there is nothing to draw");
  sheet.reading = accuracy(view.run) + (accuracy(view.run).empty() ? "" : " ") + fit_quality(view.run);
  if (sheet.reading.empty()) sheet.reading = without_estimate(view.run);
  if (!drawn.empty()) sheet.reading += " " + drawn;
  return sheet;
}

std::vector<FigureData> all_figures(const ReportView& view) {
  constexpr std::array kFigures = {fig2_input_and_displacement,
                                   fig3_backlash_map,
                                   fig4_backlash_state_and_input,
                                   fig5_displacement_and_error,
                                   fig6_one_period,
                                   bound_time_map,
                                   lost_motion_loop,
                                   reversal_shelf,
                                   estimates,
                                   residuals,
                                   fit_starts};
  std::vector<FigureData> figures(kFigures.size());
  parallel_for(figures.size(), 0, [&](std::size_t i) { figures[i] = kFigures[i](view); });
  figures.insert(figures.begin(), overview(view, figures));
  return figures;
}

}  // namespace gapscope::internal::report
