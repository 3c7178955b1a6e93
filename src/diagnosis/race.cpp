#include "diagnosis/race.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

constexpr int kRaceSteps = 2;                              ///< to tell which start is worth more
constexpr reference::RefineEffort kLight{2, 8, 1e-3};      ///< to tell whether a candidate helps at all
constexpr reference::RefineEffort kThorough{5, 25, 3e-4};  ///< of those that do
constexpr double kPromising = 0.9;                         ///< of the mean square without the effect
constexpr double kSmallSine = 0.1;                         ///< of the start: there it acts in proportion
constexpr int kWeakenings = 2;
constexpr double kWeaker = 0.15;  ///< of the start
constexpr double kClose = 30.0;   ///< a start from elsewhere is followed while it is within this ratio

/// The race's own residuals stand for the cost, without priors and widths.
reference::RefinedFit unrefined(const reference::AdjustedFit& from, double simulations) {
  return {from, from.residual_mean_square, false, simulations};
}

ReferenceModel with_values(ReferenceModel model, const std::vector<double>& effect) {
  for (std::size_t i = 0; i < effect.size(); ++i) model.effects.back().parameters[i].value = effect[i];
  return model;
}

}  // namespace

Race::Race(const reference::ModelFit& fit, const FittedModel& nominal,
           std::span<const reference::FitLinearisation> bases)
    : fit_(fit), nominal_(nominal), bases_(bases) {}

Interval Race::bounds(std::size_t i) const {
  return fit_.bounds({static_cast<int>(fit_.model().effects.size()) - 1, static_cast<int>(i)});
}

/// Physical values of a start.
std::vector<double> Race::physical(const EffectStart& start) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < entry().parameters.size(); ++i) {
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
  return std::isfinite(absent) ? absent + kWeaker * (value - absent) : std::min(value / kWeaker, high);
}

void Race::run_from(const std::vector<double>& effect, const reference::FitLinearisation& base) {
  const reference::FitPoint point = fit_.point_of(with_values(fit_.model(), effect), nominal_.starts);
  field_.push_back({fit_.adjust(point.beginning_with(base.q()), base, kRaceSteps),
                    static_cast<std::size_t>(&base - bases_.data())});
}

/// The parent's fit carried over: its drive, and its first parameter for ours.
void Race::run_on(const FittedModel& parent, std::vector<double> effect) {
  effect[0] = parent.model.effects.back().parameters[0].value;
  const ReferenceModel values = with_values(with_drive(fit_.model(), parent.model), effect);
  field_.push_back(
      {fit_.adjust(fit_.point_of(values, nominal_.starts), bases_.front(), kRaceSteps), bases_.size()});
}

void Race::enter(const EffectStart& start) {
  const std::vector<double> effect = physical(start);
  for (const reference::FitLinearisation& base : bases_) run_from(effect, base);
}

void Race::enter_sines(const EffectStart& typical) {
  const double small = kSmallSine * physical(typical)[0];
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
  if (bases_.empty()) return;
  std::vector<double> effect = physical(start);
  for (int k = 0; k < kWeakenings; ++k) {
    // The race's residuals alone against all that the fit without the effect minimised.
    if (field_.back().at.residual_mean_square < nominal_.mean_cost) return;
    effect[i] = weaker(i, effect[i]);
    run_from(effect, bases_.front());
  }
}

/// A refinement that goes on only while it promises to beat the model without the effect.
reference::RefinedFit Race::follow(const reference::AdjustedFit& from) const {
  reference::RefinedFit light = fit_.refine(from, kLight);
  if (!light.usable()) return unrefined(from, light.simulations);
  if (!(light.mean_cost < kPromising * nominal_.mean_cost)) return light;
  reference::RefinedFit found = fit_.refine(light, kThorough);
  found.simulations = light.simulations += found.simulations;
  return found.mean_cost < light.mean_cost ? found : light;
}

void Race::finish() {
  std::stable_sort(field_.begin(), field_.end(), [](const Entrant& a, const Entrant& b) {
    return a.at.residual_mean_square < b.at.residual_mean_square;
  });
}

double Race::least() const {
  return field_.empty() || !field_.front().at.usable() ? kInfinity : field_.front().at.residual_mean_square;
}

reference::RefinedFit Race::leader() const {
  if (!std::isfinite(least())) return {};
  return unrefined(field_.front().at, 0.0);
}

reference::RefinedFit Race::best() const {
  if (field_.empty() || !field_.front().at.usable()) return {};
  const Entrant& first = field_.front();
  reference::RefinedFit best = follow(first.at);
  for (const Entrant& other : field_) {
    if (best.mean_cost < kFloorSquare) break;
    if (other.origin == first.origin ||
        other.at.residual_mean_square > kClose * first.at.residual_mean_square)
      continue;
    const reference::RefinedFit found = follow(other.at);
    if (found.mean_cost < best.mean_cost) best = found;
    break;
  }
  return best;
}

}  // namespace gapscope::internal::diagnosis
