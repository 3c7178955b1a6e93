#include <cmath>

#include "report/figures.h"
#include "report/rich_text.h"
#include "report/wording.h"

namespace gapscope::internal {
namespace {

/// A panel of another figure under a title of its own.
void borrow(FigureData& sheet, const std::vector<FigureData>& figures, const std::string& file,
            std::size_t index, const std::string& title, double height) {
  for (const FigureData& figure : figures) {
    if (figure.file != file || !figure.missing.empty() || index >= figure.panels.size()) continue;
    Panel panel = figure.panels[index];
    panel.title = title;
    panel.height = height;
    panel.x_labels = true;
    sheet.panels.push_back(panel);
  }
}

}  // namespace

FigureData overview(const ReportView& view, const std::vector<FigureData>& figures) {
  FigureData sheet;
  sheet.file = "overview.png";
  sheet.title = literal(view.run.name) + ": overview";
  sheet.width = 3200.0;
  sheet.columns = 2;
  sheet.lines.push_back(literal(headline(view.run)));
  if (const std::string line = fit_quality(view.run); !line.empty()) sheet.lines.push_back(line);
  borrow(sheet, figures, "fig2_input_and_displacement.png", 0, "Input", 420.0);
  borrow(sheet, figures, "fig5_displacement_and_error.png", 0, "Displacement and estimation error", 420.0);
  if (sheet.panels.size() < 2)
    borrow(sheet, figures, "fig2_input_and_displacement.png", 1, "Displacement", 420.0);
  borrow(sheet, figures, "fig6_one_period.png", 0, "One passage of the gap", 480.0);
  borrow(sheet, figures, "fig6_one_period.png", 1, "Its estimation error", 480.0);
  borrow(sheet, figures, "lost_motion_loop.png", 0, "Displacement against input", 480.0);
  borrow(sheet, figures, "estimates.png", 0, "Estimates with 95 % intervals", 400.0);
  borrow(sheet, figures, "estimates.png", 1, "Passage by passage", 400.0);
  borrow(sheet, figures, "fig3_backlash_map.png", 1, "Backlash map", 420.0);
  borrow(sheet, figures, "residuals.png", 0, "Recorded minus fitted displacement", 420.0);
  if (sheet.panels.empty()) return missing_figure(sheet.file, sheet.title, "there is nothing to draw");
  sheet.reading = accuracy(view.run) + (accuracy(view.run).empty() ? "" : " ") + fit_quality(view.run);
  if (sheet.reading.empty()) sheet.reading = "The true gap is not known here.";
  return sheet;
}

std::vector<FigureData> all_figures(const ReportView& view) {
  std::vector<FigureData> figures = {fig2_input_and_displacement(view),
                                     fig3_backlash_map(view),
                                     fig4_backlash_state_and_input(view),
                                     fig5_displacement_and_error(view),
                                     fig6_one_period(view),
                                     lost_motion_loop(view),
                                     estimates(view),
                                     residuals(view)};
  figures.insert(figures.begin(), overview(view, figures));
  return figures;
}

}  // namespace gapscope::internal
