#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// A value of an axis, or a part of its range.
struct SummaryBin {
  std::string label;    ///< "2 kHz"
  double value = kNaN;  ///< NaN where the values are no numbers
};

/// An axis that runs are compared along; repeats are none.
struct SummaryAxis {
  std::string path;  ///< "simulation.rate"
  std::string name;  ///< "sampling rate"
  std::vector<SummaryBin> bins;
};

/// How one estimator did in some runs. Errors are |estimate − true gap| over the true gap, widths and scores
/// of intervals likewise.
struct EstimatorScore {
  int runs = 0;                ///< in which it was asked
  int answered = 0;            ///< the gap (CampaignEstimate::answers)
  int denied = 0;              ///< "there is no gap" (verdict none)
  int judged = 0;              ///< answered, and the true gap is known
  int within_1 = 0;            ///< of these, the error is at most 1 %
  int within_2 = 0;            ///< 2 %
  int within_5 = 0;            ///< 5 %
  int claimed = 0;             ///< of the judged ones, with a 95 % interval
  int covered = 0;             ///< of these, it holds the true gap
  int good = 0;                ///< of the claimed ones, told with good trust
  int good_covered = 0;        ///< of these, the interval holds the true gap
  double median_error = kNaN;  ///< [-]
  double error_90 = kNaN;      ///< that 90 % of the judged runs do not exceed [-]
  double bias = kNaN;          ///< median of (estimate − true)/true [-]
  Interval bias_ci;            ///< 95 %, of the order statistics; NaN for fewer than 6 runs [-]
  double median_width = kNaN;  ///< of the intervals [-]
  /// Mean of width + 40 × what the true gap lies outside (Gneiting and Raftery) [-]
  double interval_score = kNaN;
  double passes = kNaN;  ///< median of CampaignEstimate::passes

  double refusal() const { return runs > 0 ? 1.0 - static_cast<double>(answered) / runs : kNaN; }
  double coverage() const { return claimed > 0 ? static_cast<double>(covered) / claimed : kNaN; }
};

/// Runs that share one value of an axis, or of two.
struct SummaryCell {
  int a = -1, b = -1;  ///< places in the bins of the axes of the table
  int runs = 0;
  int failed = 0;  ///< with an error instead of a result
  EstimatorScore literal, model_free, reference;
  int both = 0;               ///< both answered, and their difference was judged
  int disagree = 0;           ///< of these, beyond the joint uncertainty
  int model_free_nearer = 0;  ///< of these, the model-free estimate was nearer to the true gap
};

/// Two estimators on the runs that both answer, the true gap known.
struct EstimatorPair {
  std::string first, second;    ///< keys: "literal", "model_free", "reference"
  int both = 0;                 ///< runs
  int first_nearer = 0;         ///< of these
  double first_error = kNaN;    ///< median of |error| of these [-]
  double second_error = kNaN;   ///< [-]
  double advantage = kNaN;      ///< median of |first's error| − |second's| [-]
  Interval advantage_ci;        ///< 95 %, of the order statistics [-]
  int claimed = 0;              ///< of both, those in which both have an interval
  int disagree = 0;             ///< of these, by more than 1.96 √(σ1² + σ2²)
  double correlation = kNaN;    ///< ρ of both errors over their standard errors, by ranks
  Interval correlation_ci;      ///< 95 %
  int disagree_correlated = 0;  ///< by more than 1.96 √(σ1² + σ2² − 2 ρ σ1 σ2)
};

/// What an estimator was told of the drive.
struct SummaryTold {
  std::string estimator;           ///< key
  std::vector<std::string> told;   ///< every set of things that it was told in some run
  std::vector<std::string> lacks;  ///< of the reference: what the plant has and its model has not
};

/// Scores along one axis (b = −1), or over two.
struct SummaryTable {
  int a = -1, b = -1;  ///< places in CampaignSummary::axes
  std::vector<SummaryCell> cells;
};

/// Something that was said in more than one run.
struct SummaryCount {
  std::string text;
  int runs = 0;
};

/// "For at most 2 %": what an estimator needs.
struct SummaryAnswer {
  double tolerance = kNaN;  ///< [-]
  std::string estimator;    ///< key
  std::string parameters;   ///< "resolution, by sampling rate"
  std::string needs;        ///< "at least 16 bit with 2 kHz; at least 14 bit with at least 5 kHz"
};

/// Median wall times of the estimators; the only stored result that is no function of the campaign.
struct CampaignTimes {
  double literal_s = kNaN;
  double model_free_s = kNaN;
  double reference_s = kNaN;
};

/// What a campaign says. Wall times are no part of it.
struct CampaignSummary {
  std::string name;
  std::string version;        ///< of gapscope
  std::string configuration;  ///< CampaignHeader::identity
  int runs = 0;               ///< of the campaign
  int done = 0;
  int repeated = 0;  ///< runs that are another one to the last digit but for their seed, and are not counted
  bool literal = false, model_free = true, reference = true;
  double samples = kNaN;   ///< median of a run
  double recorded = kNaN;  ///< [s]
  std::vector<SummaryTold> told;
  std::vector<EstimatorPair> contests;  ///< over all runs
  std::vector<SummaryAxis> axes;
  SummaryCell total;
  std::vector<SummaryTable> lines;  ///< along each axis
  std::vector<SummaryTable> pairs;  ///< over each pair of axes, sampling × resolution first
  std::vector<SummaryAnswer> answers;
  std::vector<SummaryCount> refusals;  ///< why the model-free detector gave no gap, most frequent first
  std::vector<SummaryCount> errors;    ///< why runs failed
};

/// Writes campaign.json into an existing folder.  @throws std::runtime_error naming what cannot be written.
void write_campaign_summary(const std::string& folder, const CampaignSummary& summary);

/// Reads back exactly what was written.  @throws ConfigError for another schema or a damaged file.
CampaignSummary read_campaign_summary(const std::string& folder);

/// timing.json beside it.
void write_campaign_times(const std::string& folder, const CampaignTimes& times);

bool has_campaign_summary(const std::string& folder);

}  // namespace gapscope
