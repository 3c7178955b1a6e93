#include "cli/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/shown.h"
#include "base/text.h"
#include "recording/axes.h"
#include "recording/column_name.h"

namespace gapscope::cli {
namespace {

const DrivePreset kPresets[] = {
#include "cli/presets.inc"
};

/// A name that a column may have, and its unit where that is not the column's.
struct Alternative {
  std::string name, unit;
};

std::vector<Alternative> alternatives_of(const std::string& names) {
  std::vector<Alternative> all;
  for (std::size_t at = 0, end; at < names.size(); at = end + 1) {
    end = std::min(names.find('|', at), names.size());
    const std::string one = names.substr(at, end - at);
    const std::size_t sign = std::min(one.find('='), one.size());
    all.push_back({one.substr(0, sign), one.substr(std::min(sign + 1, one.size()))});
  }
  return all;
}

std::vector<std::string> alternatives(const std::string& names) {
  std::vector<std::string> all;
  for (const Alternative& a : alternatives_of(names)) all.push_back(a.name);
  return all;
}

/// Whether two names are of the same words: "Present Load" and "present_load", "pos" and "pos (1)".
bool is_same(const std::string& column, const std::string& name) {
  const auto words = [](const std::string& of) {
    return words_of_name(of.substr(0, of.find_first_of("[(", 1)));
  };
  return column == name || words(column) == words(name);
}

/// The unit of a column of that name; the preset's for it, unless that name has one of its own.
std::string unit_of(const std::string& name, const char* names, const char* unit) {
  for (const Alternative& a : alternatives_of(names))
    if (is_same(name, a.name) && !a.unit.empty()) return a.unit;
  return unit;
}

/// The first of these names that the file has, to the letter or else in its words; empty where it has none.
std::string found_of(const char* names, const std::vector<std::string>& there) {
  const auto all = alternatives(names);
  for (const std::string& name : all)
    if (contains(there, name)) return name;
  for (const std::string& name : all)
    for (const std::string& column : there)
      if (is_same(column, name)) return column;
  return "";
}

const DrivePreset* preset_of(const RecordingArguments& a) {
  return std::find_if(std::begin(kPresets), std::end(kPresets),
                      [&](const DrivePreset& p) { return a.preset == p.name; });
}

bool is_among(const std::string& name, const char* names) {
  const auto all = alternatives(names);
  return std::any_of(all.begin(), all.end(), [&](const std::string& known) { return is_same(name, known); });
}

/// Whether the input is the quantity that the preset speaks of.
bool has_its_input(const RecordingArguments& a, const DrivePreset& p) {
  return a.target.empty() && (a.input.empty() || is_among(a.input, p.input));
}

/// "--input-unit 0.00113 --input-register 16 --voltage COLUMN --voltage-unit 0.1": what was not given of it
std::string options_of_input(const RecordingArguments& a, const DrivePreset& p) {
  std::string text;
  const bool recorded = a.target.empty();
  if (recorded && a.units.input.empty()) text += fmt::format(" --input-unit {}", p.input_unit);
  if (recorded && !a.registers.input.is_one() && a.input_register.empty() && p.input_register > 0)
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
  const auto column = [&](std::string& given, const char* names) {
    if (given.empty()) given = found_of(names, there);
  };
  if (a.time == "t") a.time.clear();
  column(a.time, preset->time);
  if (a.target.empty()) column(a.input, preset->input);
  column(a.position, preset->position);
  if (!a.input.empty() && has_its_input(a, *preset)) {
    column(a.voltage, preset->voltage);
    if (a.units.input.empty()) a.units.input = unit_of(a.input, preset->input, preset->input_unit);
    if (!a.registers.input.is_one() && a.input_register.empty())
      a.registers.input.bits = preset->input_register;
  }
  if (a.time.empty()) a.time = "t";
  if (a.units.time.empty() && is_among(a.time, preset->time)) a.units.time = preset->time_unit;
  if (a.units.position.empty() && !a.position.empty())
    a.units.position = unit_of(a.position, preset->position, preset->position_unit);
  if (a.units.voltage.empty() && !a.voltage.empty())
    a.units.voltage = unit_of(a.voltage, preset->voltage, preset->voltage_unit);
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
  const auto there = recorded_names(a.file);
  if (a.input.empty() && a.target.empty() && found_of(p.input, there).empty()) {
    remarks.push_back(
        fmt::format("the preset {} knows {} as the input, which is not there: what is taken in its "
                    "place is read as it stands",
                    p.name, fmt::join(alternatives(p.input), ", ")));
    return remarks;
  }
  if (has_its_input(a, p) && a.voltage.empty() && *p.voltage != '\0' && found_of(p.voltage, there).empty())
    remarks.push_back(
        "there is no voltage of the supply: u is the duty alone (--voltage NAME where a column has it)");
  if (has_its_input(a, p) && a.units.input.empty()) {
    const std::string input = a.input.empty() ? found_of(p.input, there) : a.input;
    if (unit_of(input, p.input, p.input_unit) != p.input_unit)
      remarks.push_back(fmt::format("{} is read as {}", shown(input), p.other_unit));
  }
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
