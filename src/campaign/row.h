#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// What one estimator made of one run. A text that does not apply is empty, a number NaN.
struct CampaignEstimate {
  std::string outcome;  ///< backlash, none, inconclusive; of the reference converged, not_converged, failed
  std::optional<bool> answers;  ///< it tells the gap, with an interval where it claims any: neither a bound
                                ///< nor a play at zero torque nor the first of several gaps; no rejected fit
  std::string reason;           ///< why there is none; of the reference what its trust rests on
  std::string reason_codes;     ///< Remark::codes() of the reason
  double gap = kNaN;            ///< [rad]
  double std = kNaN;            ///< [rad]; of `literal` the scatter of its passages
  Interval ci95;         ///< NaN where it claims none, or the recording does not determine the gap [rad]
  std::string quantity;  ///< of `gap`: gap, first_gap, play_at_zero_torque
  std::string method;    ///< literal, impact, lost_motion, paper; fit
  std::string trust;     ///< none, limited, good; rejected
  std::string told;      ///< what it was told of the drive, "" for nothing
  double passes = kNaN;  ///< samples run through a differentiator or a model, per sample recorded
};

/// One run of a campaign, as it is stored. A text that does not apply is empty, a number NaN.
struct CampaignRow {
  std::uint64_t run = 0;           ///< its place in the campaign, from 0
  std::vector<std::string> point;  ///< values of the axes, then of what was drawn, as YAML
  std::string seed;                ///< of the simulation, or of the fit for recorded data
  std::string configuration;       ///< YAML with every default filled in
  std::string error;               ///< why there is no result; empty where there is one
  std::string data;                ///< of the samples that the estimators read: the same data, the same text
  double samples = kNaN;           ///< of all recordings
  double recorded = kNaN;          ///< how long they are [s]
  double true_gap = kNaN;          ///< 2β of the simulated plant [rad]
  CampaignEstimate literal, model_free, reference;
  std::string lacks;                   ///< what the plant has, and the model that is fitted has not
  double smallest_visible_gap = kNaN;  ///< model-free [rad]
  double gap_at_most = kNaN;           ///< model-free: a bound, which is no gap [rad]
  double events = kNaN;                ///< passages that the model-free detector used
  double rmse = kNaN;                  ///< of the reference's free run [rad]
  double difference = kNaN;            ///< model-free − reference [rad]
  double joint_std = kNaN;             ///< as if both erred independently [rad]
  std::optional<bool> agree;
};

/// Wall times of a run; they are kept apart from what a run is a function of.
struct CampaignTiming {
  double literal_s = kNaN;
  double model_free_s = kNaN;
  double reference_s = kNaN;
  double run_s = kNaN;  ///< with making or reading the data
};

template <class Visitor>
void fields(Visitor& visit, const std::string& who, const char* outcome, CampaignEstimate& e) {
  visit(who + outcome, e.outcome);
  visit(who + "_answers", e.answers);
  visit(who + "_reason", e.reason);
  visit(who + "_reason_codes", e.reason_codes);
  visit(who + "_gap_rad", e.gap);
  visit(who + "_std_rad", e.std);
  visit(who + "_low_rad", e.ci95.low);
  visit(who + "_high_rad", e.ci95.high);
  visit(who + "_quantity", e.quantity);
  visit(who + "_method", e.method);
  visit(who + "_trust", e.trust);
  visit(who + "_told", e.told);
  visit(who + "_passes", e.passes);
}

/// Meets every field but `run` and `point` with its name in the store and in the export.
template <class Visitor>
void fields(Visitor& visit, CampaignRow& r) {
  visit("seed", r.seed);
  visit("error", r.error);
  visit("data", r.data);
  visit("samples", r.samples);
  visit("recorded_s", r.recorded);
  visit("true_gap_rad", r.true_gap);
  fields(visit, "literal", "_verdict", r.literal);
  fields(visit, "model_free", "_verdict", r.model_free);
  visit("smallest_visible_gap_rad", r.smallest_visible_gap);
  visit("gap_at_most_rad", r.gap_at_most);
  visit("events", r.events);
  fields(visit, "reference", "_status", r.reference);
  visit("reference_rmse_rad", r.rmse);
  visit("reference_lacks", r.lacks);
  visit("difference_rad", r.difference);
  visit("joint_std_rad", r.joint_std);
  visit("agree", r.agree);
  visit("configuration", r.configuration);
}

template <class Visitor>
void fields(Visitor& visit, CampaignTiming& t) {
  visit("literal_s", t.literal_s);
  visit("model_free_s", t.model_free_s);
  visit("reference_s", t.reference_s);
  visit("run_s", t.run_s);
}

}  // namespace gapscope
