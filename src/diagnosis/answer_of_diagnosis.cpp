#include <fmt/format.h>

#include <cmath>

#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "gapscope/diagnosis/answer.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {
namespace {

using internal::diagnosis::kRule;
using internal::diagnosis::SharedUnit;

AnswerTrust trust_in(const Diagnosis& d) {
  const double remains = d.mismatch.after / d.mismatch.floor;
  if (d.verdict == DiagnosisVerdict::kNone || remains < kRule.floor_ratio) return AnswerTrust::kGood;
  return remains < kRule.far ? AnswerTrust::kLimited : AnswerTrust::kNone;
}

}  // namespace

std::optional<Answer> answer_of_diagnosis(const Diagnosis& d, Coordinates coordinates) {
  if (!d.model_gap || d.model_gap->origin != GapOrigin::kEstimated) return {};
  const ModelGap& gap = *d.model_gap;
  const AnswerTrust trust = trust_in(d);
  if (trust == AnswerTrust::kNone || !(gap.ci95.low > 0.0)) return {};
  Answer a{gap.value, gap.ci95, AnswerSource::kDiagnosis, trust, "", {}};
  a.sentence = fmt::format(
      "{}{} by the model that the diagnosis has fitted.", internal::diagnosis::the_gap_is(),
      SharedUnit(gap.value, coordinates.position_unit()).with_interval_aside(gap.value, gap.ci95));
  return a;
}

}  // namespace gapscope
