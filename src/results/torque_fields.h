#pragma once

#include <vector>

#include "gapscope/diagnosis/error_budget.h"
#include "gapscope/diagnosis/last_resort.h"
#include "results/json_archive.h"

/// The fields of a stored error budget and of a law of last resort.
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

/// Units of the values of a list, by their keys.
template <class Archive>
void units(Archive& archive, const char* key, std::vector<NamedValue>& values) {
  archive.named_members(key, values, &NamedValue::key, &NamedValue::unit);
}

template <class Archive>
void fields(Archive& archive, CurvePoint& p) {
  archive("at", p.at);
  archive("direction", p.direction);
  archive("torque_nm", p.torque);
  archive("torque_ci95_nm", p.ci95);
}

template <class Archive>
void fields(Archive& archive, ResidualBin& b) {
  archive("at", b.at);
  archive("direction", b.direction);
  archive("samples", b.samples);
  archive("before_nm", b.before);
  archive("after_nm", b.after);
}

template <class Archive>
void fields(Archive& archive, LastResortLaw& l) {
  archive("law", l.law);
  archive("variable", l.variable);
  archive("group", l.group);
  archive("on_top_of", l.on_top_of);
  archive.named_members("parameters", l.parameters, &NamedValue::key, &NamedValue::value);
  units(archive, "units", l.parameters);
  archive("shrink", l.shrink);
  archive("shrink_ci95", l.shrink_ci95);
  archive("before_rad", l.before);
  archive("after_rad", l.after);
  archive("before_torque_nm", l.before_torque);
  archive("after_torque_nm", l.after_torque);
  archive.list("curve", l.curve);
  archive.list("residual", l.residual);
}

}  // namespace gapscope::internal::results
