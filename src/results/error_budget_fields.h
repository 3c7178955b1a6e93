#pragma once

#include "gapscope/diagnosis/error_budget.h"
#include "results/json_archive.h"

/// The fields of a stored error budget.
namespace gapscope::internal::results {

template <class Archive>
void fields(Archive& archive, BudgetRung& r) {
  archive("law", r.law);
  archive("effect", r.effect);
  archive("added", r.added);
  archive("before_nm", r.before);
  archive("after_nm", r.after);
  archive("share", r.share);
  archive("share_ci95", r.share_ci95);
  archive("share_alone", r.alone);
  archive("share_last", r.last);
  archive("period_rad", r.period);
  archive.seldom("rivals", r.rivals);
}

template <class Archive>
void fields(Archive& archive, ErrorBudget& b) {
  archive("band_hz", b.band_hz);
  archive("input_nm", b.input);
  archive("nominal_nm", b.nominal);
  archive("with_effects_nm", b.with_effects);
  archive("remains_nm", b.remains);
  archive("encoder_floor_nm", b.encoder);
  archive("repeatability_floor_nm", b.repeatability);
  archive("records_floor_nm", b.records);
  archive.list("rungs", b.rungs);
  archive.seldom("uncounted", b.uncounted);
}

}  // namespace gapscope::internal::results
