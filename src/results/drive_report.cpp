#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gapscope/base/errors.h"
#include "gapscope/results/drive_changes.h"
#include "gapscope/results/run_result.h"

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
  ExcitationFacts e;
  e.file = r.file;
  e.samples = static_cast<int>(r.size());
  e.rate = 1.0 / r.dt;
  e.quantum = r.quantum;
  e.position_rms = rms(r.position());
  if (r.u.empty()) return e;
  e.input_rms = rms(r.u);
  for (const double u : r.u) e.input_peak = std::fmax(e.input_peak, std::abs(u));
  e.input_frequency = crossing_frequency(r);
  return e;
}

}  // namespace

DriveReport read_drive_report(const std::string& folder) {
  namespace fs = std::filesystem;
  if (!fs::exists(folder + "/result.json") && fs::exists(folder + "/diagnosis.json"))
    throw ConfigError(folder, "holds a diagnosis alone, expected a result of run, detect or fit to compare");
  RunResult run = read_run_result(folder);
  DriveReport report;
  report.folder = folder;
  report.name = run.name;
  report.version = run.version;
  report.configuration = std::move(run.configuration);
  report.coordinates = run.coordinates;
  report.model_free = std::move(run.model_free);
  if (report.model_free) report.model_free->traces.clear();
  report.reference = std::move(run.reference);
  if (report.reference) report.reference->traces.clear();
  for (const Recording& r : run.recordings) report.recordings.push_back(excited(r));
  return report;
}

}  // namespace gapscope
