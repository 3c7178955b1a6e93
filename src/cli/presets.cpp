#include "cli/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "gapscope/base/text.h"
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

const DrivePreset* preset_of(const RecordingArguments& a) {
  return std::find_if(std::begin(kPresets), std::end(kPresets),
                      [&](const DrivePreset& p) { return a.preset == p.name; });
}

bool is_among(const std::string& name, const char* names) { return contains(alternatives(names), name); }

/// Whether the input is the quantity that the preset speaks of.
bool has_its_input(const RecordingArguments& a, const DrivePreset& p) {
  return a.target.empty() && (a.input.empty() || is_among(a.input, p.input));
}

/// "--input-unit 0.00113 --input-register 16 --voltage COLUMN --voltage-unit 0.1": what was not given of it
std::string options_of_input(const RecordingArguments& a, const DrivePreset& p) {
  std::string text;
  const bool recorded = a.target.empty();
  if (recorded && a.units.input.empty()) text += fmt::format(" --input-unit {}", p.input_unit);
  if (recorded && a.registers.input == 0 && p.input_register > 0)
    text += fmt::format(" --input-register {}", p.input_register);
  if (*p.voltage != '\0' && a.voltage.empty()) text += " --voltage COLUMN";
  if (*p.voltage != '\0' && a.units.voltage.empty())
    text += fmt::format(" --voltage-unit {}", p.voltage_unit);
  return text.empty() ? text : text.substr(1);
}

}  // namespace

std::span<const DrivePreset> drive_presets() { return kPresets; }

RecordingArguments with_preset(RecordingArguments a) {
  if (a.preset.empty()) return a;
  const DrivePreset* const preset = preset_of(a);
  const auto there = recorded_names(a.file);
  const auto column = [&](std::string& given, const char* names, const char* option) {
    if (given.empty() && *names != '\0') given = column_of(names, there, a, option);
  };
  if (a.time == "t") a.time.clear();
  column(a.time, preset->time, "--time");
  if (has_its_input(a, *preset)) {
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

std::string preset_banner(const RecordingArguments& a) {
  if (a.preset.empty()) return "";
  const DrivePreset& p = *preset_of(a);
  return has_its_input(a, p) ? fmt::format("{}; {}", p.what, p.note) : p.what;
}

std::vector<std::string> preset_remarks(const RecordingArguments& a) {
  std::vector<std::string> remarks;
  if (a.preset.empty()) return remarks;
  const DrivePreset& p = *preset_of(a);
  if (const std::string left = options_of_input(a, p); !has_its_input(a, p) && !left.empty())
    remarks.push_back(
        a.target.empty()
            ? fmt::format(
                  "the preset {} knows the unit of {}, not of {}: u is read as it stands. Where it is "
                  "the same register, add {}",
                  p.name, fmt::join(alternatives(p.input), ", "), shown(a.input), left)
            : fmt::format("the preset {} says nothing of what a controller makes of {}: its supply is not "
                          "read. Where the controller sets a duty, add {}",
                          p.name, shown(a.target), left));
  if (!a.position.empty() && a.units.position.empty() && !is_among(a.position, p.position))
    remarks.push_back(
        fmt::format("{} is read in {}, as the preset {} has it for {}: --position-unit if it is another",
                    shown(a.position), p.position_unit, p.name, fmt::join(alternatives(p.position), ", ")));
  if (!a.voltage.empty() && a.units.voltage.empty() && *p.voltage != '\0' && !is_among(a.voltage, p.voltage))
    remarks.push_back(
        fmt::format("{} is read in units of {} V, as the preset {} has it: --voltage-unit if they are others",
                    shown(a.voltage), p.voltage_unit, p.name));
  return remarks;
}

}  // namespace gapscope::cli
