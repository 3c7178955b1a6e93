#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/array_file.h"
#include "recording/limits.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

struct Column {
  std::string name;
  std::vector<double> values;  ///< SI
};

Column read_column(ArrayFile& file, const std::string& path, const std::string& name,
                   const UnitScale& scale) {
  Column column{name, vector_of(file, path, name)};
  for (double& value : column.values) value = scale(value);
  return column;
}

Column at_rate(double rate, std::size_t rows) {
  Column time{"row", std::vector<double>(rows)};
  for (std::size_t i = 0; i < rows; ++i) time.values[i] = static_cast<double>(i) / rate;
  return time;
}

void require_length(const ArrayFile& file, const std::string& path, const Column& column,
                    const Column& time) {
  if (column.values.size() == time.values.size()) return;
  throw ConfigError(path, fmt::format("the {} '{}' has {} values, expected {} as in '{}'", file.noun(),
                                      column.name, column.values.size(), time.values.size(), time.name));
}

void append(std::vector<double>& to, const Column& column, std::size_t i, RecordedRows& rows) {
  const double value = column.values[i];
  const auto sample = static_cast<std::int64_t>(i) + 1;
  if (std::isinf(value))
    rows.fail(sample, fmt::format("{} is {}, expected a finite number", column.name, value));
  if (std::abs(value) > kLargestNumber)
    rows.fail(sample,
              fmt::format("{} is {}, expected at most {:g} in size", column.name, value, kLargestNumber));
  const auto is_of_it = [&](const BlankField& blank) { return blank.column == column.name; };
  if (std::isnan(value) && std::none_of(rows.blanks.begin(), rows.blanks.end(), is_of_it))
    rows.blanks.push_back({sample, column.name, "nan"});
  to.push_back(value);
}

}  // namespace

RecordedRows read_arrays(ArrayFile& file, const std::string& path, const RecordingColumns& columns,
                         EarlierRow earlier) {
  const auto column = [&](const std::string& name, const UnitScale& scale) {
    return read_column(file, path, name, scale);
  };
  const ColumnScales& scales = columns.scales;
  Column t = columns.rate > 0.0 ? Column{} : column(columns.time, scales.time);
  const bool has_input = columns.input_column == InputColumn::kRequired ||
                         (columns.input_column == InputColumn::kOptional && has_vector(file, columns.input));
  Column u = has_input ? column(columns.input, scales.input) : Column{};
  const bool has_target = !columns.target.empty();
  const Column target = has_target ? column(columns.target, scales.position) : Column{};
  const Column x1 = column(columns.position, scales.position);
  if (columns.rate > 0.0) t = at_rate(columns.rate, x1.values.size());
  const std::string& load = columns.load_position;
  const bool has_load = !load.empty() && (columns.load_position_required || has_vector(file, load));
  const Column x2 = has_load ? column(load, scales.load_position) : Column{};
  Column supply{"supply", std::vector<double>(t.values.size(), 1.0)};
  if (has_input) require_length(file, path, u, t);
  require_length(file, path, x1, t);
  if (has_load) require_length(file, path, x2, t);
  if (!columns.voltage.empty() && (has_input || has_target)) {
    supply = column(columns.voltage, scales.voltage);
    require_length(file, path, supply, t);
    for (std::size_t i = 0; i < u.values.size(); ++i) u.values[i] *= supply.values[i];
  }
  if (has_target) require_length(file, path, target, t);
  RecordedRows rows;
  rows.path = path;
  rows.row = file.row();
  rows.has_input = has_input;
  for (std::size_t i = 0; i < t.values.size(); ++i) {
    const auto sample = static_cast<std::int64_t>(i) + 1;
    if (std::isnan(t.values[i])) {
      rows.leave_out({sample, t.name, "nan"});
      continue;
    }
    if (!rows.admits(t.values[i], sample, earlier, t.name)) continue;
    append(rows.t, t, i, rows);
    if (has_input)
      append(rows.u, u, i, rows);
    else
      rows.u.push_back(kNaN);
    append(rows.x1, x1, i, rows);
    if (has_load) append(rows.x2, x2, i, rows);
    if (has_target) append(rows.target, target, i, rows), append(rows.supply, supply, i, rows);
    rows.line.push_back(sample);
  }
  settle_blanks(rows);
  return rows;
}

}  // namespace gapscope::internal::recording
