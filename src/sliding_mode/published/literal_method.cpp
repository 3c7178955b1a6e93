#include "sliding_mode/published/literal_method.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/super_twisting.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

// What S1 to S6 leave to the eye, and a program must know; docs/against_the_paper.md has half and double of
// each.

/// S2, "e_x ≈ 0 with respect to noise": within so many standard deviations of a sample, and
constexpr double kNoises = 4.0;
/// so many k2 T², of which forward Euler leaves 1.03 where nothing else happens.
constexpr double kChatters = 2.0;
/// S2, "after zero convergence", and S4, "abrupt": a hundredth of a period.
constexpr double kPauseOfHalfPeriod = 0.02;

/// Samples at which e_x is off zero on one side, with no pause between them.
struct Swing {
  std::size_t begin = 0, peak = 0, last = 0;  ///< samples; peak: of |e_x|
  double sign = 0.0, height = 0.0;            ///< of e_x at the peak [rad]
};

/// Eqs. (5) and (6).
std::vector<double> estimation_error(const MotorTrace& trace, double bound) {
  SuperTwistingDifferentiator differentiator(bound);
  std::vector<double> error;
  for (const double y : trace.x1) error.push_back(differentiator.step(y, trace.dt).error);
  return error;
}

std::vector<Swing> swings_of(std::span<const double> error, double rest, double pause) {
  std::vector<Swing> swings;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double size = std::abs(error[i]), sign = error[i] < 0.0 ? -1.0 : 1.0;
    if (!(size > rest)) continue;
    const bool goes_on =
        !swings.empty() && swings.back().sign == sign && static_cast<double>(i - swings.back().last) < pause;
    if (!goes_on) swings.push_back({i, i, i, sign, 0.0});
    Swing& swing = swings.back();
    swing.last = i;
    if (size > swing.height) swing.peak = i, swing.height = size;
  }
  return swings;
}

/// S5.
GapEvent passage(const MotorTrace& trace, const Swing& swing) {
  GapEvent event;
  event.file = trace.file;
  event.t1 = trace.time(swing.begin), event.t2 = trace.time(swing.peak);
  event.x1_t1 = trace.x1[swing.begin], event.x1_t2 = trace.x1[swing.peak];
  event.gap = event.gap_uncorrected = std::abs(event.x1_t2 - event.x1_t1);
  event.direction = event.x1_t2 > event.x1_t1 ? 1 : -1;
  return event;
}

/// Square root of the mean square about the mean, for a sample of the passages [rad].
double scatter(std::span<const double> gaps) {
  const double centre = mean(gaps);
  double sum = 0.0;
  for (const double gap : gaps) sum += (gap - centre) * (gap - centre);
  return gaps.size() < 2 ? kNaN : std::sqrt(sum / static_cast<double>(gaps.size() - 1));
}

}  // namespace

std::vector<GapEvent> passages_as_printed(const MotorTrace& trace, const signals::SignalFacts& facts,
                                          double bound) {
  const std::vector<double> error = estimation_error(trace, bound);
  const double chatter = SuperTwistingGains::from_bound(bound).k2 * trace.dt * trace.dt;
  const double pause = kPauseOfHalfPeriod * facts.half_period / trace.dt;
  const auto swings = swings_of(error, kNoises * facts.noise + kChatters * chatter, pause);
  const auto apart = [&](std::size_t before, std::size_t after) {
    return static_cast<double>(after - before) >= pause;
  };
  std::vector<GapEvent> passages;
  for (std::size_t i = 1; i + 1 < swings.size(); ++i) {
    const Swing &before = swings[i - 1], &swing = swings[i], &next = swings[i + 1];
    const bool converged = apart(before.last, swing.begin);                           // S2
    const bool reverses = next.sign != swing.sign && !apart(swing.last, next.begin);  // S4
    // S3: in the gap the motor runs ahead of its estimate, so e_x diverges the way it goes; an impact alone
    // throws e_x the other way.
    const bool diverges = swing.sign * (trace.x1[swing.peak] - trace.x1[swing.begin]) > 0.0;
    if (converged && diverges && reverses) passages.push_back(passage(trace, swing));
  }
  return passages;
}

GapEstimate mean_as_printed(std::span<const signals::SignalFacts> facts,
                            std::span<const std::vector<GapEvent>> passages, double bound) {
  GapEstimate estimate;
  estimate.method = GapMethod::kLiteral;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.reason = words::no_recording();
  double half_periods = 0.0;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (!facts[i].defect.empty()) estimate.reason = facts[i].defect;
    if (facts[i].defect.empty()) half_periods += static_cast<double>(facts[i].half_periods);
    for (const GapEvent& event : passages[i]) gaps.push_back(event.gap), estimate.events.push_back(event);
  }
  if (half_periods == 0.0) return estimate;
  const auto read = static_cast<double>(gaps.size());
  estimate.bound = bound;
  estimate.reason = words::passages_as_printed(read, half_periods, bound);
  if (2.0 * read < half_periods) return estimate;  // Section IV-B: "a sufficiently uniform periodic pattern"
  estimate.verdict = GapVerdict::kBacklash;
  estimate.gap = mean(gaps);
  estimate.std = scatter(gaps);
  return estimate;
}

}  // namespace gapscope::internal::sliding_mode
