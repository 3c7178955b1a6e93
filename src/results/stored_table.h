#pragma once

#include <string>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope {

/// A column of a table that a result is stored with.
struct StoredColumn {
  std::string name;             ///< with its unit: "e_x_rad"
  std::vector<double> numbers;  ///< NaN: an empty field; none in a column of modes
  std::vector<Mode> modes;      ///< none in a column of numbers
};

/// A trace as a folder would have it; all columns are equally long.
struct StoredTable {
  std::string name;  ///< of its file there: "traces/1_train.csv"
  std::vector<StoredColumn> columns;
};

/// A result with its traces, in memory: what else is written into a folder.
struct StoredResult {
  std::string json;  ///< the bytes of the file
  std::vector<StoredTable> traces;
};

}  // namespace gapscope
