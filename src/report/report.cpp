#include "gapscope/report/report.h"

#include "gapscope/results/run_result.h"
#include "report/figures.h"
#include "report/markdown.h"
#include "report/report_files.h"

namespace gapscope {

void write_report(const std::string& folder) {
  const RunResult run = read_run_result(folder);
  const internal::ReportView view(run);
  const std::vector<internal::FigureData> figures = internal::all_figures(view);
  internal::write_report_files(folder, figures, internal::report_text(run, read_timing(folder), figures));
}

}  // namespace gapscope
