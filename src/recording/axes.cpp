#include "recording/axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "base/shown.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "recording/array_file.h"
#include "recording/csv_row.h"
#include "recording/file_kind.h"
#include "recording/recorded_rows.h"

namespace gapscope {
namespace {

using internal::recording::ArrayFile;

constexpr std::size_t kMostAxes = 100;
constexpr std::size_t kCountedAxes = 100'000;  ///< of a table, that the message has their number

/// "q[:, {axis}]" is a column of a table, of which the file says only how many there are.
std::vector<std::string> columns_of_table(ArrayFile& file, const std::string& pattern) {
  const auto open = pattern.find_last_of("[(", pattern.find(kAxisInName));
  if (open == pattern.npos) return {};
  const auto table = file.find(pattern.substr(0, open));
  if (!table || table->size.size() != 2) return {};
  std::vector<std::string> axes;
  const std::size_t first = pattern[open] == '[' ? 0 : 1;
  for (std::size_t i = 0; i < std::min<std::size_t>(table->size[1], kCountedAxes); ++i)
    axes.push_back(std::to_string(first + i));
  return axes;
}

/// What stands in the place of the axis in those of the names that are of the pattern.
std::vector<std::string> matching(const std::vector<std::string>& names, const std::string& pattern) {
  const auto at = pattern.find(kAxisInName);
  const std::string before = pattern.substr(0, at),
                    behind = pattern.substr(at + std::string(kAxisInName).size());
  std::vector<std::string> axes;
  for (const std::string& name : names) {
    if (name.size() <= before.size() + behind.size()) continue;
    if (!name.starts_with(before) || !name.ends_with(behind)) continue;
    const std::string axis = name.substr(before.size(), name.size() - before.size() - behind.size());
    if (axis.find('/') != axis.npos || std::find(axes.begin(), axes.end(), axis) != axes.end()) continue;
    axes.push_back(axis);
  }
  return axes;
}

bool are_numbers(const std::vector<std::string>& axes) {
  return std::all_of(axes.begin(), axes.end(), [](const std::string& axis) {
    return axis.size() < 9 &&
           std::all_of(axis.begin(), axis.end(), [](unsigned char c) { return std::isdigit(c); });
  });
}

}  // namespace

bool names_an_axis(const RecordingColumns& c) {
  return (c.time + c.input + c.position + c.load_position + c.voltage + c.target).find(kAxisInName) !=
         std::string::npos;
}

RecordingColumns columns_of_axis(RecordingColumns c, const std::string& axis) {
  for (std::string* name : {&c.time, &c.input, &c.position, &c.load_position, &c.voltage, &c.target})
    *name = replaced(*name, kAxisInName, axis);
  return c;
}

std::vector<std::string> recorded_names(const std::string& path) {
  internal::recording::require_recording_file(path);
  if (internal::recording::kind_of(path).ending.empty()) return internal::recording::csv_names(path);
  RecordingColumns any;
  any.position.clear();
  return internal::recording::open_arrays(path, any)->names();
}

std::vector<std::string> recorded_axes(const std::string& path, const RecordingColumns& columns) {
  const std::string& pattern = columns.position;
  if (pattern.find(kAxisInName) == pattern.npos)
    throw ConfigError(
        path,
        fmt::format("is asked for all axes, but the position is {}, expected a name with {{axis}} in it",
                    shown(pattern)));
  internal::recording::require_recording_file(path);
  std::vector<std::string> names, axes;
  if (internal::recording::kind_of(path).ending.empty()) {
    names = internal::recording::csv_names(path);
  } else {
    RecordingColumns any = columns;
    any.position.clear();
    const auto file = internal::recording::open_arrays(path, any);
    names = file->names();
    axes = columns_of_table(*file, pattern);
  }
  if (axes.empty()) axes = matching(names, pattern);
  if (axes.empty() || axes.size() > kMostAxes)
    throw ConfigError(path, fmt::format("has {} columns named as {}, expected 1 to {}", axes.size(),
                                        shown(pattern), kMostAxes));
  if (are_numbers(axes))
    std::sort(axes.begin(), axes.end(),
              [](const auto& a, const auto& b) { return std::stoi(a) < std::stoi(b); });
  return axes;
}

}  // namespace gapscope
