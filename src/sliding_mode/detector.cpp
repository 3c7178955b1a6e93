#include "gapscope/sliding_mode/detector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "signals/folding.h"
#include "sliding_mode/bound_map.h"
#include "sliding_mode/frozen_search.h"
#include "sliding_mode/impact_method.h"
#include "sliding_mode/kept_traces.h"
#include "sliding_mode/loop_verdict.h"
#include "sliding_mode/lost_motion.h"
#include "sliding_mode/paper_method.h"
#include "sliding_mode/pooled_reading.h"
#include "sliding_mode/told_events.h"
#include "sliding_mode/verdict.h"
#include "sliding_mode/words.h"

namespace gapscope {
namespace {

using internal::signals::SignalFacts;
using internal::sliding_mode::ImpactAnalysis;
using internal::sliding_mode::keep_traces;
using internal::sliding_mode::LoopSearch;
using internal::sliding_mode::PaperReading;
namespace words = internal::sliding_mode::words;

/// Of the passages. 0.2 withholds two right readings (871011, 871106 gap sine: 0.54); 1 tells nothing more.
constexpr double kFewMovingLoads = 0.6;

std::vector<PaperReading> read_all(std::span<const MotorTrace> recordings,
                                   std::span<const ImpactAnalysis> analyses, double bound) {
  std::vector<PaperReading> readings;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    readings.push_back(internal::sliding_mode::read_with_bound(recordings[i], analyses[i], bound));
  return readings;
}

GapEstimate decide_paper(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                         double bound) {
  return internal::sliding_mode::decide_with_bound(analyses, read_all(recordings, analyses, bound));
}

struct Reading {
  double bound, gap;
};

/// The bounds of the grid with which one e_x reads these recordings, and what it reads.
std::vector<Reading> readable_bounds(std::span<const MotorTrace> recordings,
                                     std::span<const ImpactAnalysis> analyses) {
  std::vector<Reading> found;
  const auto usable = std::find_if(analyses.begin(), analyses.end(),
                                   [](const ImpactAnalysis& a) { return a.facts.defect.empty(); });
  if (usable == analyses.end()) return found;
  for (const double bound : usable->run.bounds) {
    const GapEstimate reading = decide_paper(recordings, analyses, bound);
    if (reading.verdict == GapVerdict::kBacklash) found.push_back({bound, reading.gap});
  }
  return found;
}

/// The bound whose e_x shows t1 and t2 best, for the figures: of those that read the recordings, the one
/// closest to the estimate; without any, the smallest that slides.
double bound_that_shows(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                        const GapEstimate& estimate, double otherwise) {
  if (estimate.verdict != GapVerdict::kBacklash) return otherwise;
  const auto found = readable_bounds(recordings, analyses);
  const auto best = std::min_element(found.begin(), found.end(), [&](const Reading& a, const Reading& b) {
    return std::abs(a.gap - estimate.gap) < std::abs(b.gap - estimate.gap);
  });
  return best == found.end() ? otherwise : best->bound;
}

/// Median over the recordings of a bound that each analysis chose.
double typical_bound(std::span<const ImpactAnalysis> analyses, std::size_t ImpactAnalysis::*index) {
  std::vector<double> bounds;
  for (const ImpactAnalysis& a : analyses)
    if (a.facts.defect.empty()) bounds.push_back(a.run.bounds[a.*index]);
  return median(std::move(bounds));
}

/// The map of the recording with the most accepted passages.
/// @param facts  one per recording
void keep_map(std::span<const MotorTrace> recordings, std::span<const SignalFacts> facts,
              const DetectorOptions& options, GapEstimate& estimate) {
  if (options.paper_bound > 0.0) estimate.paper_bound = options.paper_bound;
  std::size_t shown = 0;
  std::ptrdiff_t most = -1;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const auto accepted =
        std::count_if(estimate.events.begin(), estimate.events.end(),
                      [&](const GapEvent& e) { return e.accepted && e.file == recordings[i].file; });
    if (accepted > most) most = accepted, shown = i;
  }
  if (!recordings.empty())
    estimate.map = internal::sliding_mode::bound_map(recordings[shown], facts[shown], estimate);
}

void warn_of_paper_bound(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                         double bound, GapEstimate& estimate) {
  const GapEstimate paper = decide_paper(recordings, analyses, bound);
  if (paper.verdict == GapVerdict::kBacklash) return;
  estimate.warnings.push_back(words::paper_bound_misses(bound, paper.reason));
}

/// Most passages say that a force drives the load. Then neither does their mean tell a gap, whose noise is
/// small enough to show how the contact rings (5450008 gap triangle wide pushed, 25 % too large), nor all of
/// them together, which show no release.
bool load_is_pushed(std::span<const ImpactAnalysis> analyses) {
  std::ptrdiff_t pushed = 0, all = 0;
  for (const ImpactAnalysis& a : analyses) {
    all += std::ssize(a.passages);
    pushed += std::ranges::count(a.passages, internal::sliding_mode::Refusal::kPushed,
                                 &internal::sliding_mode::Transition::refusal);
  }
  return 2 * pushed > all;
}

/// Where single periods show too little: the mean period of every recording that repeats itself.
/// @returns whether a force drives the load, as those means tell
bool read_mean_periods(std::span<const MotorTrace> recordings, std::vector<ImpactAnalysis>& analyses,
                       GapEstimate& estimate) {
  std::vector<ImpactAnalysis> means;
  std::vector<double> intervals;
  std::vector<GapEvent> events;
  std::size_t periods = 0;
  for (const MotorTrace& recording : recordings) {
    const internal::signals::FoldedMotion folded = internal::signals::fold(recording);
    if (folded.periods == 0) continue;
    means.push_back(internal::sliding_mode::analyse_mean(folded, recording));
    intervals.push_back(folded.dt);
    periods += folded.periods;
    for (const GapEvent& event : internal::sliding_mode::events_of_mean(folded, means.back().passages))
      events.push_back(event);
  }
  if (means.empty()) return false;
  GapEstimate reading = internal::sliding_mode::decide_gap(means, intervals);
  if (reading.verdict != GapVerdict::kBacklash) return load_is_pushed(means);
  estimate = std::move(reading);
  estimate.events = std::move(events);
  const auto used = std::ranges::count_if(estimate.events, &GapEvent::accepted);
  estimate.reason = words::passages_used(used, std::ssize(estimate.events), 0);
  estimate.reason += words::mean_of_periods(static_cast<long>(periods));
  if (means.size() == recordings.size()) analyses = std::move(means);  // else some repeat nothing
  return false;
}

std::vector<SignalFacts> facts_of(std::span<const MotorTrace> recordings) {
  std::vector<SignalFacts> facts;
  for (const MotorTrace& recording : recordings) facts.push_back(internal::signals::read_facts(recording));
  return facts;
}

/// The loop alone.
GapEstimate by_loop(const LoopSearch& loops) {
  if (loops.estimate) return *loops.estimate;
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.method = GapMethod::kLostMotion;
  estimate.quantity = GapQuantity::kPlayAtZeroTorque;
  estimate.reason = words::no_loop(loops.why_not);
  return estimate;
}

/// As a stream would tell it.
GapEstimate detect_frozen(std::span<const MotorTrace> recordings, const DetectorOptions& options) {
  GapEstimate estimate;
  std::vector<ImpactAnalysis> analyses;
  std::vector<double> intervals;
  for (const MotorTrace& recording : recordings) {
    analyses.push_back(internal::sliding_mode::analyse_frozen(recording));
    intervals.push_back(recording.dt);
  }
  estimate = internal::sliding_mode::decide_gap(analyses, intervals);
  estimate.bound = typical_bound(analyses, &ImpactAnalysis::deciding);
  estimate.bound_t1 = typical_bound(analyses, &ImpactAnalysis::sliding);
  keep_traces(recordings, analyses, estimate.bound_t1, Discretisation::kForwardEuler, estimate);
  keep_map(recordings, facts_of(recordings), options, estimate);
  return estimate;
}

/// Few passages say that the load moved into them: that the torque changes its sign then tells no release.
bool load_rests(std::span<const ImpactAnalysis> analyses) {
  std::size_t moving = 0, all = 0;
  for (const ImpactAnalysis& a : analyses)
    for (const auto& t : a.passages) {
      ++all;
      moving += internal::sliding_mode::speaks_of_moving_load(t.refusal);
    }
  return static_cast<double>(moving) <= kFewMovingLoads * static_cast<double>(all);
}

/// The bank of bounds, by single periods or by their mean; the loop where that tells no gap.
GapEstimate detect_auto(std::span<const MotorTrace> recordings, std::vector<ImpactAnalysis>& analyses,
                        std::span<const double> intervals, std::span<const SignalFacts> facts,
                        const LoopSearch& loops, const DetectorOptions& options) {
  GapEstimate estimate = internal::sliding_mode::decide_gap(analyses, intervals);
  bool pushed = load_is_pushed(analyses);
  if (estimate.verdict != GapVerdict::kBacklash && !pushed)
    pushed = read_mean_periods(recordings, analyses, estimate);
  if (estimate.verdict != GapVerdict::kBacklash && !options.locked && !pushed && load_rests(analyses))
    if (const auto pooled = internal::sliding_mode::read_pooled(recordings, facts)) return *pooled;
  const bool ask_loop = options.method == DetectorMethod::kAuto && (loops.decides || options.locked);
  if (estimate.verdict != GapVerdict::kBacklash && loops.estimate && ask_loop) return *loops.estimate;
  if (options.locked) internal::sliding_mode::speak_of_locked_output(loops, estimate);
  return estimate;
}

/// What else reads these recordings.
Remark bounds_to_try(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                     std::span<const SignalFacts> facts, const LoopSearch& loops,
                     const DetectorOptions& options) {
  const auto found = readable_bounds(recordings, analyses);
  if (found.size() == 1) return words::bound_to_try(found.front().bound);
  if (found.size() > 1) return words::bounds_to_try(found.front().bound, found.back().bound);
  std::vector<ImpactAnalysis> bank(analyses.begin(), analyses.end());
  std::vector<double> intervals;
  for (const MotorTrace& recording : recordings) intervals.push_back(recording.dt);
  const GapEstimate reading = detect_auto(recordings, bank, intervals, facts, loops, options);
  return reading.verdict == GapVerdict::kBacklash ? words::auto_reads()
                                                  : words::nothing_reads(reading.reason);
}

/// One e_x with the bound that was given.
GapEstimate detect_paper(std::span<const MotorTrace> recordings, std::span<const ImpactAnalysis> analyses,
                         std::span<const SignalFacts> facts, const LoopSearch& loops,
                         const DetectorOptions& options) {
  GapEstimate estimate = decide_paper(recordings, analyses, options.bound);
  if (options.locked)
    internal::sliding_mode::speak_of_locked_output(loops, estimate);
  else if (estimate.verdict != GapVerdict::kBacklash && !std::isnan(estimate.bound))
    estimate.reason += bounds_to_try(recordings, analyses, facts, loops, options);
  keep_traces(recordings, analyses, options.bound, Discretisation::kForwardEuler, estimate);
  keep_map(recordings, facts, options, estimate);
  return estimate;
}

/// Both readings are of the motor's way through the gap, in which the load takes no part.
GapEstimate nothing_from_load(const DetectorOptions& options) {
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kInconclusive;
  if (options.method == DetectorMethod::kLostMotion)
    estimate.method = GapMethod::kLostMotion, estimate.quantity = GapQuantity::kPlayAtZeroTorque;
  if (options.bound > 0.0) estimate.method = GapMethod::kPaper;
  estimate.reason = words::encoder_on_load();
  return estimate;
}

}  // namespace

