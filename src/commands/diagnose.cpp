#include "commands/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/interrupt.h"
#include "config/begun_model.h"
#include "diagnosis/begin.h"
#include "gapscope/base/errors.h"
#include "report/report.h"
#include "results/drive_card.h"

namespace gapscope {
namespace {

/// Under the input of what was held out, which stands in the report; a motion that diverges has left no
/// trace there.
std::string fitted_model(const Configuration& c, const Diagnosis& d, const ReferenceModel& fitted,
                         const MotorTrace& recording, const std::optional<DriveController>& controller) {
  if (d.traces.empty()) return model_yaml(c, fitted, "", recording);
  const MismatchTrace& t = d.traces.front();
  MotorTrace held_out{t.file, t.start, t.dt, t.u, t.x1, recording.quantum, t.stamps};
  const DriveState<double> begin = begin_of(fitted, held_out, d.observer_hz);
  CommandRows rows;
  rows.target = t.target, rows.supply = t.supply;
  if (c.recording && !c.recording->held_out.empty()) {
    rows.gain_times = c.recording->held_out.front().gain_times;
    held_out.load = c.recording->held_out.front().load;
  }
  if (!t.target.empty()) held_out.command = &rows;
  return model_yaml(c, fitted, held_out_trace_name(0, t.file), held_out, begin, controller);
}

}  // namespace

void exclude_effects(const std::vector<std::string>& effects, Configuration& c) {
  for (const std::string& name : effects)
    if (find_effect(name) == nullptr)
      throw ConfigError(
          fmt::format("gapscope: --exclude is '{}', expected an effect that `gapscope effects` lists", name));
  c.excluded.insert(c.excluded.end(), effects.begin(), effects.end());
  std::sort(c.excluded.begin(), c.excluded.end());  // the same question, however it is asked
  c.excluded.erase(std::unique(c.excluded.begin(), c.excluded.end()), c.excluded.end());
}

void take_simulated(const std::vector<std::string>& files, Configuration& c) {
  if (files.empty()) return;
  if (!c.recording)
    throw ConfigError(c.file,
                      "has no recording: beside --simulated, expected that of the drive that is simulated");
  c.recording->simulated.clear();
  for (const std::string& file : files)  // the paths are the shell's, not the configuration's
    c.recording->simulated.push_back({file, std::filesystem::absolute(file).lexically_normal().string(), 0});
  if (const std::string problem = c.recording->simulated_problem(); !problem.empty())
    throw ConfigError("gapscope: --simulated " + problem);
}

std::vector<TextFile> diagnosis_texts(const Configuration& c, const DiagnosisResult& result,
                                      const MotorTrace& fitted) {
  const Diagnosis& d = result.diagnosis;
  std::vector<TextFile> texts = {
      {"resolved.yaml", result.configuration},
      {"fitted.yaml", d.loop ? fitted_model(c, d, d.loop->model, fitted, d.loop->controller)
                             : fitted_model(c, d, d.fitted, fitted, d.controller)}};
  for (const LastResortLaw& law : d.laws) {
    texts.push_back({compensation_name(law), compensation_csv(law)});
    texts.push_back({"fitted_with_law.yaml", fitted_model(c, d, law.fitted, fitted, d.controller)});
  }
  if (const NextExperiment& next = d.next_experiment; next.proposes()) {
    texts.push_back({"next_experiment.yaml", experiment_yaml(c, d.rivals.front().model, next)});
    texts.push_back({"next_experiment.csv", input_csv(next)});
  }
  return texts;
}

void write_diagnosis(ReportFolder& report, const Configuration& c, const FigureFormats& figures,
                     DiagnosisOutcome& outcome, const std::vector<TextFile>& more) {
  DiagnosisResult& result = outcome.result;
  report.keep_estimate(result.version, result.sources);
  add_card(report.path(), result);
  write_diagnosis_result(report.path(), result);
  write_texts(report.path(), diagnosis_texts(c, result, outcome.first.motor_trace()));
  write_texts(report.path(), more);
  write_report(report.path(), report.dropped(), figures);
  stop_point();
  report.commit();
  if (!report.dropped().empty()) result.diagnosis.warnings.push_back(report.dropped());
}

}  // namespace gapscope
