#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/file_hash.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {

/// Least size of a row that differs [floor]: what smaller ones would show is the encoder's.
inline constexpr double kLeastRow = 2.0;

/// A number that both recordings were asked for, by one and the same model.
struct ComparedNumber {
  std::string key;
  std::string unit;
  double drive = kNaN, simulator = kNaN;
  Interval drive_ci95, simulator_ci95;  ///< NaN: the recording does not determine it
};

/// Where an effect shows. A parameter that both models have is in both.
enum class FoundIn { kNeither, kDrive, kSimulator, kBoth };

/// One effect, or one parameter of the drive, in the drive and in the user's simulator.
struct SimulatorRow {
  std::string name;  ///< of the catalogue, or the key of a parameter
  bool is_effect = false;
  FoundIn found_in = FoundIn::kBoth;
  bool differs = false;            ///< beyond two floors and both intervals
  std::vector<std::string> group;  ///< effects that the recordings cannot tell from it, itself included
  std::vector<ComparedNumber> numbers;
  /// What of the motion either recording cannot be brought to by the other's numbers of this row, everything
  /// else refitted: rms of restarted free runs on held-out data, the smaller of both [rad].
  double size = kNaN;
  double floors = kNaN;         ///< the same in floors
  double shrink = kNaN;         ///< of the simulator's held-out error, if this row alone is mended
  double shrink_fitted = kNaN;  ///< the same on what was fitted, by which rows are put in order
  std::string sentence;         ///< empty unless it differs
};

/// Whether a number says how much there is of the row's effect, not of what shape it is.
bool says_how_much(const SimulatorRow& row, const ComparedNumber& number);

/// Whether it says so, and that there is none. @param value  the number's, on either side
bool says_none(const SimulatorRow& row, const ComparedNumber& number, double value);

/// Drive, simulator and what stands for them, beside one recording. Columns of equal length.
struct SimulatorTrace {
  std::string file;       ///< of the drive's recording
  std::string simulated;  ///< of the simulator's
  double start = 0.0, dt = 0.0;
  std::size_t scored_from = 0;           ///< samples before it were fitted
  std::vector<double> u, x1, simulator;  ///< [unit of u], [rad], [rad]
  std::vector<double> fitted;            ///< free run of the model fitted to the drive [rad]; empty: diverges
  std::vector<double> stand_in;          ///< of the model fitted to the simulator [rad]
  std::vector<double> mended;       ///< of that one with the first row mended [rad]; empty: there is none
  std::vector<double> stamps = {};  ///< time of each sample [s]; empty: evenly sampled

  double time(std::size_t i) const {
    return stamps.empty() ? start + dt * static_cast<double>(i) : stamps[i];
  }
};

/// rms over the held-out samples, all free runs from the simulator's own start [rad].
struct SimulatorErrors {
  double simulator = kNaN;      ///< drive − simulator, as recorded
  double stand_in = kNaN;       ///< drive − the model fitted to the simulator
  double stand_in_miss = kNaN;  ///< simulator − that model: what the stand-in is worth
  double mended = kNaN;         ///< drive − the stand-in with the first row mended
  double all_mended = kNaN;     ///< drive − the stand-in with every row that differs mended
};

/// What the comparison could read. Not fitted: no model with the effects of both follows the two alike. Not
/// followed: the model fitted to the simulator is farther from it than it is from the drive.
enum class ComparisonState { kNotFitted, kNotFollowed, kRead };

/// What the drive has and the user's simulator has not, and the other way round.
struct SimulatorComparison {
  std::string sentence;  ///< all of this in words; whoever tells it fills it in, as those of the rows
  std::string in_brief;  ///< the same in one sentence, for the card
  ComparisonState state = ComparisonState::kNotFitted;
  double drive_floors = kNaN, simulator_floors = kNaN;   ///< what the model with all effects of both leaves
  double dt = kNaN;                                      ///< sampling interval [s]
  DiagnosisVerdict verdict = DiagnosisVerdict::kNotRun;  ///< of the simulator's recording
  std::vector<std::string> effects;  ///< that its diagnosis has added to the nominal model
  double floor = kNaN;               ///< of the instrument, the larger of both recordings' [rad]
  SimulatorErrors errors;
  double shrink = kNaN;            ///< 1 − mended/stand_in; NaN where no row differs
  double shrink_all = kNaN;        ///< 1 − all_mended/stand_in
  std::vector<SimulatorRow> rows;  ///< those that differ first, by what mending them takes
  std::vector<FileHash> files;     ///< of the simulator, filled in by whoever has read them
  std::vector<std::string> warnings;
  std::vector<SimulatorTrace> traces;
};

/// The recordings of a drive and those of its user's simulator, under the same input at the same times.
struct SimulatorQuestion {
  std::span<const MotorTrace> train, held_out;  ///< of the drive; nothing held out: the last third of each
  std::span<const MotorTrace> simulated_train, simulated_held_out;
  const Diagnosis& drive;  ///< of these recordings, by one nominal model
  const Diagnosis& simulator;
};

/// Lays drive and simulator side by side: both are fitted again with every effect that either diagnosis has
/// added. A row differs where neither recording takes the other's numbers, whatever else is refitted, by two
/// floors or more, and where the intervals say so as well. How far mending a row shrinks the simulator's
/// error is told by a stand-in, the model fitted to the simulator with that row's numbers from the drive.
/// @throws std::logic_error unless the recordings of both are as many and as long; Interrupted
SimulatorComparison compare_with_simulator(const SimulatorQuestion& question,
                                           const DiagnosisOptions& options);

}  // namespace gapscope
