#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "gapscope/inspection/inspection.h"
#include "inspection/rules.h"

namespace gapscope {
namespace {

constexpr double kOtherStep = 1.5;  ///< times as large or as small: no more the step that is declared

/// What a file makes of whole counts that should not have had a decimal mark.
void doubt_counts(double times, const std::string& step, Finding& f) {
  f.severity = Severity::kSpoils;
  f.found = fmt::format("x1 steps by 1/{} of a count ({}): counts are whole numbers",
                        internal::inspection::figure(times), step);
  f.advice =
      "write whole counts: thousands that are grouped (99,556) are read as decimals; positions that were "
      "computed, averaged or interpolated have another unit, or are to be recorded raw";
}

}  // namespace

void judge_for_encoder(double quantum, bool counts, Inspection& inspection) {
  const double seen = inspection.facts.quantum;
  if (!(quantum > 0.0) || !(seen > 0.0)) return;
  const auto length = [&](double x) {
    return Remark("length", "{:.4g} [rad]", {x}).text(inspection.coordinates);
  };
  for (Finding& f : inspection.findings) {
    if (f.rule != kEncoderRule) continue;
    if (counts && kOtherStep * seen < quantum) return doubt_counts(quantum / seen, length(seen), f);
    if (f.severity != Severity::kFine || std::max(seen / quantum, quantum / seen) < kOtherStep) return;
    f.severity = Severity::kNote;
    f.found = fmt::format("x1 steps by {} where encoder: says {}", length(seen), length(quantum));
    f.advice =
        "give the step that the recording has, encoder: {bits: ...} or {quantum: ...}, or find out who rounds, "
        "filters or scales x1 on its way";
  }
}

}  // namespace gapscope
