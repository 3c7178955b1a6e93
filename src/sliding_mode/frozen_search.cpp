#include "sliding_mode/frozen_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sliding_mode/marks/marks.h"
#include "sliding_mode/visible_gap.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kFirstTry = 200;          ///< samples
constexpr std::size_t kMostLearning = 1 << 18;  ///< samples: what is not periodic by then is not waited for
constexpr double kGrowth = 1.25;                ///< from one try to the next
constexpr double kMoving = 0.6;                 ///< of what is learnt from must be half periods
constexpr double kHop = 0.25, kBefore = 2.0, kAfter = 0.5;  ///< of a half period
constexpr double kTurn = 0.6;  ///< of the amplitude: 30 % on either side of the centre

void drop_front(std::vector<double>& values, std::size_t count) {
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

void TurnCounter::step(double y) noexcept {
  low_ = std::min(low_, y);
  high_ = std::max(high_, y);
  const bool fell = high_ - y > threshold_, rose = y - low_ > threshold_;
  if (side_ >= 0 && fell) {
    count_ += side_ > 0;
    side_ = -1;
    low_ = y;
  } else if (side_ <= 0 && rose) {
    count_ += side_ < 0;
    side_ = 1;
    high_ = y;
  }
}

FrozenSearch::FrozenSearch(std::string file, double start, double dt, double quantum, std::size_t most_kept)
    : file_(std::move(file)),
      start_(start),
      dt_(dt),
      quantum_(quantum),
      most_kept_(most_kept),
      next_try_(kFirstTry) {
  frozen_.facts.defect = signals::read_facts({file_, start_, dt_, {}, {}, quantum_}).defect;  // too short
}

MotorTrace FrozenSearch::window() const {
  return {file_, start_ + dt_ * static_cast<double>(offset_), dt_, u_, x1_, quantum_};
}

void FrozenSearch::push(double u, double x1) {
  if (has_learnt()) return go_on(u, x1);
  if (gave_up_) return void(++offset_);
  u_.push_back(u);
  x1_.push_back(x1);
  if (x1_.size() < next_try_ || try_to_learn()) return;
  next_try_ = static_cast<std::size_t>(kGrowth * static_cast<double>(next_try_));
  if (x1_.size() < kMostLearning) return;
  frozen_.facts.defect += words::within_first_samples(static_cast<long>(x1_.size()));
  gave_up_ = true;
  offset_ = x1_.size();
  u_ = x1_ = {};
}

bool FrozenSearch::try_to_learn() {
  const MotorTrace trace = window();
  signals::SignalFacts facts = signals::read_facts(trace);
  const double moving = facts.half_period * static_cast<double>(facts.half_periods);
  if (facts.defect.empty() && moving < kMoving * dt_ * static_cast<double>(trace.size()))
    facts.defect = words::no_steady_motion_yet();
  if (!facts.defect.empty()) {
    frozen_.facts.defect = facts.defect;
    return false;
  }
  learn(facts, trace);
  const std::vector<double> u = std::move(u_), x1 = std::move(x1_);
  u_.clear(), x1_.clear();
  for (std::size_t i = 0; i < x1.size(); ++i) go_on(u[i], x1[i]);
  return true;
}

void FrozenSearch::learn(const signals::SignalFacts& facts, const MotorTrace& trace) {
  const BankMarks run = mark_bank(trace, facts, bound_grid(facts, dt_));
  frozen_.facts = facts;
  frozen_.bounds = run.bounds, frozen_.floor = run.floor, frozen_.quiet = run.quiet;
  frozen_.sliding = smallest_sliding(run);
  const double half_period = facts.half_period / dt_;
  frozen_.least = least_top(all_events(run, half_period), run, facts.half_periods).value_or(0.0);
  for (std::size_t j = 0; j < run.bounds.size(); ++j)
    frozen_.visible.push_back(smallest_visible_gap(trace, facts, run, j));
  frozen_.visible.push_back(kInfinity);
  frozen_.one_body = one_body_visible_gap(trace, facts);
  run_.bounds = run.bounds, run_.floor = run.floor, run_.quiet = run.quiet;
  bank_.push_back(started_bank(trace, facts, run.bounds, Discretisation::kMatched));
  turns_ = TurnCounter(kTurn * facts.amplitude);
  tops_.assign(run.bounds.size(), 0);
  const auto samples = [&](double share) { return static_cast<std::size_t>(std::ceil(share * half_period)); };
  hop_ = samples(kHop), before_ = samples(kBefore), after_ = samples(kAfter);
  frozen_.samples = trace.size();  // last: half of it would be nothing to go on with
}

void FrozenSearch::go_on(double u, double x1) {
  u_.push_back(u);
  x1_.push_back(x1);
  turns_.step(x1);
  if (samples() == core_ + hop_ + after_) read_core(core_ + hop_);
}

void FrozenSearch::finish() {
  if (!has_learnt() && !gave_up_) try_to_learn();
  if (!has_learnt()) return;
  while (core_ < samples()) read_core(std::min(core_ + hop_, samples()));
}

/// Impacts in [core_, end), read from all samples of the window.
void FrozenSearch::read_core(std::size_t end) {
  const std::size_t m = run_.bounds.size(), known = run_.errors.size() / m;
  run_.errors.resize(x1_.size() * m);
  bank_.front().run(std::span<const double>(x1_).subspan(known), dt_,
                    std::span(run_.errors).subspan(known * m));
  const MotorTrace trace = window();
  const BankMarks marks = marks_of(run_);
  const PassageContext context{trace, frozen_.facts, marks};
  const double half_period = frozen_.facts.half_period / dt_;
  const std::vector<BankEvent> events =
      main_events(all_events(marks, half_period), marks, frozen_.least, half_period);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::size_t start = offset_ + events[i].start;
    if (start < core_ || start >= end) continue;
    ++marks_;
    ++tops_[events[i].top];
    if (i == 0 || start <= last_impact_) continue;
    if (events[i].sign == events[i - 1].sign) {
      if (!kept_.empty()) see_later(kept_.back().passage, trace, events[i]);
      continue;
    }
    last_impact_ = start;
    keep(read_passage(context, events[i - 1], events[i], frozen_.bounds[frozen_.sliding]), marks_);
  }
  core_ = end;
  const std::size_t gone = std::min(core_ - std::min(core_, before_ + offset_), x1_.size());
  drop_front(u_, gone), drop_front(x1_, gone), drop_front(run_.errors, gone * m);
  offset_ += gone;
}

