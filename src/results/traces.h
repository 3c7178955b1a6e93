#pragma once

#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "results/run_result.h"
#include "results/stored_table.h"

namespace gapscope::internal::results {

/// What the columns of a trace file come from and go to: one recording, and what the estimators said about
/// it.
struct TraceSet {
  Recording recording;  ///< start, dt and the texts are the caller's, the columns are in the file
  ErrorTrace error;     ///< empty columns where there is none
  FitTrace fit;
  /// Of a diagnosis: errors of restarted free runs [rad] and correcting torques [N m].
  std::vector<double> error_before, error_after, torque_before, torque_after;
  /// Of a user's simulator, of the model that stands in for it, and of that one with its first row mended
  /// [rad].
  std::vector<double> simulator = {}, stand_in = {}, mended = {};
  /// What u was made of by a controller: the target [rad], and the supply that multiplies its output [V].
  std::vector<double> target = {}, supply = {};
  /// Of a diagnosis: positions of the model from the first sample on, without and with what was added [rad].
  std::vector<double> simulated_before = {}, simulated_after = {};
};

/// Writes the filled columns only; an undefined number is an empty field.  @throws std::runtime_error
void write_trace(const std::string& path, const TraceSet& set);

/// The same columns in memory, the samples moved into them.
std::vector<StoredColumn> columns_of(TraceSet set);

/// Is given each trace of a result and the name of its file.
using TraceSink = std::function<void(const std::string& name, TraceSet set)>;

/// Writes each into its file below the folder.
TraceSink into_folder(const std::string& folder);

/// Keeps each as a table.
TraceSink into_tables(std::vector<StoredTable>& tables);

/// Where a trace that a stored result names is.  @throws ConfigError for a place outside the folder's traces.
std::string trace_path(const std::string& folder, const std::string& name);

/// A stored table to read from.  @throws ConfigError unless it is a regular file of a size that is stored
std::ifstream open_table(const std::string& path, const char* what);

/// Fills the columns of a set.  @throws ConfigError with file and line for a damaged file.
void read_trace(const std::string& path, TraceSet& set);

/// A map of bounds as a table of |e_x|/floor: a row for each column of time, a field for each bound.
inline constexpr const char* kBoundMapName = "bound_map.csv";

/// @throws std::runtime_error
void write_bound_map(const std::string& path, const BoundMap& map);

/// Fills the levels of a map whose bounds are known.  @throws ConfigError for a damaged file.
void read_bound_map(const std::string& path, BoundMap& map);

}  // namespace gapscope::internal::results
