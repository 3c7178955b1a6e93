#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// One run of a campaign, as it is stored. A text that does not apply is empty, a number NaN.
struct CampaignRow {
  std::uint64_t run = 0;           ///< its place in the campaign, from 0
  std::vector<std::string> point;  ///< values of the axes, then of what was drawn, as YAML
  std::string seed;                ///< of the simulation, or of the fit for recorded data
  std::string configuration;       ///< YAML with every default filled in
  std::string error;               ///< why there is no result; empty where there is one
  double true_gap = kNaN;          ///< 2β of the simulated plant [rad]
  std::string verdict;             ///< model-free: backlash, none, inconclusive
  std::string reason;
  double gap = kNaN;  ///< model-free [rad]
  double std = kNaN;
  Interval ci95;
  double smallest_visible_gap = kNaN;
  double events = kNaN;  ///< passages found
  std::string status;    ///< reference: converged, not_converged, failed
  double reference_gap = kNaN;
  double reference_std = kNaN;
  Interval reference_ci95;  ///< NaN where the recording does not determine the gap
  double rmse = kNaN;       ///< of the free run [rad]
  double difference = kNaN;
  double joint_std = kNaN;
  std::optional<bool> agree;
  std::string reason_codes;  ///< Remark::codes() of the reason; empty in stores that were made without them
  std::string reference_trust;  ///< good, limited, rejected; empty in stores that were made without it
};

/// Wall times of a run; they are kept apart from what a run is a function of.
struct CampaignTiming {
  double model_free_s = kNaN;
  double reference_s = kNaN;
  double run_s = kNaN;  ///< with making or reading the data
};

/// The columns that stores of earlier versions do not have, in the order in which they were added.
inline constexpr const char* kAddedColumns[] = {"model_free_reason_codes", "reference_trust"};

/// Meets every field but `run` and `point` with its name in the store and in the export.
template <class Visitor>
void fields(Visitor& visit, CampaignRow& r) {
  visit("seed", r.seed);
  visit("error", r.error);
  visit("true_gap_rad", r.true_gap);
  visit("model_free_verdict", r.verdict);
  visit("model_free_reason", r.reason);
  visit("model_free_gap_rad", r.gap);
  visit("model_free_std_rad", r.std);
  visit("model_free_low_rad", r.ci95.low);
  visit("model_free_high_rad", r.ci95.high);
  visit("smallest_visible_gap_rad", r.smallest_visible_gap);
  visit("events", r.events);
  visit("reference_status", r.status);
  visit("reference_gap_rad", r.reference_gap);
  visit("reference_std_rad", r.reference_std);
  visit("reference_low_rad", r.reference_ci95.low);
  visit("reference_high_rad", r.reference_ci95.high);
  visit("reference_rmse_rad", r.rmse);
  visit("difference_rad", r.difference);
  visit("joint_std_rad", r.joint_std);
  visit("agree", r.agree);
  visit("configuration", r.configuration);
  visit(kAddedColumns[0], r.reason_codes);  // additions, behind what older stores have
  visit(kAddedColumns[1], r.reference_trust);
}

}  // namespace gapscope
