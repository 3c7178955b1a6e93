#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/input_facts.h"
#include "config/data_config.h"
#include "config/implant_config.h"
#include "config/model_config.h"
#include "config/setting.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/sliding_mode/detector.h"
#include "gapscope/telling/card.h"
#include "plant/acceleration_bound.h"

namespace gapscope {

/// `detector:` – how the gap is looked for without a model, and where the bound L comes from; neither of
/// both: from the data alone.
struct DetectorConfig {
  DetectorMethod method = DetectorMethod::kAuto;
  std::optional<double> bound;               ///< [rad/s²]
  std::optional<BoundKnowledge> from_model;  ///< L by eq. (13)
  std::optional<double> literal;             ///< L of S1 to S6 as printed, run beside the rest [rad/s²]
  int line = 0;
};

/// One configuration serves every command.
struct Configuration {
  std::string name;                          ///< of the report folder; a plain file name
  std::string file;                          ///< the YAML itself, for messages
  std::optional<RecordingConfig> recording;  ///< exactly one of these two
  std::optional<SimulationConfig> simulation;
  EncoderConfig encoder;
  Coordinates coordinates;  ///< of a translation: rad and N·m mean m and N
  ModelConfig model;
  std::optional<ControllerModel> controller = {};  ///< `controller:` – that makes the input of a target
  std::optional<AnchorConfig> anchor = {};         ///< `anchor:` – what fixes the scale of the torques
  DetectorConfig detector;
  FitOptions fit;  ///< `fit:` – how the reference is found; optional, every key of it too
  /// `next_experiment:` – what the diagnosis may propose; optional like it.
  ExperimentLimits next_experiment;
  int next_experiment_line = 0;
  DiagnosisKnowledge diagnosis;               ///< `diagnosis:` – what it is told beforehand; optional
  std::vector<std::string> excluded;          ///< `diagnosis: exclude:` – effects that are no candidates
  Tolerance tolerance = {};                   ///< `tolerance:` – what is good enough; optional
  std::optional<ImplantConfig> implant = {};  ///< `implant:` – only read by `blind implant`

  /// What is fitted: the model with its anchor, and with the controller where that estimates.
  ReferenceModel reference_model() const;
  double position_quantum() const;  ///< of the encoder, seen on the axis of x1 [rad]; 0: not given
  InputFacts input_facts() const;
  /// Turns of the encoder of x1 (the motor's) and of that of x2 (the load's), as their gears say.
  ShaftTurns turns() const;
};

/// Reads a configuration strictly: unknown and repeated keys, wrong types, numbers out of range and
/// contradictions are refused, unknown keys with the nearest known one. Recordings are not opened.
/// @param settings  laid over the file in their order; paths in them are relative to its folder, too
/// @throws ConfigError "file:line: what is wrong, what was expected", of a setting "--set KEY: ..."
Configuration load_configuration(const std::string& path, std::span<const Setting> settings = {});

/// The same from text; `file` names it in messages, and paths in it are relative to its folder.
Configuration parse_configuration(const std::string& text, const std::string& file,
                                  std::span<const Setting> settings = {});

/// @throws ConfigError unless the model has all that a fit needs: every parameter of its structure either
/// given or estimated.
void require_reference_model(const Configuration& configuration);

/// @throws ConfigError where an experiment of next_experiment: duration, sampled like a recording, would have
/// more than kMostSimulatedSamples samples.
void require_possible_experiment(const Configuration& configuration, double dt);

/// What the configuration asks of a diagnosis.
DiagnosisOptions diagnosis_options(const Configuration& configuration);

/// The bounds that eq. (13) gives for the model's own numbers.  @throws std::logic_error without
/// `from_model`.
Interval bound_from_model(const Configuration& configuration);

/// What was fitted as a configuration of its own, which `simulate` runs as it is: every number fixed at its
/// fitted value, from the fitted initial state, without noise, under the input of the recording: the
/// excitation of a simulation, else that of the trace named here (columns t_s and u).
/// @param trace relative to where the text will be stored
std::string fit_yaml(const Configuration& configuration, const FitSummary& fit, const std::string& trace,
                     const MotorTrace& recording);

/// A proposed experiment as a configuration that `simulate` runs on one of the rivals' models.
std::string experiment_yaml(const Configuration& configuration, const ReferenceModel& model,
                            const NextExperiment& experiment);

/// The configuration as YAML with every default filled in. It reads back as the same configuration (from the
/// same folder: paths stay as they were given) and gives the same text again.
std::string resolved_yaml(const Configuration& configuration);

/// The same under a heading of its own, a comment of one line; empty: none.
std::string yaml_of(const Configuration& configuration, const std::string& heading);

/// What it says of how a recording is read and in which coordinates: the part of resolved_yaml() that `check`
/// and a stream have.
std::string resolved_reading(const Configuration& configuration);

/// A model as a configuration that `simulate` runs: every number known, its effects included. The
/// excitation is that of the configuration where it simulates, else that of the trace named here (columns t_s
/// and u), from the recording's first position and speed, both bodies alike; a
/// locked load stands in the middle of the recorded positions.
/// @param recording what the trace holds
/// @param trace     relative to where the text will be stored; empty: a sine of the recording's peak and most
///                  frequent zero crossings instead
std::string model_yaml(const Configuration& configuration, const ReferenceModel& model,
                       const std::string& trace, const MotorTrace& recording);

}  // namespace gapscope
