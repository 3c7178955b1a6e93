#include "diagnosis/loop_numbers.h"

#include <algorithm>
#include <cmath>

#include "gapscope/simulation/simulate.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Of a number that is no less than zero, where nothing bounds it: a hundredth of its beginning. A drive of
/// next to no inertia is slow to simulate and no other one for that.
constexpr double kLeastOf = 1e-2;
constexpr double kMostTimes = 1e3;  ///< over its beginning, at most

const LawNumber* const kLaw[] = {
    &LawNumbers::gain,        &LawNumbers::goal_delay,    &LawNumbers::delay,
    &LawNumbers::saturation,  &LawNumbers::falls_at,      &LawNumbers::falls_sharpness,
    &LawNumbers::off_damping, &LawNumbers::profile_speed, &LawNumbers::profile_acceleration,
    &LawNumbers::goal_filter};

/// Whether a number stays at zero or above.
bool is_a_size(const Loop& loop, reference::ParameterId id) {
  if (id.effect == reference::ParameterId::kDrive) return true;
  const EffectParameterSpec& spec = loop.model.effects[static_cast<std::size_t>(id.effect)]
                                        .entry->parameters[static_cast<std::size_t>(id.index)];
  return spec.low >= 0.0 && spec.scale != Scale::kOne;
}

void add_place(const Loop& loop, reference::ParameterId id, std::vector<LoopPlace>& places) {
  Loop copy = loop;
  const ParameterSetting& p = reference::setting_of(copy.model, id);
  if (!p.estimate || !std::isfinite(p.value)) return;
  const bool size = is_a_size(loop, id) && p.value > 0.0;
  double low = p.low, high = p.high;
  if (id.effect >= 0) {
    const EffectParameterSpec& spec = loop.model.effects[static_cast<std::size_t>(id.effect)]
                                          .entry->parameters[static_cast<std::size_t>(id.index)];
    if (spec.scale == Scale::kOne || spec.scale == Scale::kLevel) {
      if (std::isnan(low)) low = spec.low;
      if (std::isnan(high)) high = spec.high;
    }
  }
  if (std::isnan(low)) low = size ? kLeastOf * p.value : -kInfinity;
  if (std::isnan(high)) high = size ? kMostTimes * p.value : kInfinity;
  places.emplace_back(id, size ? 0.0 : std::max(1.0, std::abs(p.value)), low, high);
}

}  // namespace

PlantModel<double> plant_of(const ReferenceModel& model) {
  DriveParameters<double> drive;
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (const double value = model.parameters[static_cast<std::size_t>(i)].value; std::isfinite(value))
      drive_parameter(drive, i) = value;
  PlantModel<double> plant = plant_model(drive, model.structure);
  for (const ModelEffect& e : model.effects) {
    std::vector<double> values;
    for (std::size_t i = 0; i < e.entry->parameters.size(); ++i) values.push_back(e.parameters[i].value);
    add_effect<double>(plant, *e.entry, values);
  }
  return plant;
}

ReferenceModel bounded(ReferenceModel model) {
  for (ParameterSetting& p : model.parameters)
    if (p.estimate && std::isnan(p.low) && p.value > 0.0) p.low = kLeastOf * p.value;
  return model;
}

double LoopPlace::value(const Loop& loop) const {
  if (law_ != nullptr) return loop.controller.*law_->member;
  ReferenceModel model = loop.model;
  return reference::setting_of(model, id_).value;
}

void LoopPlace::set(double value, Loop& loop) const {
  if (law_ != nullptr)
    loop.controller.*law_->member = value;
  else
    reference::setting_of(loop.model, id_).value = value;
}

double LoopPlace::moved(double value, double by) const {
  return std::clamp(scale_ > 0.0 ? value + by * scale_ : value * std::exp(by), low_, high_);
}

void LoopPlace::move(Loop& loop, double by) const { set(moved(value(loop), by), loop); }

double LoopPlace::trial(const Loop& loop, double turn) const {
  constexpr double kOfItself = 0.01;
  return law_ == &LawNumbers::goal_delay ? std::max(kOfItself, std::log1p(turn / value(loop))) : kOfItself;
}

double LoopPlace::unseen(const Loop& loop, double turn) const {
  return law_ == &LawNumbers::goal_delay ? std::log1p(0.5 * turn / value(loop)) : 0.0;
}

LoopNumber LoopPlace::told(const Loop& loop, double spread) const {
  const double v = value(loop);
  const Interval ci95{moved(v, -spread), moved(v, spread)};
  if (law_ != nullptr) return {law_->key, law_->unit, v, ci95};
  if (id_.effect == reference::ParameterId::kDrive)
    return {kDriveParameters[id_.index].key, kDriveParameters[id_.index].unit, v, ci95};
  const EffectEntry& entry = *loop.model.effects[static_cast<std::size_t>(id_.effect)].entry;
  const EffectParameterSpec& spec = entry.parameters[static_cast<std::size_t>(id_.index)];
  return {std::string(entry.name) + "." + spec.key, spec.unit, v, ci95};
}

void free_timing(Loop& loop, const DriveController& declared, double dt) {
  const double half = 0.5 * (loop.controller.rate > 0.0 ? 1.0 / loop.controller.rate : dt);
  for (const LawNumber* number : {&LawNumbers::delay, &LawNumbers::goal_delay})
    if (!number->is_in(loop.controller) && !number->is_in(declared)) loop.controller.*number->member = half;
}

std::vector<LoopPlace> places_of(const Loop& loop, const DriveController& declared,
                                 const LoopFitOptions& options) {
  std::vector<LoopPlace> places;
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (has_parameter(loop.model.structure, i)) add_place(loop, reference::drive_number(i), places);
  for (std::size_t e = 0; e < loop.model.effects.size(); ++e)
    for (std::size_t i = 0; i < loop.model.effects[e].entry->parameters.size(); ++i)
      add_place(loop, {static_cast<int>(e), static_cast<int>(i)}, places);
  for (const LawNumber* number : kLaw) {
    const bool asked = (number == &LawNumbers::gain && options.gain_is_sought &&
                        loop.controller.kind == ControllerKind::kPosition) ||
                       (number == &LawNumbers::delay && options.delay_is_sought);
    if (number->is_in(loop.controller) && (asked || !number->is_in(declared))) places.emplace_back(*number);
  }
  return places;
}

Loop at_rate(double rate, Loop loop) {
  DriveController& c = loop.controller;
  const double later = 0.5 * (1.0 / rate - 1.0 / c.rate);
  for (const LawNumber* number : {&LawNumbers::delay, &LawNumbers::goal_delay})
    if (number->is_in(c))
      c.*number->member = std::clamp(c.*number->member - later, number->low, number->high);
  c.rate = rate;
  return loop;
}

}  // namespace gapscope::internal::diagnosis
