#include "diagnosis/race.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

ReferenceModel with_values(ReferenceModel model, const std::vector<double>& effect) {
  for (std::size_t i = 0; i < effect.size(); ++i) model.effects.back().parameters[i].value = effect[i];
  return model;
}

}  // namespace

Race::Race(const reference::ModelFit& fit, const FittedModel& nominal,
           std::span<const reference::FitLinearisation> bases, const SearchEffort& effort)
    : fit_(fit), nominal_(nominal), bases_(bases), effort_(effort), best_(bases.size() + 1) {}

Interval Race::bounds(std::size_t i) const {
  return fit_.bounds({static_cast<int>(fit_.model().effects.size()) - 1, static_cast<int>(i)});
}

/// Physical values of a start.
std::vector<double> Race::physical(const EffectStart& start) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < entry().parameters.size(); ++i) {
    const ParameterSetting& setting = fit_.model().effects.back().parameters[i];
    if (!setting.estimate) {
      values.push_back(setting.value);
      continue;
    }
    const Interval b = bounds(i);
    values.push_back(std::clamp(start[i] * b.high / entry().parameters[i].high, b.low, b.high));
  }
  return values;
}

/// Parameter i nearer to where the effect is absent.
double Race::weaker(std::size_t i, double value) const {
  const EffectParameterSpec& spec = entry().parameters[i];
  const double high = bounds(i).high;
  const double absent = spec.absent * high / spec.high;
  return std::isfinite(absent) ? absent + effort_.weaker * (value - absent)
                               : std::min(value / effort_.weaker, high);
}

void Race::take(reference::AdjustedFit entrant, std::size_t origin) {
  last_ = std::move(entrant);
  if (last_.usable() && last_.residual_mean_square < best_[origin].residual_mean_square)
    best_[origin] = last_;
}

const reference::AdjustedFit& Race::best() const {
  return *std::min_element(best_.begin(), best_.end(), [](const auto& a, const auto& b) {
    return a.residual_mean_square < b.residual_mean_square;
  });
}

void Race::run_from(const std::vector<double>& effect, const reference::FitLinearisation& base) {
  const reference::FitPoint point = fit_.point_of(with_values(fit_.model(), effect), nominal_.starts);
  take(fit_.adjust(point.beginning_with(base.q()), base, effort_.race_steps),
       static_cast<std::size_t>(&base - bases_.data()));
}

/// The parent's fit carried over: its drive, and its first parameter for ours.
void Race::run_on(const FittedModel& parent, std::vector<double> effect) {
  effect[0] = parent.model.effects.back().parameters[0].value;
  const ReferenceModel values = with_values(with_drive(fit_.model(), parent.model), effect);
  take(fit_.adjust(fit_.point_of(values, nominal_.starts), bases_.front(), effort_.race_steps),
       bases_.size());
}

void Race::enter(const EffectStart& start) {
  const std::vector<double> effect = physical(start);
  for (const reference::FitLinearisation& base : bases_) run_from(effect, base);
}

void Race::enter_sines(const EffectStart& typical) {
  const double small = effort_.weaker * physical(typical)[0];
  const reference::FitPoint point = fit_.point_of(fit_.model(), nominal_.starts);
  for (const reference::FitLinearisation& base : bases_)
    if (const auto sine = fit_.sine_start(point.beginning_with(base.q()), base, small))
      run_from({sine->amplitude, sine->phase}, base);
}

void Race::enter_on(const FittedModel& parent, const EffectStart& start) {
  if (bases_.empty()) return;
  std::vector<double> effect = physical(start);
  run_on(parent, effect);
  effect[1] = weaker(1, effect[1]);
  run_on(parent, effect);
}

void Race::weaken(const EffectStart& start, std::size_t i) {
  // The race's residuals alone against all that the fit without the effect minimised.
  if (bases_.empty() || last_.residual_mean_square < nominal_.mean_cost) return;
  std::vector<double> effect = physical(start);
  effect[i] = weaker(i, effect[i]);
  run_from(effect, bases_.front());
}

/// The race's own residuals stand for the cost, without priors and widths.
reference::RefinedFit Race::leader() const {
  if (!best().usable()) return {};
  return {best(), best().residual_mean_square, false, 0.0};
}

reference::RefinedFit Race::follow(const reference::AdjustedFit& from, bool thorough) const {
  const reference::RefinedFit quick = fit_.refine(from, effort_.quick);
  if (!quick.usable()) return {from, from.residual_mean_square, false, 0.0};
  if (!thorough || !(quick.mean_cost < (1.0 - kRule.worth_having) * nominal_.mean_cost)) return quick;
  const reference::RefinedFit found = fit_.refine(quick, {});
  return found.mean_cost < quick.mean_cost ? found : quick;
}

reference::RefinedFit Race::refined(bool thorough) const {
  const reference::AdjustedFit& first = best();
  if (!first.usable()) return {};
  reference::RefinedFit found = follow(first, thorough);
  for (const reference::AdjustedFit& other : best_)
    if (thorough && &other != &first && other.usable() && !(found.mean_cost < kExplained))
      if (reference::RefinedFit there = follow(other, thorough); there.mean_cost < found.mean_cost)
        found = std::move(there);
  return found;
}

}  // namespace gapscope::internal::diagnosis
