#include "campaign/axis_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "base/text.h"
#include "gapscope/plant/drive.h"
#include "gapscope/plant/effect.h"

namespace gapscope::internal::campaign {
namespace {

const std::map<std::string, AxisName>& plain_names() {
  static const std::map<std::string, AxisName> names = {
      {"simulation.rate", {"sampling rate", "Hz"}},
      {"simulation.duration", {"duration", "s"}},
      {"simulation.noise", {"noise", "rad"}},
      {"simulation.plant", {"plant code", ""}},
      {"recording.file", {"recording", ""}},
      {"recording.resample.rate", {"sampling rate", "Hz"}},
      {"encoder.bits", {"resolution", "bit"}},
      {"encoder.quantum", {"quantum", "rad"}},
      {"detector.bound", {"bound L", "rad/s²"}},
      {"detector.literal", {"L as printed", "rad/s²"}},
      {"simulation.model.effects", {"what the plant has more", ""}},
  };
  return names;
}

/// The drive parameter that a path such as simulation.model.parameters.gap.value leads to; nullptr for
/// another.
const DriveParameterSpec* drive_parameter_at(const std::string& path) {
  const std::size_t begin = path.find("model.parameters.");
  if (begin == path.npos) return nullptr;
  std::string key = path.substr(begin + 17);
  if (key.ends_with(".value")) key.resize(key.size() - 6);
  const auto* found = std::find_if(std::begin(kDriveParameters), std::end(kDriveParameters),
                                   [&](const DriveParameterSpec& spec) { return key == spec.key; });
  return found == std::end(kDriveParameters) ? nullptr : found;
}

std::string letters(const std::string& text) {
  std::string kept;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c))) kept += static_cast<char>(std::tolower(c));
  return kept;
}

/// "release" of "release_nm" in N m.
std::string less_unit(const std::string& key, const std::string& unit) {
  for (std::size_t at = key.find('_'); at != key.npos; at = key.find('_', at + 1))
    if (letters(key.substr(at + 1)) == letters(unit)) return key.substr(0, at);
  return key;
}

/// @param place  "0.contact_adhesion.release_nm"
AxisName amount_name(const std::string& place, const std::string& whose, Coordinates coordinates) {
  const std::string effect = place.substr(std::min(place.find('.') + 1, place.size()));
  const std::size_t dot = std::min(effect.find('.'), effect.size());
  const std::string name = effect.substr(0, dot), key = effect.substr(std::min(dot + 1, effect.size()));
  if (const EffectEntry* entry = find_effect(name))
    for (const EffectParameterSpec& spec : entry->parameters)
      if (key == spec.key)
        return {whose + readable(name) + ": " + readable(less_unit(key, spec.unit)),
                coordinates.shown_unit(spec.unit)};
  return {whose + readable(effect), ""};
}

}  // namespace

AxisName axis_name(const std::string& path, Coordinates coordinates) {
  if (const auto found = plain_names().find(path); found != plain_names().end())
    return {found->second.name, coordinates.shown_unit(found->second.unit)};
  if (const DriveParameterSpec* spec = drive_parameter_at(path)) {
    const std::string name = readable(spec->key);
    return {path.starts_with("model.") ? "model's " + name : name, coordinates.shown_unit(spec->unit)};
  }
  if (const std::size_t at = path.find("model.effects."); at != path.npos)
    return amount_name(path.substr(at + 14), path.starts_with("model.") ? "model's " : "", coordinates);
  if (path.find("excitation.") != path.npos && path.ends_with(".frequency")) return {"frequency", "Hz"};
  if (path.find("excitation.") != path.npos && path.ends_with(".amplitude")) return {"amplitude", ""};
  return {path, ""};
}

std::string with_unit(double value, const std::string& unit) {
  const bool takes_prefix = unit == "Hz" || unit == "rad" || unit == "m" || unit == "s";
  std::string prefix;
  if (takes_prefix && value != 0.0) {
    const int thousands = static_cast<int>(std::floor(std::log10(std::abs(value) * (1.0 + 1e-12)) / 3.0));
    const char* const prefixes[] = {"n", "µ", "m", "", "k", "M"};
    const int place = std::clamp(thousands + 3, 0, 5);
    prefix = prefixes[place];
    value /= std::pow(1000.0, place - 3);
  }
  return fmt::format("{:.4g}{}{}{}", value, unit.empty() ? "" : " ", prefix, unit);
}

}  // namespace gapscope::internal::campaign
