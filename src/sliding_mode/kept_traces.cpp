#include "sliding_mode/kept_traces.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/marks/marks.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// An error that is smaller than this share of the passage's largest lies on the axis as it is drawn. Half
/// and double of it move t_c of configs/01 by +2 and −5 ms, 221 ms before t1, of configs/02 by +1 and −2 ms
/// of 34.
constexpr double kQuietError = 0.01;

std::size_t nearest(double time, double start, double dt, std::size_t size) {
  const double i = std::round((time - start) / dt);
  return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(size - 1)));
}

/// e_x and ŵ1 of one bound, for the figures.
ErrorTrace trace_of(const MotorTrace& recording, double bound, Discretisation discretisation) {
  ErrorTrace trace{recording.file, {}, {}};
  if (recording.x1.empty()) return trace;
  SuperTwistingDifferentiator differentiator(bound, discretisation);
  trace.error.reserve(recording.size());
  trace.velocity.reserve(recording.size());
  for (const double y : recording.x1) {
    const auto estimate = differentiator.step(y, recording.dt);
    trace.error.push_back(estimate.error);
    trace.velocity.push_back(estimate.velocity);
  }
  return trace;
}

/// The number of the form 1, 2 or 5 × 10ⁿ nearest to `value` on a logarithmic scale.
double nice_number(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double mantissa = value / decade;
  return decade * (mantissa < std::sqrt(2.0)    ? 1.0
                   : mantissa < std::sqrt(10.0) ? 2.0
                   : mantissa < std::sqrt(50.0) ? 5.0
                                                : 10.0);
}

/// N of step S2: e_x × N fills the travel of x1.
double scale_of(std::span<const signals::SignalFacts> facts, const std::vector<ErrorTrace>& traces) {
  double ratio = 0.0;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const std::span<const double> settled = std::span(traces[i].error).subspan(traces[i].error.size() / 10);
    std::vector<double> sizes(settled.begin(), settled.end());
    for (double& size : sizes) size = std::abs(size);
    const double peak = quantile(std::move(sizes), 0.998);
    if (peak > 0.0) ratio = std::max(ratio, 0.5 * facts[i].travel / peak);
  }
  return ratio > 0.0 ? nice_number(ratio) : 1.0;
}

}  // namespace

double at_rest_since(const ErrorTrace& trace, double start, double dt, const GapEvent& event,
                     double half_period, double rest) {
  const std::vector<double>& error = trace.error;
  const double flight = event.t2 - event.t1;
  if (error.empty() || !(flight > 0.0)) return kNaN;
  const auto index = [&](double time) { return nearest(time, start, dt, error.size()); };
  const std::size_t from = index(event.t1), end = index(event.t2 + flight);
  const std::size_t reach = index(event.t1 - (half_period > 0.0 ? half_period : 10.0 * flight));
  double largest = 0.0;
  for (std::size_t i = from; i <= end; ++i) largest = std::max(largest, std::abs(error[i]));
  const double quiet = std::max(kQuietError * largest, rest);
  std::size_t i = from;
  const std::size_t patience = index(event.t1 - 0.25 * flight);
  while (i > patience && !(std::abs(error[i]) <= quiet)) --i;
  if (!(std::abs(error[i]) <= quiet)) return kNaN;
  while (i > reach && std::abs(error[i - 1]) <= quiet) --i;
  return i == reach ? kNaN : start + dt * static_cast<double>(i);
}

void keep_traces(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                 double bound, Discretisation discretisation, GapEstimate& estimate) {
  if (!(bound > 0.0)) return;
  for (const MotorTrace& recording : recordings)
    estimate.traces.push_back(trace_of(recording, bound, discretisation));
  estimate.scale = scale_of(facts, estimate.traces);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (!facts[i].defect.empty()) continue;
    const double dt = recordings[i].dt,
                 rest = 2.0 * chatter_floors(facts[i], dt, {&bound, 1}, discretisation)[0];
    for (GapEvent& event : estimate.events)
      if (recordings[i].file == event.file)
        event.t_c =
            at_rest_since(estimate.traces[i], recordings[i].start, dt, event, facts[i].half_period, rest);
  }
}

}  // namespace gapscope::internal::sliding_mode
