#include "recording/recorded_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/input_file.h"
#include "gapscope/base/errors.h"
#include "recording/axes.h"
#include "recording/file_kind.h"
#include "recording/limits.h"

namespace gapscope::internal::recording {
namespace {

template <class T>
void keep_part(std::vector<T>& values, std::size_t first, std::size_t count) {
  if (values.empty()) return;
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  values = std::vector<T>(begin, begin + static_cast<std::ptrdiff_t>(count));
}

std::string expected_of(const std::string& path) {
  return fmt::format("a recording as {}", kind_of(path).called);
}

}  // namespace

void RecordedRows::keep(std::size_t first, std::size_t count) {
  for (auto* column : {&t, &u, &x1, &x2, &target, &supply}) keep_part(*column, first, count);
  keep_part(line, first, count);
  command_first += first;
}

void RecordedRows::leave_out(BlankField time) {
  if (without_time++ == 0) blanks.push_back(std::move(time));
}

void RecordedRows::reverse() {
  for (auto* column : {&t, &u, &x1, &x2, &target, &supply}) std::reverse(column->begin(), column->end());
  std::reverse(line.begin(), line.end());
  newest_first = false;
}

void RecordedRows::shift_time(double by) {
  for (double& time : t) time += by;
}

bool RecordedRows::admits(double time, std::int64_t of_line, EarlierRow earlier, const std::string& column) {
  const bool goes_on = t.empty() || (newest_first ? time < t.back() : time > t.back());
  if (!goes_on && earlier == EarlierRow::kSkipped) {
    skipped.push_back(of_line);
    return false;
  }
  if (!goes_on)
    fail(of_line, fmt::format("{} goes from {} to {} s, expected time that increases from row to row", column,
                              t.back(), time));
  if (size() == kMostSamples)
    fail(of_line, fmt::format("more than {} rows, expected at most that many", kMostSamples));
  return true;
}

void RecordedRows::fail(std::int64_t of_line, const std::string& what) const {
  if (row == "line") throw ConfigError(path, of_line, what);
  throw ConfigError(path, place(of_line) + ": " + what);
}

std::string RecordedRows::place(std::int64_t of_line) const { return fmt::format("{} {}", row, of_line); }

RecordedRows read_rows(const std::string& path, const RecordingColumns& columns, EarlierRow earlier) {
  require_recording_file(path);
  if (names_an_axis(columns))
    throw ConfigError(path,
                      fmt::format("has several axes: {} is in the names of its columns, expected --axis NAME "
                                  "(or all) beside them",
                                  kAxisInName));
  if (kind_of(path).ending.empty()) return read_csv(path, columns, earlier);
  return read_arrays(*open_arrays(path, columns), path, columns, earlier);
}

void require_recording_file(const std::string& path) {
  require_input_file(path, expected_of(path));
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  if (bytes > kMostBytes)
    throw ConfigError(path, fmt::format("has {:.3g} bytes, expected at most {:.3g}",
                                        static_cast<double>(bytes), static_cast<double>(kMostBytes)));
}

std::ifstream open_recording_file(const std::string& path) {
  return open_input_file(path, expected_of(path));
}

}  // namespace gapscope::internal::recording
