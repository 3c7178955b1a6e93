#pragma once

#include <string>
#include <vector>

#include "gapscope/recording/csv.h"

namespace gapscope::internal {

/// The rows of a CSV file as they stand there, with the line of each.
struct CsvTable {
  std::string path;
  std::vector<double> t;   ///< [s], strictly increasing
  std::vector<double> u;   ///< [unit of u]
  std::vector<double> x1;  ///< [rad]
  std::vector<double> x2;  ///< [rad]; empty if the file has none
  std::vector<int> line;   ///< of each row, from 1

  std::size_t size() const { return t.size(); }
  void keep(std::size_t first, std::size_t count);  ///< drops all other rows
};

/// @throws ConfigError, see read_csv().
CsvTable read_table(const std::string& path, const CsvColumns& columns);

/// What a message shows of a text from a file: the first characters, in quotes, printable.
std::string shown(std::string_view text);

}  // namespace gapscope::internal
