#pragma once

#include <optional>
#include <string>

#include "base/file_hash.h"
#include "base/input_facts.h"
#include "diagnosis/simulator.h"
#include "gapscope/base/coordinates.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "results/stored_table.h"
#include "telling/answer.h"

namespace gapscope {

/// All that `diagnose` leaves behind, and all that its report is drawn from.
struct DiagnosisResult {
  std::string name;                              ///< of the configuration
  std::string version;                           ///< of gapscope
  std::string configuration;                     ///< resolved_yaml(), which is stored with its SHA-256
  Coordinates coordinates;                       ///< of a translation: rad and N·m mean m and N
  Diagnosis diagnosis;                           ///< the fitted model is not stored here but in fitted.yaml
  std::vector<FileHash> sources = {};            ///< the configuration and every recording that it names
  std::optional<InputFacts> input = {};          ///< absent where nothing is known of it
  std::vector<std::string> simulated_data = {};  ///< sentences on data that no drive has made
  std::optional<Answer> answer = {};  ///< with the gap of the estimate in the same folder, if there is one
  std::optional<SimulatorComparison> simulated = {};  ///< the user's simulator, where its answer was given
};

/// Writes diagnosis.json and traces/held_out_<n>_<file>.csv into an existing folder. The columns of a trace
/// are t_s, u, x1_rad, error_before_rad, error_after_rad, torque_before_nm, torque_after_nm,
/// simulated_before_rad, simulated_after_rad and mode.
/// @throws std::runtime_error naming what cannot be written.
void write_diagnosis_result(const std::string& folder, const DiagnosisResult& result);

/// The same in memory: the bytes of diagnosis.json, and the traces as tables.
StoredResult stored_diagnosis_result(const DiagnosisResult& result);

/// Reads back what write_diagnosis_result() wrote.  @throws ConfigError for another schema or a damaged file.
DiagnosisResult read_diagnosis_result(const std::string& folder);

/// Where a report keeps its held-out traces: "traces/held_out_1_run.csv".
std::string held_out_trace_name(std::size_t index, const std::string& recording_file);

/// Where a report keeps the table of a law of last resort: "compensation_friction_curve.csv".
std::string compensation_name(const LastResortLaw& law);

/// The table that a drive's feed-forward takes: the abscissa (speed_rad_s, position_rad or input),
/// compensation_nm, what is to be added to the motor's torque there, and its 95 % interval. At standstill a
/// friction has two rows, backward first.
std::string compensation_csv(const LastResortLaw& law);

/// Columns t [s] and u of the proposed input, as CSV.
std::string input_csv(const NextExperiment& experiment);

}  // namespace gapscope
