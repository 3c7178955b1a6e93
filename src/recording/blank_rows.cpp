// Rows in which a column has no number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shown.h"
#include "gapscope/base/statistics.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

constexpr std::size_t kBridged = 2;  ///< blanks in a row that are drawn over
constexpr double kOwnRows = 0.1;     ///< share of blanks from which on a column has rows of its own

double share_of_blanks(const Numbers& column) {
  if (column.empty()) return 0.0;
  const auto blank = std::count_if(column.begin(), column.end(), [](double v) { return std::isnan(v); });
  return static_cast<double>(blank) / static_cast<double>(column.size());
}

/// Draws lines over short blanks between numbers, or holds the number before them.
/// @returns how many
std::size_t bridge_blanks(const Numbers& t, bool held, Numbers& column) {
  std::size_t bridged = 0;
  for (std::size_t i = 1; i < column.size(); ++i) {
    if (!std::isnan(column[i]) || std::isnan(column[i - 1])) continue;
    std::size_t end = i;
    while (end < column.size() && std::isnan(column[end])) ++end;
    if (end == column.size() || end - i > kBridged) continue;
    const double from = column[i - 1], slope = (column[end] - from) / (t[end] - t[i - 1]);
    for (std::size_t j = i; j < end; ++j, ++bridged)
      column[j] = held ? from : from + slope * (t[j] - t[i - 1]);
  }
  return bridged;
}

/// The last number at or before each of the rows; NaN before the first.
Numbers held_at(const Numbers& t, const Numbers& values, const Numbers& rows) {
  Numbers out;
  std::size_t i = 0;
  double last = kNaN;
  for (const double time : rows) {
    for (; i < t.size() && t[i] <= time; ++i)
      if (!std::isnan(values[i])) last = values[i];
    out.push_back(last);
  }
  return out;
}

/// The mean over the time from each row to the next of what is held from its own time on, so that its impulse
/// stays.
Numbers means_over(const Numbers& t, const Numbers& values, const Numbers& rows) {
  Numbers out = held_at(t, values, rows);
  std::size_t i = 0;
  for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
    double from = rows[row], level = out[row], impulse = 0.0;
    while (i < t.size() && t[i] <= rows[row]) ++i;
    for (; i < t.size() && t[i] < rows[row + 1]; ++i) {
      if (std::isnan(values[i])) continue;
      impulse += level * (t[i] - from);
      from = t[i], level = values[i];
    }
    if (from > rows[row]) out[row] = (impulse + level * (rows[row + 1] - from)) / (rows[row + 1] - rows[row]);
  }
  return out;
}

/// On a line between the numbers before and after.
Numbers drawn_at(const Numbers& t, const Numbers& values, const Numbers& rows) {
  Numbers times, numbers, out;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (!std::isnan(values[i])) times.push_back(t[i]), numbers.push_back(values[i]);
  std::size_t i = 0;
  for (const double time : rows) {
    while (i + 1 < times.size() && times[i + 1] <= time) ++i;
    const bool within = i + 1 < times.size() && time >= times[i];
    const bool at = !times.empty() && time == times[i];
    out.push_back(at       ? numbers[i]
                  : within ? numbers[i] +
                                 (numbers[i + 1] - numbers[i]) * (time - times[i]) / (times[i + 1] - times[i])
                           : kNaN);
  }
  return out;
}

/// Brings all columns to the rows that have a position.
void take_rows_of_position(RecordedRows& table) {
  RecordedRows at;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (!std::isnan(table.x1[i]))
      at.t.push_back(table.t[i]), at.x1.push_back(table.x1[i]), at.line.push_back(table.line[i]);
  if (table.has_input)
    at.u = means_over(table.t, table.u, at.t);
  else
    at.u.assign(at.t.size(), kNaN);
  if (!table.x2.empty()) at.x2 = drawn_at(table.t, table.x2, at.t);
  if (!table.target.empty()) at.target = held_at(table.t, table.target, at.t);
  if (!table.supply.empty()) at.supply = held_at(table.t, table.supply, at.t);
  table.t = std::move(at.t), table.u = std::move(at.u), table.x1 = std::move(at.x1),
  table.x2 = std::move(at.x2);
  table.target = std::move(at.target), table.supply = std::move(at.supply), table.line = std::move(at.line);
}

/// @returns how many rows with a blank were dropped
std::size_t drop_blank_rows(RecordedRows& table) {
  const bool has_input = table.has_input;
  std::size_t kept = 0;
  const auto blank = [](const Numbers& column, std::size_t i) {
    return !column.empty() && std::isnan(column[i]);
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    if ((has_input && blank(table.u, i)) || blank(table.x1, i) || blank(table.x2, i) ||
        blank(table.target, i) || blank(table.supply, i))
      continue;
    for (Numbers* column : {&table.t, &table.u, &table.x1, &table.x2, &table.target, &table.supply})
      if (!column->empty()) (*column)[kept] = (*column)[i];
    table.line[kept++] = table.line[i];
  }
  const std::size_t dropped = table.size() - kept;
  for (Numbers* column : {&table.t, &table.u, &table.x1, &table.x2, &table.target, &table.supply})
    if (!column->empty()) column->resize(kept);
  table.line.resize(kept);
  return dropped;
}

}  // namespace

void settle_blanks(RecordedRows& table) {
  if (table.blanks.empty()) return;
  const BlankField first = table.blanks.front();
  const bool own_rows = std::max({share_of_blanks(table.x1), table.has_input ? share_of_blanks(table.u) : 0.0,
                                  share_of_blanks(table.x2), share_of_blanks(table.target)}) > kOwnRows;
  std::size_t bridged = 0;
  if (own_rows) {
    const std::size_t all = table.size();
    take_rows_of_position(table);
    table.assumed.emplace_back(
        "table.topics", "columns that are filled in turn, brought to the {} of {} rows that have a position",
        std::vector<Remark::Value>{static_cast<long>(table.size()), static_cast<long>(all)});
  } else {
    bridged = bridge_blanks(table.t, false, table.x1) + bridge_blanks(table.t, false, table.x2) +
              bridge_blanks(table.t, true, table.u) + bridge_blanks(table.t, true, table.target) +
              bridge_blanks(table.t, true, table.supply);
  }
  const std::size_t dropped = table.without_time + drop_blank_rows(table);
  if (table.size() < kFewestSamples)
    table.fail(
        first.line,
        fmt::format("{} is {}, expected a finite number{}", first.column,
                    first.text.empty() ? "empty" : shown(first.text),
                    table.size() > 0 ? fmt::format(" ({} rows have one in each column)", table.size()) : ""));
  if (bridged > 0)
    table.assumed.emplace_back(
        "rows.bridged", "blank fields drawn over: {}, the first in {}",
        std::vector<Remark::Value>{static_cast<long>(bridged), table.place(first.line)});
  if (dropped > 0)
    table.assumed.emplace_back(
        "rows.left_out", "rows without numbers left out: {}, the first in {}",
        std::vector<Remark::Value>{static_cast<long>(dropped), table.place(first.line)});
}

}  // namespace gapscope::internal::recording
