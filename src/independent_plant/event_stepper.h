#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "independent_plant/integrator.h"

namespace gapscope::independent_plant {

/// A system on its way: where it is, and the step that it may take next.
struct TimedState {
  double t = 0.0;  ///< [s]
  State s{};
  State tolerance{};  ///< local error per step of each component
  double h = 1e-5;    ///< next step [s]
  long steps = 0;
};

/// Steps of a system that is smooth between events: adaptive Dormand–Prince steps, and every event located
/// by repeating the last step up to it (no grid, no interpolated states). While a regime lasts all its
/// guards are ≥ 0; the first that falls below ends it.
///   rates(t, s)    right-hand side of the present regime
///   guards(t, s)   its guards, an array
///   change(guard)  is called at an event, with `now` at its time and state; the regime is another one then
template <int Size, class Rates, class GuardsAt, class Change>
class EventStepper {
 public:
  EventStepper(TimedState& now, const Rates& rates, const GuardsAt& guards, const Change& change)
      : now_(now), rates_(rates), guards_(guards), change_(change) {}

  void advance(double t_end) {
    State first = rates_(now_.t, now_.s);
    for (long events = 0; now_.t < t_end;) {
      const double left = t_end - now_.t;
      const double h = now_.h >= 0.95 * left ? left : std::min(now_.h, 0.5 * left);  // no sliver at the end
      const Step step(rates_, now_.t, now_.s, first, h);
      ++now_.steps;
      if (!adapt_step(step.error(now_.tolerance), h)) continue;
      const Crossing crossing = first_crossing(step, h);
      if (crossing.guard < 0) {
        now_.t = h == left ? t_end : now_.t + h;
        now_.s = step.end();
        first = step.last_rates();
      } else if (crossing.theta == 0.0 && h > kShortestStep) {
        now_.h = 0.1 * h;  // below zero all along: look closer before believing it
      } else {
        if (++events > kMostEventsPerCall) throw std::runtime_error("blind plant: events without end");
        now_.s = step.shortened(rates_, crossing.theta);
        now_.t += crossing.theta * h;
        change_(crossing.guard);
        first = rates_(now_.t, now_.s);
      }
    }
  }

 private:
  using Step = DormandPrinceStep<Size>;
  static constexpr double kShortestStep = 1e-12;  // [s]
  static constexpr double kEventTime = 1e-14;     // [s] to which a change of regime is located
  static constexpr long kMostEventsPerCall = 100000;
  /// Shares of a step at which the guards are looked at.
  static constexpr std::array kSamples{0.0, 0.07, 0.3, 0.5, 0.7, 0.93, 1.0};

  struct Crossing {
    int guard = -1;
    double theta = 1.0;  ///< share of the step
  };
  struct Bracket {
    double low, high;  ///< shares of the step: guard ≥ 0, guard < 0
  };

  /// Where a parabola through three points has its minimum.
  static double vertex(double a, double b, double c, double ga, double gb, double gc) {
    const double left = (b - a) * (gb - gc), right = (b - c) * (gb - ga);
    return b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right);
  }

  /// Chooses the next step from the error (in tolerances) of one of length h; false: it must be repeated.
  bool adapt_step(double error, double h) {
    const double next = h * std::clamp(0.9 * std::pow(std::max(error, 1e-10), -0.2), 0.2, 5.0);
    if (error > 1.0 && h > kShortestStep) {
      now_.h = next;
      return false;
    }
    // a step cut short by t_end says nothing against a longer one
    now_.h = h < now_.h ? std::max(now_.h, next) : next;
    return true;
  }

  /// The earliest guard that falls below zero within the step, located; theta 0 if it is so all along.
  Crossing first_crossing(const Step& step, double h) const {
    using Values = decltype(guards_(0.0, now_.s));
    std::array<Values, kSamples.size()> g;
    for (std::size_t j = 0; j < kSamples.size(); ++j) {
      const State s = j == 0 ? now_.s : (j + 1 == kSamples.size() ? step.end() : step.inside(kSamples[j]));
      g[j] = guards_(now_.t + kSamples[j] * h, s);
    }
    Crossing first;
    for (int i = 0; i < static_cast<int>(g[0].size()); ++i) {
      const Bracket bracket = find_bracket(i, g, step, h);
      if (bracket.high == 0.0) return {i, 0.0};
      if (bracket.low >= first.theta) continue;
      const double theta = locate(i, bracket, h, step);
      if (theta < first.theta || first.guard < 0) first = {i, theta};
    }
    return first;
  }

  /// Where a guard first goes below zero, between samples; also a dip that no sample shows. None: low is 2.
  template <class Samples>
  Bracket find_bracket(int i, const Samples& g, const Step& step, double h) const {
    constexpr std::size_t n = kSamples.size();
    std::size_t from = 0;
    while (from < n && g[from][i] < 0.0) ++from;  // a guard may start a round-off below zero
    if (from == n) return {0.0, 0.0};
    for (std::size_t j = from + 1; j < n; ++j) {
      if (g[j][i] < 0.0) return {kSamples[j - 1], kSamples[j]};
      if (j + 1 == n || g[j][i] > g[j - 1][i] || g[j][i] > g[j + 1][i]) continue;
      const double dip =
          vertex(kSamples[j - 1], kSamples[j], kSamples[j + 1], g[j - 1][i], g[j][i], g[j + 1][i]);
      if (!(dip > kSamples[j - 1] && dip < kSamples[j + 1])) continue;
      if (guards_(now_.t + dip * h, step.inside(dip))[i] < 0.0) return {kSamples[j - 1], dip};
    }
    return {2.0, 2.0};
  }

  /// Root of a guard within the bracket, by regula falsi (Illinois)
  /// on repeated shorter steps; returns the far side, where the guard is < 0.
  double locate(int guard, Bracket bracket, double h, const Step& step) const {
    auto [low, high] = bracket;
    const auto value = [&](double theta) {
      return guards_(now_.t + theta * h, step.shortened(rates_, theta))[guard];
    };
    double g_low = value(low), g_high = value(high);
    if (g_low < 0.0) return low;     // the continuous extension, which chose the bracket, erred by less than
    if (g_high >= 0.0) return high;  // the tolerance
    int side = 0;
    for (int i = 0; i < 100 && (high - low) * h > kEventTime; ++i) {
      double theta = (low * g_high - high * g_low) / (g_high - g_low);
      if (i % 8 == 7 || !(theta > low && theta < high)) theta = 0.5 * (low + high);
      const double g = value(theta);
      if (g < 0.0) {
        high = theta, g_high = g;
        if (side == -1) g_low *= 0.5;
        side = -1;
      } else {
        low = theta, g_low = g;
        if (side == 1) g_high *= 0.5;
        side = 1;
      }
    }
    return high;
  }

  TimedState& now_;
  const Rates& rates_;
  const GuardsAt& guards_;
  const Change& change_;
};

/// Moves a system to t_end; see EventStepper.
template <int Size, class Rates, class GuardsAt, class Change>
void advance_through_events(TimedState& now, double t_end, const Rates& rates, const GuardsAt& guards,
                            const Change& change) {
  EventStepper<Size, Rates, GuardsAt, Change>(now, rates, guards, change).advance(t_end);
}

}  // namespace gapscope::independent_plant
