#pragma once

#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

/// A quantity in one report: a value, or what it is at most or at least, or nothing.
struct Observation {
  double value = kNaN;
  double std = kNaN;       ///< half the width of the interval over kNormal95, where that is wider
  Interval ci95;           ///< of the value, with what admissible laws of contact and friction differ by
  std::string remark;      ///< why there is no value, or none to rely on; empty: there is one
  double at_most = kNaN;   ///< where it has no value: no larger than this
  double at_least = kNaN;  ///< where it has no value: no smaller than this
  std::string trust = "";  ///< "good", "limited", "none"; empty: its source does not say

  bool has_value() const { return value == value; }
  bool has_bound() const { return at_most == at_most || at_least == at_least; }
};

enum class ChangeVerdict { kOpen, kSame, kChanged };

/// What a verdict rests on.
enum class ChangeReason {
  kUntold,         ///< one of the two has neither a value nor a bound
  kNoInterval,     ///< one of the two has a value whose error is not known
  kBeyondError,    ///< more than the errors of both leave room for
  kWithin,         ///< all that the errors leave room for is within the tolerance
  kTooWide,        ///< the errors leave room for no change and for one that matters
  kTheRecordings,  ///< beyond the errors, but the recordings differ by as much as explains it
  kTheModel,       ///< in one of the two acts what the model lacks, which moves every number of its fit
};

const char* to_string(ChangeVerdict verdict);  ///< "open", "same", "changed"

/// A quantity in one report less the same in the first one.
struct Change {
  double difference = kNaN;    ///< NaN: one of the two is a bound
  Interval ci95;               ///< NaN on a side that a bound leaves open
  Interval together;           ///< the same, wide enough that those of all rows hold in 95 %
  double p = kNaN;             ///< of a difference that large between two equal values [-]
  double margin = kNaN;        ///< a difference up to this is none that matters
  double by_recordings = 0.0;  ///< how much of the difference other torques alone can make
  ChangeVerdict verdict = ChangeVerdict::kOpen;
  ChangeReason reason = ChangeReason::kUntold;
};

/// A quantity over all reports.
struct DriveQuantity {
  std::string key;                    ///< "gap", "lost_motion", "load_coulomb_friction", ... as in the YAML
  std::string from;                   ///< "answer", "model_free", "reference" or "diagnosis"
  std::string unit;                   ///< of a rotational drive; "u": the unit of the input
  std::vector<Observation> observed;  ///< one for each report
  std::vector<Change> changes;        ///< one for each report after the first
  double level = kNaN;                ///< largest |u| of the ramps that it was read from [unit of u]

  bool is_play() const { return key == "gap" || key == "first_gap" || key == "lost_motion"; }
};

/// The mean quasi-static loop of one report at one torque level, for the figure.
struct DrivenLoop {
  int report = 0;             ///< its place, from 0
  double level = kNaN;        ///< that of the quantities read from it [unit of u]
  std::vector<double> u, x1;  ///< closed, x1 about its middle [unit of u, rad]
};

/// What the fits of two reports say of which numbers differ; not asked: not two fits that can be relied on.
enum class WhichVerdict {
  kNotAsked,
  kNone,
  kNamed,
  kMore,       ///< something besides the named numbers differs, too
  kUntold,     ///< something differs, and no number can be named
  kStructure,  ///< in one of them acts what no model has, so its numbers say nothing of the other's
};

/// A number that must differ, and what acts alike and is in neither fit: one of them may in its place.
struct DifferingNumber {
  std::string key;
  std::vector<std::string> look_alikes;
  double p = kNaN;  ///< of a difference so large between two equal numbers [-]
};

struct WhichDiffers {
  WhichVerdict verdict = WhichVerdict::kNotAsked;
  std::vector<DifferingNumber> numbers;  ///< that must differ, the surest first
  std::vector<std::string> one_of;    ///< beside those named more differs: any one of these alone explains it
  std::vector<std::string> compared;  ///< numbers that both fits determine; those not named need not differ
  double p_same = kNaN;               ///< of two groups so far apart, were none to differ [-]
  double p_rest = kNaN;               ///< the same, were none but `numbers` to differ [-]
  /// What recordings that a joint fit has not seen are off by, rms [floor], where it shares all numbers,
  /// where those named may differ, and where all may; NaN: it was not tried.
  double off_shared = kNaN, off_named = kNaN, off_free = kNaN;
  double left_first = kNaN, left_now = kNaN;  ///< what each fit leaves of its own recordings [floor]
};

/// A quantity in the order of the reports.
struct QuantityCourse {
  std::string key, from, unit;
  double level = kNaN;
  double slope = kNaN;  ///< from report to report
  Interval slope_ci95;
  int since = -1;  ///< place of the first report where it is not what it was; -1: no change is seen
  double before = kNaN, after = kNaN;  ///< means on both sides of where they differ most
  Interval step_ci95;                  ///< of `after` less `before`
};

/// A unit that is unlike the others.
struct OddUnit {
  int report = -1;
  std::string key, from;
  double level = kNaN;
  double distance = kNaN;  ///< from the others, as a normal number of that probability
};

/// What the reports are of.
enum class ReportOrder { kInTime, kUnits };

/// The same drive over months, before and after a repair.
struct DriveChanges {
  std::string version;        ///< of gapscope
  std::string configuration;  ///< of each report the name, the version and the hash of its configuration
  Coordinates coordinates;
  std::string input_unit;            ///< of u, as it was declared; empty: it was not
  std::vector<std::string> reports;  ///< their folders
  std::vector<DriveQuantity>
      quantities;          ///< that at least one report gives or bounds; what was given to it does not count
  int compared = 0;        ///< differences that have an interval: the rows that share one error rate
  double quantile = kNaN;  ///< half width of `together` in standard errors
  int lead = -1;           ///< place of the quantity that is told first; -1: none has changed
  std::vector<std::string> codes;  ///< "changed.model_free.lost_motion.fell", ...: what is told, first first
  std::vector<DrivenLoop> loops;
  ReportOrder order = ReportOrder::kInTime;
  std::vector<WhichDiffers> which;      ///< one for each report after the first
  std::vector<QuantityCourse> courses;  ///< in time, of quantities that four reports or more have
  std::vector<OddUnit> odd;             ///< of units, the farthest first
  std::vector<std::string> warnings;    ///< why values may differ though the drive does not

  /// The first of that name; nullptr if untold.
  const DriveQuantity* find(const std::string& from, const std::string& key) const;
};

/// compare.json of a folder (schema gapscope.compare/2).
/// @throws std::runtime_error naming what cannot be written.
void write_drive_changes(const std::string& folder, const DriveChanges& changes);

/// Reads back exactly what was written.  @throws ConfigError for another schema or a damaged file.
DriveChanges read_drive_changes(const std::string& folder);

bool has_drive_changes(const std::string& folder);

}  // namespace gapscope