const char* to_string(DetectorMethod method) {
  constexpr std::array kWords{"auto", "impact", "lost_motion", "paper"};
  return kWords[static_cast<std::size_t>(method)];
}

GapEstimate detect_gap(std::span<const MotorTrace> recordings, const DetectorOptions& options) {
  if (options.encoder == EncoderSide::kLoad) return nothing_from_load(options);
  if (options.frozen && !(options.bound > 0.0)) return detect_frozen(recordings, options);
  const std::vector<SignalFacts> facts = facts_of(recordings);
  const auto loops = internal::sliding_mode::read_lost_motion(recordings, facts);
  if (options.method == DetectorMethod::kLostMotion) return by_loop(loops);
  std::vector<ImpactAnalysis> analyses;
  std::vector<double> intervals;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    analyses.push_back(internal::sliding_mode::analyse(recordings[i], facts[i]));
    intervals.push_back(recordings[i].dt);
  }
  const bool paper = options.bound > 0.0;
  GapEstimate estimate = paper ? detect_paper(recordings, analyses, facts, loops, options)
                               : detect_auto(recordings, analyses, intervals, facts, loops, options);
  if (loops.estimate) estimate.lost_motion = loops.estimate->lost_motion;
  internal::sliding_mode::hold_against_gap(estimate);
  if (paper || estimate.method == GapMethod::kLostMotion) return estimate;
  estimate.bound = typical_bound(analyses, &ImpactAnalysis::deciding);
  estimate.bound_t1 =
      bound_that_shows(recordings, analyses, estimate, typical_bound(analyses, &ImpactAnalysis::sliding));
  keep_traces(recordings, analyses, estimate.bound_t1, Discretisation::kForwardEuler, estimate);
  keep_map(recordings, facts, options, estimate);
  if (options.paper_bound > 0.0 && estimate.verdict == GapVerdict::kBacklash)
    warn_of_paper_bound(recordings, analyses, options.paper_bound, estimate);
  return estimate;
}

}  // namespace gapscope
