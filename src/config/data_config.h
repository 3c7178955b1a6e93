#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/declared_units.h"
#include "config/model_config.h"
#include "gapscope/base/fields.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {

/// A recording named in a configuration.
struct RecordedFile {
  std::string given;        ///< as it is written there
  std::string path;         ///< relative to the configuration's own folder, so that it can be opened
  int line = 0;             ///< of the configuration
  double gain_times = 1.0;  ///< the controller's gain in it, over that of `controller:` [-]
  std::optional<std::pair<double, double>> window = {};  ///< the part of it that is used [s]
  std::optional<std::pair<double, double>> off = {};     ///< between which it was switched off [s]
  double mass = kNaN;                                    ///< on its arm; NaN: that of `anchor:` [kg]
  double arm = kNaN;                                     ///< the same of the distance from the axis [m]
  double voltage = kNaN;                                 ///< of the supply; NaN: as for all [V]
  AddedLoad load = {};                                   ///< of its mass on its arm, beyond that of `anchor:`

  /// Whether more is known of it than its name.
  bool has_facts() const;
  /// Whether both are the same rows.
  bool is_same_part(const RecordedFile& other) const { return path == other.path && window == other.window; }
};

/// `recording:` – data from files. Several are never concatenated.
struct RecordingConfig {
  std::vector<RecordedFile> files;
  std::vector<RecordedFile> held_out;  ///< only read by the diagnosis
  /// What a simulator of the user's answers to the same inputs: one for each of `files`, then, if any is held
  /// out, one for each of `held_out` or none. Empty: there is none.
  std::vector<RecordedFile> simulated = {};
  ReadOptions reading;  ///< columns with what units and gears make of them, window, resampling
  std::string mass_column = {}, arm_column = {}, gain_column = {};  ///< where the files have these numbers
  bool resample_for_detector = false;  ///< fit and diagnose take the rows as they are
  DeclaredUnits units;
  RegisterForms registers;
  GearRatios gear;
  std::vector<Remark> assumed = {};  ///< what of this nobody declared

  /// Whether the supply's voltage multiplies the input.
  bool is_supplied() const;

  /// @returns what is wrong with the number of simulated recordings; empty: nothing
  std::string simulated_problem() const;

  /// For an estimator that needs a grid (kRefused), or for one that takes uneven rows as they are (kStamped).
  ReadOptions reading_for(UnevenRows uneven) const;
  /// The same for one of its files, whose controller may have had another gain.
  ReadOptions reading_of(const RecordedFile& file, UnevenRows uneven) const;
};

/// `simulation.initial:` – the state at the first sample.
struct InitialState {
  double x1 = 0.0;  ///< [rad]
  double w1 = 0.0;  ///< [rad/s]
  double x2 = 0.0;  ///< [rad]
  double w2 = 0.0;  ///< [rad/s]
  void fields(FieldVisitor& v);
};

/// `simulation:` – data of its own making.
struct SimulationConfig {
  double rate = 0.0;       ///< [Hz]
  double duration = 0.0;   ///< [s]
  std::uint64_t seed = 1;  ///< the only source of randomness
  Excitation excitation;
  InitialState initial;
  double noise = 0.0;        ///< rms, before quantisation [rad]
  bool independent = false;  ///< made by the plant code that shares nothing with the estimators
  SimulatedPlant plant;
  int line = 0;

  std::size_t samples() const;  ///< rate × duration, to the nearest
};

/// More samples than this are refused: a mistyped rate must not eat the machine.
constexpr double kMostSimulatedSamples = 2e7;

}  // namespace gapscope
