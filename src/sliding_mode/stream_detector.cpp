#include "gapscope/sliding_mode/stream_detector.h"

#include "base/require.h"
#include "sliding_mode/frozen_search.h"
#include "sliding_mode/verdict/verdict.h"

namespace gapscope {

struct StreamDetector::State {
  double start, dt;
  internal::sliding_mode::FrozenSearch search;
};

StreamDetector::StreamDetector(double start, double dt, double quantum) {
  GAPSCOPE_REQUIRE(dt > 0.0);
  state_ = std::make_unique<State>(State{start, dt, {"", start, dt, quantum, kMostJudged}});
}

StreamDetector::~StreamDetector() = default;
StreamDetector::StreamDetector(StreamDetector&&) noexcept = default;
StreamDetector& StreamDetector::operator=(StreamDetector&&) noexcept = default;

void StreamDetector::push(double u, double x1) { state_->search.push(u, x1); }
void StreamDetector::finish() { state_->search.finish(); }
bool StreamDetector::has_learnt() const { return state_->search.has_learnt(); }
std::size_t StreamDetector::passages() const { return state_->search.passages(); }

LearntFacts StreamDetector::learnt() const {
  LearntFacts l;
  if (!has_learnt()) return l;
  const internal::sliding_mode::FrozenFacts& f = state_->search.frozen();
  l.until = state_->start + state_->dt * static_cast<double>(f.samples - 1);
  l.half_period = f.facts.half_period;
  l.quantum = f.facts.quantum;
  l.noise = f.facts.noise;
  l.travel = f.facts.travel;
  l.sliding_bound = f.bounds[f.sliding];
  l.least_bound = f.least;
  l.bounds = f.bounds;
  l.floors = f.floor;
  return l;
}

std::vector<GapEvent> StreamDetector::take() {
  std::vector<GapEvent> events;
  for (const internal::sliding_mode::Passage& t : state_->search.take())
    events.push_back(internal::sliding_mode::event_of(t));
  return events;
}

GapEstimate StreamDetector::estimate() const {
  const internal::sliding_mode::ImpactAnalysis analysis = state_->search.summary();
  GapEstimate estimate = internal::sliding_mode::decide_stream(analysis, state_->dt);
  if (has_learnt()) estimate.bound = analysis.run.bounds[analysis.deciding];
  estimate.events.clear();
  return estimate;
}

}  // namespace gapscope
