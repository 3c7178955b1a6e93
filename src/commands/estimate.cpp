#include "commands/estimate.h"

#include <filesystem>

#include "report/report.h"
#include "results/drive_card.h"

namespace gapscope {

RunOutcome make_estimate(const Configuration& c, const Estimators& wanted, const Progress& progress) {
  const std::vector<FileHash> sources = sources_of(c);
  RunOutcome outcome = run_pipeline(c, wanted, progress, 0);
  require_unchanged(c, sources);
  outcome.result.sources = sources;
  return outcome;
}

std::vector<TextFile> estimate_texts(const Configuration& c, const RunResult& result) {
  std::vector<TextFile> texts = {{"resolved.yaml", result.configuration}};
  if (!result.reference || result.reference->initial_states.empty()) return texts;
  const Recording& first = result.recordings.front();
  texts.push_back(
      {"fitted.yaml", fit_yaml(c, *result.reference, trace_name(0, first.file), first.motor_trace())});
  return texts;
}

void write_estimate(ReportFolder& report, const Configuration& c, const FigureFormats& figures,
                    RunOutcome& outcome) {
  report.keep_diagnosis(outcome.result.version, outcome.result.sources);
  if (!report.dropped().empty()) outcome.warnings.push_back(report.dropped());
  add_card(report.path(), outcome.result);
  std::vector<TextFile> texts = estimate_texts(c, outcome.result);
  // A diagnosis in the folder has left its own, which holds what the model lacked.
  if (std::filesystem::exists(report.path() + "/fitted.yaml"))
    std::erase_if(texts, [](const TextFile& t) { return t.name == "fitted.yaml"; });
  write_texts(report.path(), texts);
  outcome.result = write_run_result(report.path(), std::move(outcome.result));
  write_timing(report.path(), outcome.timing);
  write_report(report.path(), report.dropped(), figures);
  report.commit();
}

}  // namespace gapscope
