#include "commands/axis.h"

#include <fmt/format.h>

#include <set>

#include "base/plain_name.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/axes.h"

namespace gapscope {
namespace {

/// Each axis has a folder of its own, below that of the machine.
void require_own_folders(const std::vector<std::string>& axes) {
  std::set<std::string> folders;
  for (const std::string& axis : axes) {
    const std::string folder = plain_part(axis);
    if (!is_plain_name(folder))
      throw ConfigError(
          fmt::format("gapscope: --axis: the axis {} can have no folder, expected a name of at most "
                      "100 characters that begins with a letter, a digit or _",
                      shown(axis)));
    if (!folders.insert(folder).second)
      throw ConfigError(
          fmt::format("gapscope: --axis all: two axes would share the folder {}, expected one of "
                      "them behind --axis",
                      folder));
  }
}

}  // namespace

std::vector<std::string> asked_axes(const std::string& axis, const std::string& file,
                                    const RecordingColumns& columns) {
  if (axis.empty()) return {};
  if (!names_an_axis(columns))
    throw ConfigError(
        fmt::format("gapscope: --axis is {}, expected {} in the names of the columns, as in --position "
                    "{}.position or \"q[:, {}]\"",
                    shown(axis), kAxisInName, kAxisInName, kAxisInName));
  std::vector<std::string> axes =
      axis == kAllAxes ? recorded_axes(file, columns) : std::vector<std::string>{axis};
  require_own_folders(axes);
  return axes;
}

Configuration of_axis(Configuration c, const std::string& axis) {
  if (!c.recording || axis == kAllAxes)
    throw ConfigError(c.file,
                      "is taken for one axis at a time, expected its name behind --axis and a recording:");
  asked_axes(axis, "", c.recording->reading.columns);
  c.recording->reading.columns = columns_of_axis(c.recording->reading.columns, axis);
  return c;
}

}  // namespace gapscope
