#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "config/model_reader.h"
#include "config/parameter_setting.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
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

/// 2 pi over a number of periods, and the other way round: both fall where the other rises.
double other_way(double periods) { return 2.0 * kPi / periods; }

/// `period_rad` in place of `periods_per_turn`.
ParameterSetting from_period(const ParameterSetting& period) {
  ParameterSetting periods = period;
  periods.value = other_way(period.value);
  periods.low = other_way(period.high), periods.high = other_way(period.low);
  return periods;
}

/// The keys of an effect; of one with a period the other way to write it, too.
std::vector<std::string> keys_of(const EffectEntry& entry) {
  std::vector<std::string> keys;
  for (const EffectParameterSpec& spec : entry.parameters) keys.emplace_back(spec.key);
  if (entry.period_at() >= 0) keys.emplace_back(kPeriodKey);
  return keys;
}

void refuse_both(const Section& section, const EffectEntry& entry) {
  if (entry.period_at() < 0) return;
  const char* const other = entry.parameters[entry.period_at()].key;
  if (const auto length = section.find(kPeriodKey); length && section.find(other))
    length->fail(fmt::format("stands beside {}, expected only one of both", other));
}

/// What has no neutral value has to be written; a period that is one turn is settled later.
void require_the_rest(const Section& section, const ModelEffect& effect) {
  const EffectEntry& entry = *effect.entry;
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const EffectParameterSpec& spec = entry.parameters[i];
    const bool period = static_cast<int>(i) == entry.period_at();
    const bool settled = period && (entry.turns_with != Shaft::kNone || section.find(kPeriodKey));
    if (std::isnan(effect.parameters[i].value) && !settled && !section.find(spec.key))
      section.require(spec.key, fmt::format("a number in {}{}", spec.unit, period ? ", or period_rad" : ""));
  }
}

void read_effect_parameters(const Value& written, ModelEffect& effect) {
  const EffectEntry& entry = *effect.entry;
  const Section section(written, keys_of(entry));
  refuse_both(section, entry);
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const EffectParameterSpec& spec = entry.parameters[i];
    ParameterSetting& setting = effect.parameters[i];
    setting.value = neutral_value(entry, i, ShaftTurns::of_a_slide());
    const bool period = static_cast<int>(i) == entry.period_at();
    if (const auto given = section.find(spec.key))
      setting = read_setting(*given, possible(spec));
    else if (const auto length = period ? section.find(kPeriodKey) : std::nullopt)
      setting = from_period(read_setting(*length, kPossiblePeriod));
  }
  require_the_rest(section, effect);
}

}  // namespace

/// Bounds that scale with the drive keep their sign here; their size is the
/// fit's concern, who knows the recording.
Range possible(const EffectParameterSpec& spec) {
  if (spec.scale == Scale::kOne) return {spec.low, spec.high, spec.unit};
  const double most = spec.scale == Scale::kSample ? kLongestDelay : kMost;
  return {spec.low >= 0.0 ? 0.0 : -most, most, spec.unit};
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
  read_effect_parameters(written, effect.effect);
  return effect;
}

void settle_periods(std::vector<EffectConfig>& effects, const ShaftTurns& turns, const std::string& file) {
  for (EffectConfig& e : effects) {
    const int at = e.effect.entry->period_at();
    if (at < 0 || e.effect.entry->turns_with == Shaft::kNone) continue;
    ParameterSetting& period = e.effect.parameters[at];
    if (std::isnan(period.value)) period.value = turns.of(e.effect.entry->turns_with);
    if (std::isnan(period.value))
      throw ConfigError(file, e.line,
                        fmt::format("{} comes once per turn, and nothing here says how far a turn of a slide "
                                    "is, expected period_rad [m], such as the pitch of its screw",
                                    e.effect.entry->name));
  }
}

}  // namespace internal::config
}  // namespace gapscope
