#include <fmt/format.h>

#include <cmath>

#include "config/model_reader.h"
#include "gapscope/base/text.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {

ReferenceModel ModelConfig::reference_model() const {
  ReferenceModel model{structure, parameters, {}};
  for (const EffectConfig& e : effects) model.effects.push_back(e.effect);
  return model;
}

PlantModel<double> SimulatedPlant::plant_model() const {
  PlantModel<double> plant = gapscope::plant_model(drive, structure);
  for (const EffectConfig& e : effects) {
    std::vector<double> values;
    for (std::size_t i = 0; i < e.effect.entry->parameters.size(); ++i)
      values.push_back(e.effect.parameters[i].value);
    add_effect<double>(plant, *e.effect.entry, values);
  }
  return plant;
}

namespace internal::config {
namespace {

constexpr double kMost = 1e15;          ///< as of any number that is read
constexpr double kLongestDelay = 10.0;  ///< [s]

ParameterSetting read_setting(const Value& value, const Range& range) {
  ParameterSetting p;
  if (!value.is_map()) {
    p.value = value.number(range);
    return p;
  }
  const Section section(value, {"value", "estimate", "bounds"});
  if (const auto given = section.find("estimate")) p.estimate = given->truth();
  if (const auto given = section.find("bounds")) std::tie(p.low, p.high) = given->rising_pair(range);
  if (const auto given = section.find("value"))
    p.value = given->number(std::isnan(p.low) ? range : Range{p.low, p.high, range.unit});
  if (std::isnan(p.value) && !p.estimate)
    value.fail("has no value and is not estimated, expected a value or estimate: true");
  return p;
}

}  // namespace

/// Bounds that scale with the drive keep their sign here; their size is the
/// fit's concern, who knows the recording.
Range possible(const EffectParameterSpec& spec) {
  if (spec.scale == Scale::kOne) return {spec.low, spec.high, spec.unit};
  const double most = spec.scale == Scale::kSample ? kLongestDelay : kMost;
  return {spec.low >= 0.0 ? 0.0 : -most, most, spec.unit};
}

double neutral(const EffectParameterSpec& spec) {
  return spec.absent == 0.0 || spec.scale == Scale::kOne ? spec.absent : kNaN;
}

const EffectEntry& effect_named(const std::string& name, const Value& value) {
  if (const EffectEntry* entry = find_effect(name)) return *entry;
  std::vector<std::string> names;
  for (const EffectEntry* entry : effect_table()) names.emplace_back(entry->name);
  value.fail(
      fmt::format("is no effect of the catalogue, expected one of `gapscope effects`; the nearest is {}",
                  nearest_name(name, names)));
}

EffectConfig read_effect(const Value& value) {
  const char* const form = "one effect, {name: {key: number}}";
  if (value.is_text()) effect_named(value.text(), value);
  if (!value.is_map()) value.fail_expecting(form);
  const auto entries = value.entries();
  if (entries.size() != 1) value.fail_expecting(form);
  const Value& written = entries[0].second;
  EffectConfig effect;
  effect.line = written.line();
  effect.effect.entry = &effect_named(entries[0].first, written);
  std::vector<std::string> keys;
  for (const EffectParameterSpec& spec : effect.effect.entry->parameters) keys.emplace_back(spec.key);
  const Section section(written, keys);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const EffectParameterSpec& spec = effect.effect.entry->parameters[i];
    ParameterSetting& setting = effect.effect.parameters[i];
    setting.value = neutral(spec);
    if (const auto given = section.find(keys[i]))
      setting = read_setting(*given, possible(spec));
    else if (std::isnan(setting.value))
      section.require(keys[i], fmt::format("a number in {}", spec.unit));
  }
  return effect;
}

}  // namespace internal::config
}  // namespace gapscope
