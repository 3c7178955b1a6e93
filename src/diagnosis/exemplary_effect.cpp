#include "diagnosis/exemplary_effect.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gapscope::internal::diagnosis {
namespace {

bool is_phase(const EffectParameterSpec& spec) { return spec.key == std::string_view("phase_rad"); }

/// The model without the effect that is contained, and that effect's level.
ReferenceModel freed(ReferenceModel model, const EffectEntry* contained, double& level) {
  std::erase_if(model.effects, [&](const ModelEffect& e) {
    if (e.entry == contained) level = e.parameters[0].value;
    return e.entry == contained;
  });
  return model;
}

/// In units of the scale.
double usual(const EffectEntry& entry, std::size_t i) {
  const EffectParameterSpec& spec = entry.parameters[i];
  if (spec.scale == Scale::kPerTravel) return std::sqrt(spec.low * spec.high);
  return i == 0 || !entry.starts.empty() ? effect_starts(entry).front()[i] : spec.absent;
}

}  // namespace

ExemplaryEffect::ExemplaryEffect(const Study& study, const ReferenceModel& model, const EffectEntry& entry)
    : model_(model), entry_(entry), turns_(study.turns) {
  ReferenceModel with = model;
  const std::size_t count = entry.parameters.size();
  with.effects.push_back(searched_effect(entry, turns_));
  const reference::ModelFit fit(study.held_out.traces, with, study.options.fit, study.observer_hz);
  const int place = static_cast<int>(with.effects.size()) - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const EffectParameterSpec& spec = entry.parameters[i];
    const ParameterSetting& setting = with.effects.back().parameters[i];
    if (!setting.estimate) {
      bounds_.push_back({setting.value, setting.value});
      start_.push_back(setting.value), absent_.push_back(setting.value);
      continue;
    }
    bounds_.push_back(fit.bounds({place, static_cast<int>(i)}));
    const double scale = bounds_.back().high / spec.high;
    start_.push_back(usual(entry, i) * scale);
    absent_.push_back(spec.absent * scale);
  }
  double level = kNaN;
  freed(model, contained_effect(entry), level);
  inherits_ = std::isfinite(level);
  if (inherits_) start_[0] = absent_[0] = level, absent_[1] = 0.0;
}

bool ExemplaryEffect::has_phase() const {
  return std::any_of(entry_.parameters.begin(), entry_.parameters.end(), is_phase);
}

bool ExemplaryEffect::lacks_its_level() const {
  return contained_effect(entry_) != nullptr && !inherits_ && entry_.parameters[1].scale == Scale::kLevel;
}

/// All that vanishes with the effect grows with its size; the rest is its shape.
std::vector<double> ExemplaryEffect::written(double size) const {
  std::vector<double> values = start_;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool grows = i == size_at() || (entry_.parameters[i].absent == 0.0 && !(inherits_ && i == 0));
    if (!grows) continue;
    values[i] = std::isfinite(absent_[i]) ? absent_[i] + size * (start_[i] - absent_[i]) : start_[i] / size;
  }
  return values;
}

std::vector<double> ExemplaryEffect::values(double size) const {
  std::vector<double> values = written(size);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i != size_at()) values[i] = std::clamp(values[i], bounds_[i].low, bounds_[i].high);
  return values;
}

bool ExemplaryEffect::is_possible(double size) const {
  const double value = written(size)[size_at()];
  return value >= bounds_[size_at()].low && value <= bounds_[size_at()].high;
}

ReferenceModel ExemplaryEffect::in_model(double size, bool quarter) const {
  std::vector<double> all = values(size);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (quarter && is_phase(entry_.parameters[i])) all[i] = 0.5 * kPi;
  double level = kNaN;
  ReferenceModel model = inherits_ ? freed(model_, contained_effect(entry_), level) : model_;
  model.effects.push_back(searched_effect(entry_, all, turns_));
  return model;
}

}  // namespace gapscope::internal::diagnosis
