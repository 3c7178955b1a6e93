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

/// How one estimator did in some runs. Errors are |estimate − true gap| over the true gap.
struct EstimatorScore {
  int runs = 0;                ///< in which it was asked
  int answered = 0;            ///< a gap with an interval (the reference: and converged)
  int denied = 0;              ///< "there is no gap" (model-free verdict none)
  int judged = 0;              ///< answered, and the true gap is known
  int covered = 0;             ///< of these, the interval holds the true gap
  int within_1 = 0;            ///< of these, the error is at most 1 %
  int within_2 = 0;            ///< 2 %
  int within_5 = 0;            ///< 5 %
  double median_error = kNaN;  ///< [-]
  double error_90 = kNaN;      ///< that 90 % of the judged runs do not exceed [-]
  double bias = kNaN;          ///< median of (estimate − true)/true [-]

  double refusal() const { return runs > 0 ? 1.0 - static_cast<double>(answered) / runs : kNaN; }
  double coverage() const { return judged > 0 ? static_cast<double>(covered) / judged : kNaN; }
};

/// Runs that share one value of an axis, or of two.
struct SummaryCell {
  int a = -1, b = -1;  ///< places in the bins of the axes of the table
  int runs = 0;
  int failed = 0;  ///< with an error instead of a result
  EstimatorScore model_free, reference;
  int both = 0;               ///< both answered, and their difference was judged
  int disagree = 0;           ///< of these, beyond the joint uncertainty
  int model_free_nearer = 0;  ///< of these, the model-free estimate was nearer to the true gap
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
  std::string estimator;    ///< "model-free", "reference"
  std::string parameters;   ///< "resolution, by sampling rate"
  std::string needs;        ///< "at least 16 bit with 2 kHz; at least 14 bit with at least 5 kHz"
};

/// What a campaign says. Wall times are no part of it.
struct CampaignSummary {
  std::string name;
  std::string version;        ///< of gapscope
  std::string configuration;  ///< CampaignHeader::identity
  int runs = 0;               ///< of the campaign
  int done = 0;
  bool model_free = true, reference = true;
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

bool has_campaign_summary(const std::string& folder);

}  // namespace gapscope
