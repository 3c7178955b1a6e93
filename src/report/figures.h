#pragma once

#include <vector>

#include "report/figure_data.h"
#include "report/report_view.h"

/// One function a figure, each in a file of its name: the data of the figure and a line of reading, or why
/// this result has no such figure. Figures 2 to 6 are those of the source paper, for this recording.
namespace gapscope::internal::report {

FigureData fig2_input_and_displacement(const ReportView& view);
FigureData fig3_backlash_map(const ReportView& view);
FigureData fig4_backlash_state_and_input(const ReportView& view);
FigureData fig5_displacement_and_error(const ReportView& view);
FigureData fig6_one_period(const ReportView& view);
FigureData bound_time_map(const ReportView& view);
FigureData lost_motion_loop(const ReportView& view);
FigureData reversal_shelf(const ReportView& view);
FigureData estimates(const ReportView& view);
FigureData residuals(const ReportView& view);
FigureData fit_starts(const ReportView& view);

/// One sheet: the findings in words, and the main panels of the other figures.
FigureData overview(const ReportView& view, const std::vector<FigureData>& figures);

/// All of them in the order of the report, the overview first.
std::vector<FigureData> all_figures(const ReportView& view);

}  // namespace gapscope::internal::report
