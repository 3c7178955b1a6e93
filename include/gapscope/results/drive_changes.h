#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/statistics.h"
#include "gapscope/reference/fit_summary.h"
#include "gapscope/sliding_mode/gap_estimate.h"

namespace gapscope {

/// With what a recording was made, as far as its columns tell.
struct ExcitationFacts {
  std::string file;
  int samples = 0;
  double rate = kNaN;             ///< [Hz]
  double quantum = kNaN;          ///< of the encoder [rad]; 0: unknown
  double input_rms = kNaN;        ///< [unit of u]
  double input_peak = kNaN;       ///< [unit of u]
  double input_frequency = kNaN;  ///< half the rate at which u crosses its mean, with hysteresis [Hz]
  double position_rms = kNaN;     ///< [rad]
};

/// What one folder of `run`, `detect` or `fit` says of a drive; a part that was not asked for is absent.
struct DriveReport {
  std::string folder;
  std::string name;           ///< of the configuration
  std::string version;        ///< of gapscope
  std::string configuration;  ///< resolved; empty in files that were written before it was stored
  Coordinates coordinates;    ///< of a translation: rad and N·m mean m and N
  std::optional<GapEstimate> model_free;
  std::optional<FitSummary> reference;  ///< without its traces
  std::vector<ExcitationFacts> recordings;
  std::vector<std::string> doubts = {};  ///< what is stored is not what gapscope wrote, as sentences
};

/// A quantity in one report.
struct Observation {
  double value = kNaN;
  double std = kNaN;   ///< half the width of the interval over kNormal95, where that is wider
  Interval ci95;       ///< of a gap that was denied: from 0 to the smallest that would have shown
  std::string remark;  ///< why there is no value, or none to rely on; empty: there is one
};

enum class ChangeVerdict { kUntold, kNotSeen, kChance, kChanged };

/// "cannot be told", "no change seen", "not beyond chance", "changed"
const char* to_string(ChangeVerdict verdict);

/// A quantity in one report less the same in the first one.
struct Change {
  double difference = kNaN;
  Interval ci95;    ///< from √(σ² + σ²); of a denied gap: all that the two intervals leave possible
  double p = kNaN;  ///< of a difference that large between two equal values [-]
  ChangeVerdict verdict = ChangeVerdict::kUntold;
};

/// A quantity over all reports.
struct DriveQuantity {
  std::string key;   ///< "gap", "play_at_zero_torque", "load_coulomb_friction", ... as in the YAML
  std::string from;  ///< "model_free" or "reference"
  std::string unit;  ///< of a rotational drive
  std::vector<Observation> observed;  ///< one for each report
  std::vector<Change> changes;        ///< one for each report after the first
};

/// The same drive over months, before and after a repair.
struct DriveChanges {
  std::string version;        ///< of gapscope
  std::string configuration;  ///< of each report the name, the version and the hash of its configuration
  Coordinates coordinates;
  std::vector<std::string> reports;  ///< their folders
  std::vector<DriveQuantity>
      quantities;    ///< that at least one report gives or denies; what was given to it does not count
  int compared = 0;  ///< differences that have a p
  std::vector<std::string> warnings;  ///< why values may differ though the drive does not

  const DriveQuantity* find(const std::string& from, const std::string& key) const;  ///< nullptr if untold
};

/// @throws ConfigError with file, what is wrong and what was expected, where there is no result or a damaged
/// one
DriveReport read_drive_report(const std::string& folder);

/// Sets every report against the first one. Changed is what differs by more than both standard errors carry,
/// at 5 % for all comparisons together (Holm, Scandinavian Journal of Statistics 6, 1979): with twenty of
/// them, one interval of 95 % leaves zero out by chance alone. Intervals are those of single recordings: what
/// a drive does differently from day to day is not in them.
/// @throws ConfigError for reports in different coordinates, std::logic_error for fewer than two
DriveChanges changes(std::span<const DriveReport> reports);

/// compare.json of a folder (schema gapscope.compare/1).
/// @throws std::runtime_error naming what cannot be written.
void write_drive_changes(const std::string& folder, const DriveChanges& changes);

/// Reads back exactly what was written.  @throws ConfigError for another schema or a damaged file.
DriveChanges read_drive_changes(const std::string& folder);

bool has_drive_changes(const std::string& folder);

}  // namespace gapscope