void FrozenSearch::keep(Passage passage, std::size_t mark) {
  ++passages_;
  fresh_.push_back(passage);
  kept_.push_back({std::move(passage), half_periods(), mark});
  if (kept_.size() <= most_kept_) return;
  half_periods_gone_ = kept_.front().half_periods, marks_gone_ = kept_.front().marks;
  kept_.pop_front();
}

std::vector<Passage> FrozenSearch::take() { return std::exchange(fresh_, {}); }

ImpactAnalysis FrozenSearch::summary() const {
  ImpactAnalysis a;
  a.facts = frozen_.facts;
  if (!has_learnt()) return a;
  a.facts.half_periods = half_periods() - std::min(half_periods(), half_periods_gone_);
  a.run.bounds = frozen_.bounds, a.run.floor = frozen_.floor, a.run.quiet = frozen_.quiet;
  a.sliding = frozen_.sliding;
  a.deciding = top_bound(tops_, kMiddle, a.sliding);
  a.marks = marks_ - marks_gone_;
  a.smallest_visible_gap = frozen_.visible[top_bound(tops_, kMostTops, a.sliding) + 1];
  a.finest_gap = frozen_.visible[a.sliding];
  a.one_body_gap = frozen_.one_body;
  for (const KeptPassage& k : kept_) a.passages.push_back(k.passage);
  return a;
}

}  // namespace gapscope::internal::sliding_mode
