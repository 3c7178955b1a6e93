#include "report/report.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include "report/diagnosis_figures.h"
#include "report/figures.h"
#include "report/report_files.h"
#include "report/report_view.h"
#include "report/story.h"
#include "results/diagnosis_result.h"
#include "results/run_result.h"

namespace gapscope {
namespace {

void append(std::vector<internal::report::FigureData>& all,
            std::vector<internal::report::FigureData>&& more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

}  // namespace

void write_report(const std::string& folder, const std::string& note, const FigureFormats& formats) {
  const auto stored = [&](const char* name) {
    return std::filesystem::exists(std::filesystem::path(folder) / name);
  };
  std::optional<RunResult> run;
  std::optional<DiagnosisResult> diagnosis;
  internal::report::DriveStory story{nullptr, nullptr, read_timing(folder), note, {}};
  if (stored("result.json") || !stored("diagnosis.json")) {
    story.run = &run.emplace(read_run_result(folder));
    append(story.figures, internal::report::all_figures(internal::report::ReportView(*run)));
  }
  if (stored("diagnosis.json")) {
    story.diagnosis = &diagnosis.emplace(read_diagnosis_result(folder));
    append(story.figures, internal::report::diagnosis_figures(*diagnosis));
  }
  const std::string text = internal::report::story_text(story);
  internal::report::write_report_files(folder, story.figures, text, formats,
                                       internal::report::head_of(story));
}

}  // namespace gapscope
