#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "recording/file_kind.h"
#include "recording/recorded_rows.h"

namespace gapscope {
namespace internal::recording {

Numbers column_numbers(const std::string& path, const std::string& name, const RecordingColumns& columns) {
  require_recording_file(path);
  if (!kind_of(path).ending.empty()) return vector_of(*open_arrays(path, columns), path, name);
  RecordingColumns alone;
  alone.time = columns.time, alone.rate = columns.rate, alone.scales.time = columns.scales.time;
  alone.position = name, alone.position_named = true;
  alone.load_position.clear();
  alone.input_column = InputColumn::kNone;
  return read_rows(path, alone).x1;
}

}  // namespace internal::recording

double number_of_file(const std::string& path, const std::string& name, const RecordingColumns& columns) {
  const std::vector<double> values = internal::recording::column_numbers(path, name, columns);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (low == values.end() || !std::isfinite(*low) || !std::isfinite(*high))
    throw ConfigError(path, fmt::format("{} has no number, expected one for the whole file", shown(name)));
  if (*low != *high)
    throw ConfigError(path, fmt::format("{} goes from {:g} to {:g}, expected one number for the whole file",
                                        shown(name), *low, *high));
  return *low;
}

}  // namespace gapscope
