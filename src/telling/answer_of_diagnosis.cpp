#include <algorithm>
#include <cmath>

#include "diagnosis/rule.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "telling/answer.h"
#include "telling/gap_of_effect.h"

namespace gapscope {
namespace {

using internal::diagnosis::kRule;

/// Whether the model leaves less of the motion than matters to its gap, however far above the encoder's
/// noise: less than its interval is wide, or a hundredth of it. Of the 41 drives of `study_diagnosis 7530001
/// 33 unstarted FILE` and `7530035 8` four that are told by the latter are 0.0 to 0.5 % off, and one whose
/// gap grows is 4.2; with half of it one less is told, with double two more, 2.0 and 4.5 % off. A prediction,
/// which an observer leads, does not say, nor does a search that was stopped: it may be anywhere.
bool leaves_little(const Diagnosis& d) {
  if (!d.model_gap || d.stopped || internal::telling::divides_one_body(d)) return false;
  if (d.mismatch.judged_by == JudgedBy::kPrediction) return false;
  const double half_width = 0.5 * (d.model_gap->ci95.high - d.model_gap->ci95.low);
  return d.mismatch.after < std::max(kRule.little_of_gap * d.model_gap->value, half_width);
}

AnswerTrust trust_in(const Diagnosis& d) {
  const double remains = d.mismatch.after / d.mismatch.floor;
  if (d.verdict == DiagnosisVerdict::kNone || remains < kRule.floor_ratio) return AnswerTrust::kGood;
  return remains < kRule.far || leaves_little(d) ? AnswerTrust::kLimited : AnswerTrust::kNone;
}

/// What the diagnosis has fitted; nothing: its recordings do not determine it, or it fits none.
const ModelGap* fitted_gap(const Diagnosis& d) {
  const bool fitted =
      d.model_gap && d.model_gap->origin == GapOrigin::kEstimated && d.model_gap->ci95.low > 0.0;
  return fitted ? &*d.model_gap : nullptr;
}

/// Whether a reading without a model is all that the estimate has: its fit is rejected.
bool reads_beside_rejected(const Answer& estimate, const Findings& f) {
  return estimate.from == AnswerSource::kModelFree && std::isfinite(estimate.gap) && f.reference != nullptr &&
         f.reference->rejected();
}

/// Whether the estimate is that of a model which lacked what the diagnosis has found since.
bool is_superseded(const Answer& estimate, const Diagnosis& d) {
  return estimate.from == AnswerSource::kReference && estimate.trust == AnswerTrust::kLimited &&
         d.verdict == DiagnosisVerdict::kEffect;
}

/// Beside a reading, with which it agrees where their intervals do.
Answer beside_reading(Answer a, const Answer& reading, Coordinates coordinates) {
  const bool agree = a.ci95.low <= reading.ci95.high && reading.ci95.low <= a.ci95.high;
  const bool printed = std::isnan(reading.ci95.low);  // S1 to S6 claim no interval
  go_on(a,
        {{printed ? "gap.literal.reads"
          : agree ? "gap.model_free.agrees"
                  : "gap.model_free.contradicts",
          {number("other", reading.gap, "rad", reading.ci95),
           per_cent("apart", 100.0 * std::abs(reading.gap / a.gap - 1.0))}}},
        coordinates);
  if (!agree && !printed) a.trust = AnswerTrust::kLimited;
  return a;
}

/// Beside a denial of gaps above a limit.
std::optional<Answer> beside_denial(std::optional<Answer> told, const ModelGap& gap, const Answer& denial,
                                    double limit, Coordinates coordinates) {
  const bool contradicted = gap.ci95.low > limit;
  if (!contradicted && (!told || told->trust != AnswerTrust::kGood) && denial.trust == AnswerTrust::kGood)
    return {};
  const Fact least = number("least", limit, "rad");
  if (told) {
    go_on(*told, {{contradicted ? "none.model_free.contradicts" : "none.model_free.agrees", {least}}},
          coordinates);
    if (contradicted) told->trust = AnswerTrust::kLimited;
    return told;
  }
  if (!contradicted) return {};
  Answer a;
  a.from = AnswerSource::kModelFree, a.trust = AnswerTrust::kLimited;
  go_on(a,
        {{"none.model_free", {least, per_cent("share", kNaN)}},
         {"gap.diagnosis.contradicts", {number("other", gap.value, "rad", gap.ci95)}}},
        coordinates);
  return a;
}

}  // namespace

std::optional<Answer> answer_of_diagnosis(const Diagnosis& d, const Answer& estimate, const Findings& f) {
  std::optional<Answer> told = answer_of_diagnosis(d, f.coordinates);
  if (estimate.trust == AnswerTrust::kNone && std::isnan(estimate.gap)) return told;
  if (told && is_superseded(estimate, d)) return told;
  const ModelGap* gap = fitted_gap(d);
  if (gap == nullptr) return {};
  const bool denied = f.model_free != nullptr && f.model_free->verdict == GapVerdict::kNone;
  if (denied && std::isnan(estimate.gap))
    return beside_denial(told, *gap, estimate, f.model_free->none_above(), f.coordinates);
  const bool good = told && told->trust == AnswerTrust::kGood;
  if (!good || !reads_beside_rejected(estimate, f)) return {};
  return beside_reading(*told, estimate, f.coordinates);
}

std::optional<Answer> answer_of_diagnosis(const Diagnosis& d, Coordinates coordinates) {
  if (!d.model_gap || d.model_gap->origin != GapOrigin::kEstimated) return {};
  const ModelGap& gap = *d.model_gap;
  const AnswerTrust trust = trust_in(d);
  if (trust == AnswerTrust::kNone || !(gap.ci95.low > 0.0)) return {};
  Answer a;
  a.gap = gap.value, a.ci95 = gap.ci95, a.from = AnswerSource::kDiagnosis, a.trust = trust;
  if (internal::telling::is_open(a)) a.trust = AnswerTrust::kLimited;
  go_on(a, {{"gap.diagnosis", {number("gap", gap.value, "rad", gap.ci95)}}}, coordinates);
  put_in_doubt(a, d.doubts);
  return a;
}

}  // namespace gapscope
