#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/file_hash.h"
#include "base/input_facts.h"
#include "diagnosis/comparison.h"
#include "diagnosis/second_encoder.h"
#include "gapscope/base/coordinates.h"
#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit_summary.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "results/stored_table.h"
#include "telling/answer.h"

namespace gapscope {

/// All that `run`, `detect` and `fit` leave behind, and all that a report is drawn from.
struct RunResult {
  std::string name;                             ///< of the configuration
  std::string version;                          ///< of gapscope
  std::string configuration;                    ///< resolved_yaml(), which is stored with its SHA-256
  std::vector<FileHash> sources;                ///< the configuration and every recording that it names
  Coordinates coordinates;                      ///< of a translation: rad and N·m mean m and N
  std::optional<Answer> answer;                 ///< absent in files that were written before it was stored
  std::optional<GapEstimate> model_free;        ///< absent: not asked for (`fit`)
  std::optional<GapEstimate> literal = {};      ///< S1 to S6 as printed, beside these; absent: not asked for
  std::optional<FitSummary> reference;          ///< absent: not asked for (`detect`)
  std::optional<Comparison> comparison;         ///< absent unless both were asked for
  std::optional<SecondEncoder> second_encoder;  ///< absent unless one on the load validates
  double simulated_gap = kNaN;                  ///< 2β of the simulated plant [rad]; NaN for recorded data
  std::vector<Recording> recordings;            ///< stored as traces, not in the JSON
  std::optional<InputFacts> input = {};         ///< absent where nothing is known of it
  /// Sentences on data that no drive has made; empty: none known.
  std::vector<std::string> simulated_data = {};
  std::vector<Doubt> doubts = {};  ///< of the recordings, as check finds them, for what the answer rests on
  std::vector<std::string> notes;  ///< what was done to the data, readings of the configuration
};

/// Wall times; the only stored result that is not a function of input, seed and version.
struct Timing {
  double model_free_s = kNaN;
  double literal_s = kNaN;
  double reference_s = kNaN;
  double wall_s = kNaN;  ///< of both estimators, which run side by side: less than their sum
};

/// Where the columns of a recording are stored: "traces/3_train.csv" for the third, of a file train.csv.
std::string trace_name(std::size_t index, const std::string& recording_file);

/// Writes result.json, traces/<n>_<file>.csv and, where a bank of bounds was run, traces/bound_map.csv (a row
/// for each column of time, a field for each bound: |e_x| over its floor) into an existing folder. The
/// columns of a trace are t_s, u, x1_rad, x2_rad, e_x_rad, w1_hat_rad_s, fit_x1_rad, fit_predicted_x1_rad
/// (where the encoder is on the load fit_predicted_x2_rad), fit_x2_rad, mode, fit_mode, those that are
/// filled. Numbers come out shortest and read back the same. Returned is the result without its samples
/// (recordings and traces): moved in, a long recording is held once.
/// @throws std::runtime_error naming what cannot be written.
RunResult write_run_result(const std::string& folder, RunResult result);
/// The same in memory: the bytes of result.json, and the traces as tables. Samples are moved.
StoredResult stored_run_result(RunResult result);

void write_timing(const std::string& folder, const Timing& timing);

/// Reads back exactly what write_run_result() wrote.  @throws ConfigError for another schema or a damaged
/// file.
RunResult read_run_result(const std::string& folder);
Timing read_timing(const std::string& folder);  ///< NaN where there is none

}  // namespace gapscope
