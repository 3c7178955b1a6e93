// What a finding means for one question alone.
#include <algorithm>
#include <string_view>

#include "gapscope/inspection/inspection.h"

namespace gapscope {
namespace {

/// The detector reads the position alone where impacts show; u is needed for the loop of an output that
/// stands.
constexpr std::string_view kOfTheInput[] = {"input",      "clipping", "spectrum", "sign",
                                            "scale of u", "feedback", "diagnosis"};

/// Rows that are missing, this share of all, leave fit and diagnosis their numbers (docs/science.md).
constexpr double kFewMissing = 0.02;

bool is_of_the_input(const Finding& f) {
  return std::find(std::begin(kOfTheInput), std::end(kOfTheInput), f.rule) != std::end(kOfTheInput);
}

bool are_few_missing_rows(const Finding& f, const RecordingFacts& facts) {
  return f.rule == kTimeRule && facts.skipped_rows == 0 && !facts.coarse_clock && facts.missing_samples > 0 &&
         facts.missing_samples <= kFewMissing * facts.samples;
}

/// Why it does not spoil the answer to this question; empty where it does.
std::string harmless(const Finding& f, Purpose purpose, const RecordingFacts& facts) {
  if (purpose == Purpose::kGap)
    return is_of_the_input(f)
               ? "for a gap read from impacts x1 is enough; only the loop of a locked output needs u"
               : "";
  if (f.rule == kReversalsRule) return "of the detector alone";
  if (are_few_missing_rows(f, facts)) return "so few are held over";
  return "";
}

/// What is asked of the motion's reversals does not matter here.
void need_no_period(Inspection& inspection, const char* found, const char* advice) {
  for (Finding& f : inspection.findings)
    if (f.rule == kReversalsRule && f.severity == Severity::kSpoils)
      f.severity = Severity::kNote, f.found = found, f.advice = advice;
}

}  // namespace

const char* to_string(Purpose purpose) {
  constexpr const char* kNames[] = {"all", "gap", "fit", "diagnosis"};
  return kNames[static_cast<int>(purpose)];
}

void judge_for_load_encoder(Inspection& inspection) {
  need_no_period(
      inspection,
      "of the detector alone, which reads impacts off the motor's position: on the load none shows",
      "no other motion mends that: `gapscope fit` and `diagnose` take this side; for a reading "
      "without a model record the motor's position as well");
}

void judge_for_locked_output(Inspection& inspection) {
  need_no_period(inspection, "of impacts alone: the loop of a locked output needs no period", "");
}

void judge_for(Purpose purpose, Inspection& inspection) {
  inspection.purpose = purpose;
  if (purpose == Purpose::kAll) return;
  for (Finding& f : inspection.findings) {
    if (f.severity != Severity::kSpoils) continue;
    const std::string why = harmless(f, purpose, inspection.facts);
    if (why.empty()) continue;
    f.severity = Severity::kNote;
    f.found += "; " + why;
  }
}

}  // namespace gapscope
