#include "gapscope/sliding_mode/detector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sliding_mode/bound_map.h"
#include "sliding_mode/drawn_bound.h"
#include "sliding_mode/impact_search.h"
#include "sliding_mode/kept_traces.h"
#include "sliding_mode/published/one_bound.h"
#include "sliding_mode/verdict/verdict.h"
#include "sliding_mode/words.h"

namespace gapscope {
namespace {

using internal::signals::SignalFacts;
using internal::sliding_mode::GapEvidence;
using internal::sliding_mode::ImpactAnalysis;
using internal::sliding_mode::LoopSearch;
namespace words = internal::sliding_mode::words;

/// The recordings with what they say about themselves, one entry each.
struct Inputs {
  std::span<const MotorTrace> recordings;
  std::vector<SignalFacts> facts;
};

/// Median over the recordings of the bound that decides t2.
double deciding_bound(std::span<const ImpactAnalysis> analyses) {
  std::vector<double> bounds;
  for (const ImpactAnalysis& a : analyses)
    if (a.facts.defect.empty()) bounds.push_back(a.run.bounds[a.deciding]);
  return median(std::move(bounds));
}

/// What the figures show: e_x of one bound, and the map of the recording with the most accepted passages.
void keep_figures(const Inputs& in, double bound, const DetectorOptions& options, GapEstimate& estimate) {
  internal::sliding_mode::keep_traces(in.recordings, in.facts, bound, Discretisation::kForwardEuler,
                                      estimate);
  if (options.paper_bound > 0.0) estimate.paper_bound = options.paper_bound;
  const auto accepted = [&](const MotorTrace& recording) {
    return std::ranges::count_if(estimate.events,
                                 [&](const GapEvent& e) { return e.accepted && e.file == recording.file; });
  };
  const auto shown = std::ranges::max_element(in.recordings, {}, accepted);
  if (shown != in.recordings.end())
    estimate.map =
        internal::sliding_mode::bound_map(*shown, in.facts[shown - in.recordings.begin()], estimate);
}

/// A reading with one bound says nothing of what another would have read.
void limit_to_bound(GapEstimate& estimate) {
  if (estimate.verdict != GapVerdict::kBacklash) return;
  estimate.trust = GapTrust::kLimited;
  estimate.tested = {{words::same_with_other_bounds(), false}};
  estimate.presumes = {words::one_gap(), words::load_rests(), words::own_encoder()};
}

GapEstimate decide_gap(const Inputs& in, std::span<const ImpactAnalysis> analyses, const LoopSearch& loops,
                       const DetectorOptions& options) {
  return internal::sliding_mode::decide_gap(in.recordings, in.facts, analyses, loops, options);
}

/// One e_x with the bound that was given, and what else reads these recordings where it does not.
GapEstimate detect_paper(const Inputs& in, std::span<const ImpactAnalysis> analyses, const LoopSearch& loops,
                         const DetectorOptions& options) {
  GapEstimate estimate =
      internal::sliding_mode::read_recordings_with_bound(in.recordings, in.facts, options.bound);
  if (options.locked) {
    internal::sliding_mode::speak_of_locked_output(loops, estimate);
  } else if (estimate.verdict != GapVerdict::kBacklash && !std::isnan(estimate.bound)) {
    Remark other = internal::sliding_mode::bounds_to_try(in.recordings, in.facts);
    if (other.empty()) {
      const GapEstimate bank = decide_gap(in, analyses, loops, options);
      other = bank.verdict == GapVerdict::kBacklash ? words::auto_reads() : words::nothing_reads(bank.reason);
    }
    estimate.reason += other;
  }
  keep_figures(in, options.bound, options, estimate);
  limit_to_bound(estimate);
  return estimate;
}

/// Nothing is added, not even what a loop of x1 over u says.
GapEstimate detect_as_printed(const Inputs& in, const DetectorOptions& options) {
  GapEstimate estimate =
      internal::sliding_mode::read_recordings_as_printed(in.recordings, in.facts, options.bound);
  keep_figures(in, options.bound, options, estimate);
  limit_to_bound(estimate);
  return estimate;
}

/// All readings are of the motor's way through the gap, in which the load takes no part.
GapEstimate nothing_from_load(const DetectorOptions& options) {
  GapEvidence none;
  if (options.method == DetectorMethod::kLostMotion)
    none.method = GapMethod::kLostMotion, none.quantity = GapQuantity::kPlayAtZeroTorque;
  if (options.bound > 0.0) none.method = GapMethod::kPaper;
  if (options.method == DetectorMethod::kLiteral) none.method = GapMethod::kLiteral;
  none.against = words::encoder_on_load();
  return internal::sliding_mode::conclude(std::move(none));
}

}  // namespace

const char* to_string(DetectorMethod method) {
  constexpr std::array kWords{"auto", "impact", "lost_motion", "paper", "literal"};
  return kWords[static_cast<std::size_t>(method)];
}

GapEstimate detect_gap(std::span<const MotorTrace> recordings, const DetectorOptions& options) {
  if (options.encoder == EncoderSide::kLoad) return nothing_from_load(options);
  Inputs in{recordings, {}};
  for (const MotorTrace& recording : recordings) in.facts.push_back(internal::signals::read_facts(recording));
  if (options.method == DetectorMethod::kLiteral) return detect_as_printed(in, options);
  const LoopSearch loops = internal::sliding_mode::read_lost_motion(recordings, in.facts);
  std::vector<ImpactAnalysis> analyses;
  const bool only_loop = options.method == DetectorMethod::kLostMotion, paper = options.bound > 0.0;
  for (std::size_t i = 0; i < recordings.size() && !only_loop; ++i)
    analyses.push_back(internal::sliding_mode::analyse(recordings[i], in.facts[i]));
  GapEstimate estimate = only_loop ? internal::sliding_mode::decide_by_loop(loops, options.locked)
                         : paper   ? detect_paper(in, analyses, loops, options)
                                   : decide_gap(in, analyses, loops, options);
  if (loops.found) estimate.lost_motion = loops.found->lost_motion;
  estimate.gap_at_most = std::fmin(estimate.gap_at_most, estimate.lost_motion.gap_limit);
  internal::sliding_mode::hold_against_gap(estimate);
  if (paper || estimate.method == GapMethod::kLostMotion) return estimate;
  estimate.bound = deciding_bound(analyses);
  estimate.bound_t1 = internal::sliding_mode::drawn_bound(recordings, in.facts, estimate.events);
  keep_figures(in, estimate.bound_t1, options, estimate);
  if (options.paper_bound > 0.0 && estimate.verdict == GapVerdict::kBacklash) {
    const GapEstimate published =
        internal::sliding_mode::read_recordings_with_bound(recordings, in.facts, options.paper_bound);
    if (published.verdict != GapVerdict::kBacklash)
      estimate.warnings.push_back(words::paper_bound_misses(options.paper_bound, published.reason));
  }
  return estimate;
}

}  // namespace gapscope
