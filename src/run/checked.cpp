#include "run/checked.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace gapscope::internal::run {
namespace {

bool is_told(const Finding& f, Purpose purpose) {
  if (f.rule == kReversalsRule || (f.rule == kTimeRule && purpose != Purpose::kDiagnosis)) return false;
  return f.severity == Severity::kSpoils || (f.warned && purpose == Purpose::kDiagnosis);
}

/// What spoils the answer to a question. Of reversals the detector knows more itself.
std::vector<Doubt> doubts_for(Purpose purpose, Inspection seen) {
  judge_for(purpose, seen);
  std::vector<Doubt> doubts;
  for (const Finding& f : seen.findings) {
    if (f.severity != Severity::kSpoils || f.rule == kReversalsRule) continue;
    Doubt doubt{f.rule, f.found, f.advice};
    std::replace(doubt.code.begin(), doubt.code.end(), ' ', '_');
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

void append(std::vector<Doubt> more, std::vector<Doubt>& all) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

}  // namespace

Checked check_files(const Configuration& c, const std::vector<RecordedFile>& files, Purpose purpose) {
  Checked checked;
  for (const RecordedFile& file : files) {
    Inspection seen = inspect(file.path, c.recording->reading_of(file, UnevenRows::kStamped), c.coordinates);
    judge_for_unit(c.input_facts().unit, seen);
    judge_for_encoder(c.position_quantum(), c.recording->units.position == "counts", seen);
    Inspection told = seen;
    if (purpose == Purpose::kGap) judge_for(purpose, told);
    for (const Finding& f : told.findings) {
      if (!is_told(f, purpose)) continue;
      checked.warnings.push_back(fmt::format("{}: {}: {} -> {}", file.given, f.rule, f.found, f.advice));
    }
    append(doubts_for(Purpose::kGap, seen), checked.of_reading);
    append(doubts_for(Purpose::kFit, seen), checked.of_fit);
  }
  return checked;
}

}  // namespace gapscope::internal::run
