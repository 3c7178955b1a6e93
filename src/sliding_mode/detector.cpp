#include "gapscope/sliding_mode/detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sliding_mode/impact_method.h"
#include "sliding_mode/paper_method.h"

namespace gapscope {
namespace {

using internal::ImpactAnalysis;
using internal::PaperReading;

std::vector<PaperReading> read_all(std::span<const MotorTrace> recordings,
                                   std::span<const ImpactAnalysis> analyses, double bound) {
  std::vector<PaperReading> readings;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    readings.push_back(internal::read_with_bound(recordings[i], analyses[i], bound));
  return readings;
}

GapEstimate decide_paper(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                         double bound) {
  GapEstimate estimate;
  internal::decide_with_bound(analyses, read_all(recordings, analyses, bound), estimate);
  return estimate;
}

/// Which bounds would have read these recordings, found by trying.
std::string bounds_to_try(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses) {
  const auto usable =
      std::find_if(analyses.begin(), analyses.end(), [](const auto& a) { return a.facts.defect.empty(); });
  if (usable == analyses.end()) return "";
  double low = kInfinity, high = 0.0;
  for (const double bound : usable->run.bounds) {
    if (decide_paper(recordings, analyses, bound).verdict != GapVerdict::kBacklash) continue;
    low = std::min(low, bound);
    high = std::max(high, bound);
  }
  if (high == 0.0) return "; no single bound reads this recording, use auto";
  if (low == high) return fmt::format("; try L = {:.2g}", low);
  return fmt::format("; try L between {:.2g} and {:.2g}", low, high);
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
double scale_of(std::span<const ImpactAnalysis> analyses, const std::vector<ErrorTrace>& traces) {
  double ratio = 0.0;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    std::vector<double> sizes;
    for (std::size_t k = traces[i].error.size() / 10; k < traces[i].error.size(); ++k)
      sizes.push_back(std::abs(traces[i].error[k]));
    const double peak = quantile(std::move(sizes), 0.998);
    if (peak > 0.0) ratio = std::max(ratio, 0.5 * analyses[i].travel / peak);
  }
  return ratio > 0.0 ? nice_number(ratio) : 1.0;
}

/// The bound that shows t1: of those that see the impacts, the one just above what the engaged motion needs.
double typical_bound(std::span<const ImpactAnalysis> analyses, std::size_t ImpactAnalysis::*index) {
  std::vector<double> bounds;
  for (const ImpactAnalysis& a : analyses)
    if (a.facts.defect.empty()) bounds.push_back(a.run.bounds[a.*index]);
  return median(std::move(bounds));
}

void keep_traces(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                 double bound, Discretisation discretisation, GapEstimate& estimate) {
  if (!(bound > 0.0)) return;
  for (const MotorTrace& recording : recordings)
    estimate.traces.push_back(trace_of(recording, bound, discretisation));
  estimate.scale = scale_of(analyses, estimate.traces);
}

void warn_of_paper_bound(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                         double bound, GapEstimate& estimate) {
  const GapEstimate paper = decide_paper(recordings, analyses, bound);
  if (paper.verdict == GapVerdict::kBacklash) return;
  estimate.warnings.push_back(
      fmt::format("one e_x with L = {:.3g} rad/s² would have missed the passages: {}", bound, paper.reason));
}

}  // namespace

GapEstimate detect_gap(std::span<const MotorTrace> recordings, const DetectorOptions& options) {
  GapEstimate estimate;
  std::vector<ImpactAnalysis> analyses;
  std::vector<double> intervals;
  for (const MotorTrace& recording : recordings) {
    analyses.push_back(internal::analyse(recording));
    intervals.push_back(recording.dt);
  }
  if (options.bound > 0.0) {
    estimate = decide_paper(recordings, analyses, options.bound);
    if (estimate.verdict != GapVerdict::kBacklash) estimate.reason += bounds_to_try(recordings, analyses);
    keep_traces(recordings, analyses, options.bound, Discretisation::kForwardEuler, estimate);
    return estimate;
  }
  internal::decide(analyses, intervals, estimate);
  estimate.bound = typical_bound(analyses, &ImpactAnalysis::deciding);
  estimate.bound_t1 = typical_bound(analyses, &ImpactAnalysis::sliding);
  keep_traces(recordings, analyses, estimate.bound_t1, Discretisation::kForwardEuler, estimate);
  if (options.paper_bound > 0.0) warn_of_paper_bound(recordings, analyses, options.paper_bound, estimate);
  return estimate;
}

}  // namespace gapscope
