#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/blind_records.h"

namespace gapscope {

/// How many of how many; blind.json has the share and its 95 % limits (Wilson) beside it.
struct BlindCount {
  std::string name;
  int count = 0, of = 0;
  double aim = kNaN;     ///< share that is aimed at
  bool at_most = false;  ///< the aim is an upper limit
  double share() const { return of > 0 ? static_cast<double>(count) / of : kNaN; }
  Interval limits() const { return of > 0 ? wilson(count, of) : Interval{}; }
};

/// How often a truth with at most one effect got an answer. The answer is the truth where the truth is named
/// or in the group of what is named, else the first effect named, "unknown" or "none".
struct ConfusionCell {
  std::string truth;  ///< an effect, "outside" (the catalogue) or "none"
  std::string answer;
  int count = 0;
};

/// The cases with one effect of the catalogue that have something in common.
struct BlindSlice {
  std::string by;    ///< "rig", "severity" or "effect"
  std::string name;  ///< of the rig, range of severities, effect
  int cases = 0;
  int seen = 0;                         ///< with more than 2 floors of mismatch
  int first = 0, named = 0, wrong = 0;  ///< of those
  double shrink = kNaN;                 ///< median of those named with at least 3 floors
};

/// Cases that were given similar probabilities.
struct ReliabilityBin {
  int cases = 0;
  double predicted = kNaN;  ///< mean
  int right = 0;
};

/// P(the truth is in the first step's group) = σ(b₀ + b₁ rel + b₂ ln(max(margin, 0) + 0.05) + b₃ ln gain).
struct BlindCalibration {
  std::vector<double>
      weights;        ///< b₀ to b₃; empty: too few cases to learn from, probabilities stay as they are
  int learnt_on = 0;  ///< decisions of the calibration part
  int judged_on = 0;  ///< decisions of the report part
  std::vector<ReliabilityBin> bins;          ///< of the report part
  double error = kNaN, error_before = kNaN;  ///< mean |predicted − seen| over bins, weighted by their cases
  double brier = kNaN, brier_before = kNaN;
};

/// What is left when only decisions of at least this probability are answered.
struct AbstentionPoint {
  double threshold = 0.0;
  int answered = 0, right = 0;
};

/// What was implanted into a case, and what the answer made of it.
struct ScoredImplant {
  double size = kNaN;            ///< rms of what it makes over that of the input
  double foretold_share = kNaN;  ///< of the held-out residual torque
  std::string parameter, unit;   ///< of its amount; empty without an effect
  double amount = kNaN;
  bool told = false;      ///< the effect was added, or is in the group of one that was
  bool stranger = false;  ///< the cause of an effect was called established that was neither implanted nor is
                          ///< the drive's own
};

/// One case, for the reader.
struct ScoredCase {
  std::string name, part, rig, truth, verdict, named;  ///< several effects joined by '+'
  double severity = kNaN;
  double before = kNaN;  ///< mismatch of the nominal model [floor]
  double shrink = kNaN;
  double probability = kNaN;  ///< calibrated, of the first step
  bool right = false;         ///< all truths and nothing else; unknown where it is outside the catalogue
  std::optional<ScoredImplant> implant = {};  ///< nothing where the effect was not implanted
};

struct BlindScore {
  std::string name, version, manifest_sha256, answers_seal;
  std::string announced_seal;  ///< that the answers were held against; empty: none was given
  std::string configuration;   ///< of the labels
  int calibration_cases = 0, report_cases = 0;
  std::vector<BlindCount> counts;
  double group_median = kNaN, group_mean = kNaN;
  double shrink_median = kNaN, shrink_tenth = kNaN, shrink_other_law = kNaN;
  std::vector<ConfusionCell> confusion;  ///< what occurs, in the order of the catalogue
  std::vector<BlindSlice> slices;
  BlindCalibration calibration;
  std::vector<AbstentionPoint> abstention;
  std::vector<ScoredCase> cases;

  bool of_implants() const { return !cases.empty() && cases.front().implant.has_value(); }
};

/// Writes blind.json into an existing folder.  @throws std::runtime_error naming what cannot be written.
void write_blind_score(const std::string& folder, const BlindScore& score);

/// Reads back exactly what was written.  @throws ConfigError for another schema or a damaged file.
BlindScore read_blind_score(const std::string& folder);

bool has_blind_score(const std::string& folder);

}  // namespace gapscope
