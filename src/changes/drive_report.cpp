#include "changes/drive_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "changes/loops.h"
#include "gapscope/base/statistics.h"
#include "results/diagnosis_result.h"
#include "results/file_list.h"
#include "results/run_result.h"

namespace gapscope {
namespace {

constexpr double kHysteresis = 0.3;  ///< of the amplitude of u, against noise at the crossings

/// Half the rate at which u crosses the middle of its range [Hz].
double crossing_frequency(const Recording& r) {
  const auto [low, high] = std::minmax_element(r.u.begin(), r.u.end());
  const double middle = 0.5 * (*low + *high), level = kHysteresis * 0.5 * (*high - *low);
  if (!(level > 0.0)) return 0.0;
  int side = 0, crossings = 0;
  for (const double u : r.u) {
    if (std::abs(u - middle) < level) continue;
    const int now = u > middle ? 1 : -1;
    crossings += side == -now;
    side = now;
  }
  return 0.5 * crossings / r.duration();
}

ExcitationFacts excited(const Recording& r) {
  constexpr double kPeak = 0.99;  // of all samples: of noise alone the largest is another in each recording
  ExcitationFacts e;
  e.file = r.file;
  e.samples = static_cast<int>(r.size());
  e.rate = 1.0 / r.dt;
  e.quantum = r.quantum;
  e.position_rms = rms(r.position());
  if (r.u.empty()) return e;
  e.input_rms = rms(r.u);
  std::vector<double> sizes;
  for (const double u : r.u) sizes.push_back(std::abs(u));
  e.input_peak = quantile(std::move(sizes), kPeak);
  e.input_frequency = crossing_frequency(r);
  return e;
}

void doubt_outside(const std::string& name, double value, const Interval& ci95, DriveReport& report) {
  const double slack = 1e-9 * std::abs(value);  // of decimals
  if (value < ci95.low - slack || value > ci95.high + slack)
    report.doubts.push_back(fmt::format(
        "{} is {:.6g} in result.json, outside its own interval of {:.6g} to {:.6g}: no estimate says that, "
        "the file was changed",
        name, value, ci95.low, ci95.high));
}

/// What only a file that was changed since can say.
void add_doubts(const std::string& folder, DriveReport& report) {
  constexpr const char* kResult = "result.json";
  const auto list = internal::results::read_file_list(folder);
  if (list && !list->wrote(folder, kResult))
    report.doubts.emplace_back(
        "result.json was changed since gapscope wrote it (files.json has its SHA-256)");
  if (report.model_free) {
    doubt_outside("the gap", report.model_free->gap, report.model_free->ci95, report);
    const LostMotion& m = report.model_free->lost_motion;
    doubt_outside("the lost motion", m.value, m.ci95, report);
  }
  if (!report.reference) return;
  for (const FittedParameter& p : report.reference->parameters)
    doubt_outside(p.key, p.value, report.reference->shown_interval(p), report);
}

void take_estimate(const std::string& folder, DriveReport& report) {
  RunResult run = read_run_result(folder);
  report.name = run.name, report.version = run.version;
  report.configuration = std::move(run.configuration);
  report.coordinates = run.coordinates;
  report.answer = std::move(run.answer), report.input = std::move(run.input);
  report.model_free = std::move(run.model_free);
  report.reference = std::move(run.reference);
  for (const Recording& r : run.recordings) report.recordings.push_back(excited(r));
  if (report.model_free) {
    report.loops = internal::changes::loop_facts(report.model_free->lost_motion, run.recordings);
    report.model_free->traces.clear();
  }
  if (report.reference) report.reference->traces.clear();
  add_doubts(folder, report);
}

/// @param alone  there is no estimate in the folder
void take_diagnosis(const std::string& folder, bool alone, DriveReport& report) {
  DiagnosisResult diagnosed = read_diagnosis_result(folder);
  if (alone) {
    report.name = diagnosed.name, report.version = diagnosed.version;
    report.configuration = std::move(diagnosed.configuration);
    report.coordinates = diagnosed.coordinates, report.input = std::move(diagnosed.input);
  }
  if (diagnosed.answer) report.answer = std::move(diagnosed.answer);
  report.diagnosis = std::move(diagnosed.diagnosis);
}

}  // namespace

DriveReport read_drive_report(const std::string& folder) {
  const bool diagnosed = std::filesystem::exists(folder + "/diagnosis.json");
  const bool estimated = std::filesystem::exists(folder + "/result.json");
  DriveReport report;
  report.folder = folder;
  if (estimated || !diagnosed) take_estimate(folder, report);
  if (diagnosed) take_diagnosis(folder, !estimated, report);
  return report;
}

}  // namespace gapscope
