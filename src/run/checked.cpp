#include "run/checked.h"

#include <fmt/format.h>

namespace gapscope::internal::run {
namespace {

bool is_told(const Finding& f, Purpose purpose) {
  if (f.rule == kReversalsRule || (f.rule == kTimeRule && purpose != Purpose::kDiagnosis)) return false;
  return f.severity == Severity::kSpoils || (f.warned && purpose == Purpose::kDiagnosis);
}

}  // namespace

Checked check_files(const Configuration& c, const std::vector<RecordedFile>& files, Purpose purpose) {
  Checked checked;
  for (const RecordedFile& file : files) {
    Inspection seen = inspect(file.path, c.recording->reading_of(file, UnevenRows::kStamped), c.coordinates);
    judge_for_unit(c.input_facts().unit, seen);
    if (purpose == Purpose::kGap) judge_for(purpose, seen);
    for (const Finding& f : seen.findings) {
      if (!is_told(f, purpose)) continue;
      checked.warnings.push_back(fmt::format("{}: {}: {} -> {}", file.given, f.rule, f.found, f.advice));
      if (f.rule == kPositionUnitRule && checked.doubt.empty())
        checked.doubt = f.found, checked.remedy = f.advice;
    }
  }
  return checked;
}

}  // namespace gapscope::internal::run
