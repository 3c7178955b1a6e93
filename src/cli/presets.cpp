#include "cli/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "gapscope/recording/axes.h"

namespace gapscope::cli {
namespace {

const DrivePreset kPresets[] = {
#include "cli/presets.inc"
};

std::vector<std::string> alternatives(const std::string& names) {
  std::vector<std::string> all;
  for (std::size_t at = 0, end; at < names.size(); at = end + 1) {
    end = std::min(names.find('|', at), names.size());
    all.push_back(names.substr(at, end - at));
  }
  return all;
}

/// The first of these names that the file has.  @throws ConfigError where it has none
std::string column_of(const std::string& names, const std::vector<std::string>& there,
                      const RecordingArguments& a, const char* option) {
  const auto all = alternatives(names);
  for (const std::string& name : all)
    if (std::find(there.begin(), there.end(), name) != there.end()) return name;
  throw ConfigError(a.file,
                    fmt::format("has no column {}, expected one of them for the preset {}, or its own name "
                                "behind {}",
                                fmt::join(all, ", "), a.preset, option));
}

}  // namespace

std::span<const DrivePreset> drive_presets() { return kPresets; }

RecordingArguments with_preset(RecordingArguments a) {
  if (a.preset.empty()) return a;
  const auto preset = std::find_if(std::begin(kPresets), std::end(kPresets),
                                   [&](const DrivePreset& p) { return a.preset == p.name; });
  const auto there = recorded_names(a.file);
  const auto column = [&](std::string& given, const char* names, const char* option) {
    if (given.empty() && *names != '\0') given = column_of(names, there, a, option);
  };
  if (a.time == "t") a.time.clear();
  column(a.time, preset->time, "--time");
  const bool own_input = !a.input.empty() || !a.target.empty();
  if (!own_input) {
    column(a.input, preset->input, "--input");
    column(a.voltage, preset->voltage, "--voltage");
    if (a.units.input.empty()) a.units.input = preset->input_unit;
    if (a.registers.input == 0) a.registers.input = preset->input_register;
  }
  column(a.position, preset->position, "--position");
  if (a.units.time.empty()) a.units.time = preset->time_unit;
  if (a.units.position.empty()) a.units.position = preset->position_unit;
  if (a.units.voltage.empty() && !a.voltage.empty()) a.units.voltage = preset->voltage_unit;
  if (a.bits == 0) a.bits = preset->bits;
  return a;
}

}  // namespace gapscope::cli
