#pragma once

#include <string>
#include <vector>

#include "gapscope/recording/csv.h"

namespace gapscope::internal {

/// The rows of a CSV file as they stand there, with the line of each.
struct CsvTable {
  std::string path;
  std::vector<double> t;     ///< [s], strictly increasing
  std::vector<double> u;     ///< [unit of u]
  std::vector<double> x1;    ///< [rad]
  std::vector<double> x2;    ///< [rad]; empty if the file has none
  std::vector<int> line;     ///< of each row, from 1
  std::vector<int> skipped;  ///< lines of rows that were left out: not later than the row before

  std::size_t size() const { return t.size(); }
  void keep(std::size_t first, std::size_t count);  ///< drops all other rows
};

/// What becomes of a row whose time is not later than that of the row before.
enum class EarlierRow { kRefused, kSkipped };

/// @throws ConfigError, see read_csv().
CsvTable read_table(const std::string& path, const CsvColumns& columns,
                    EarlierRow earlier = EarlierRow::kRefused);

/// The rows of the window, kFewestSamples or more.  @throws ConfigError
CsvTable read_window(const std::string& path, const CsvOptions& options,
                     EarlierRow earlier = EarlierRow::kRefused);

/// Mean time from row to row [s].
double mean_step(const CsvTable& table);

/// The row whose step from the row before is farthest off the mean step.
std::size_t worst_step(const CsvTable& table);

bool is_uniform(const CsvTable& table);

/// The columns as they stand.  @throws ConfigError unless they are uniform
Recording uniform_recording(CsvTable&& table);

}  // namespace gapscope::internal
