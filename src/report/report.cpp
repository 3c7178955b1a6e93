#include "gapscope/report/report.h"

#include <filesystem>

#include "gapscope/results/diagnosis_result.h"
#include "gapscope/results/run_result.h"
#include "report/diagnosis_figures.h"
#include "report/figures.h"
#include "report/glossary.h"
#include "report/markdown.h"
#include "report/report_files.h"

namespace gapscope {
namespace {

void append(std::vector<internal::report::FigureData>& all,
            const std::vector<internal::report::FigureData>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::string report_run(const std::string& folder, std::vector<internal::report::FigureData>& all) {
  const RunResult run = read_run_result(folder);
  const internal::report::ReportView view(run);
  const std::vector<internal::report::FigureData> figures = internal::report::all_figures(view);
  append(all, figures);
  return internal::report::report_text(run, read_timing(folder), figures);
}

std::string report_diagnosis(const std::string& folder, std::vector<internal::report::FigureData>& all) {
  const DiagnosisResult result = read_diagnosis_result(folder);
  const std::vector<internal::report::FigureData> figures = internal::report::diagnosis_figures(result);
  append(all, figures);
  return internal::report::diagnosis_text(result, figures);
}

/// Below the title.
std::string with_note(const std::string& text, const std::string& note) {
  const std::size_t title = text.find("\n\n");
  if (note.empty() || title == text.npos) return text;
  return text.substr(0, title) + "\n\n> " + note + text.substr(title);
}

}  // namespace

void write_report(const std::string& folder, const std::string& note) {
  const auto stored = [&](const char* name) {
    return std::filesystem::exists(std::filesystem::path(folder) / name);
  };
  std::vector<internal::report::FigureData> figures;
  std::string text;
  if (stored("result.json") || !stored("diagnosis.json")) text = report_run(folder, figures);
  if (stored("diagnosis.json")) text += (text.empty() ? "" : "\n") + report_diagnosis(folder, figures);
  internal::report::write_report_files(folder, figures,
                                       with_note(text, note) + internal::report::glossary_section(text));
}

}  // namespace gapscope
