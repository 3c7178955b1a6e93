#include "run/read_gap.h"

#include <algorithm>
#include <cmath>

#include "gapscope/sliding_mode/detector.h"

namespace gapscope::internal::run {

std::optional<double> read_gap(const Configuration& c, const DiagnosisRecordings& recordings) {
  const DriveStructure& drive = c.model.structure;
  const ParameterSetting& gap = c.model.parameters[place::kGap];
  if (!gap.estimate || std::isfinite(gap.value)) return {};
  if (!drive.has_load || drive.load != LoadKind::kFree || drive.reads_load()) return {};
  for (const LoadedRecordings* part : {&recordings.train, &recordings.held_out}) {
    const std::vector<MotorTrace> traces = part->motor_traces();
    const bool even = std::all_of(traces.begin(), traces.end(), [](const auto& t) { return t.even(); });
    if (traces.empty() || !even) continue;
    if (const GapEstimate read = detect_gap(traces); read.verdict == GapVerdict::kBacklash) return read.gap;
  }
  return {};
}

}  // namespace gapscope::internal::run
