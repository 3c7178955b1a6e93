#include "sliding_mode/marks/bank_marks.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kRowsAtOnce = 1024;  // samples whose errors are held at once

/// Hands `look` the index and the errors of all bounds of each sample.
template <class Look>
void each_row(std::span<const double> y, double dt, BoundBank bank, const Look& look) {
  const std::size_t m = bank.size();
  std::vector<double> errors(kRowsAtOnce * m);
  for (std::size_t first = 0; first < y.size(); first += kRowsAtOnce) {
    const auto part = y.subspan(first, std::min(kRowsAtOnce, y.size() - first));
    bank.run(part, dt, errors);
    for (std::size_t i = 0; i < part.size(); ++i) look(first + i, &errors[i * m]);
  }
}

/// How often each bound is quiet, as its errors come.
class QuietCount {
 public:
  explicit QuietCount(const BankRun& run) : run_(run), quiet_(run.bounds.size()) {}

  void step(const double* errors) {
    ++samples_;
    for (std::size_t j = 0; j < quiet_.size(); ++j) quiet_[j] += std::abs(errors[j]) < 2.0 * run_.floor[j];
  }
  std::vector<double> shares() const {
    std::vector<double> shares;
    for (const std::size_t quiet : quiet_)
      shares.push_back(static_cast<double>(quiet) / static_cast<double>(samples_));
    return shares;
  }

 private:
  const BankRun& run_;
  std::vector<std::size_t> quiet_;
  std::size_t samples_ = 0;
};

/// Finds the excursions of one bound as its errors come.
class ExcursionFinder {
 public:
  ExcursionFinder(std::size_t bound, double floor) : bound_(bound), floor_(floor) {}

  void step(std::size_t i, double e) {
    if (open_) {
      const double height = e * x_.sign;
      if (height > x_.height) x_.height = height, x_.peak = i;
      if (height > 0.5 * floor_) return;
      close(i);
    }
    if (!(e > floor_)) within_[1] = i;
    if (!(-e > floor_)) within_[0] = i;
    if (!(std::abs(e) > 2.0 * floor_)) return;  // also what is no number
    const bool up = e > 0.0;
    x_ = {bound_, up ? 1 : -1, std::max(free_from_, within_[up]), i, i, std::abs(e)};
    open_ = true;
  }

  /// Ends what lasts until the last sample.
  std::vector<Excursion> found(std::size_t samples) {
    if (open_) close(samples);
    return std::move(found_);
  }

 private:
  void close(std::size_t end) {
    x_.end = end;
    free_from_ = end - 1;
    found_.push_back(x_);
    open_ = false;
  }

  std::size_t bound_;
  double floor_;
  std::size_t within_[2] = {0, 0};  ///< last sample that is not below, not above the floor
  std::size_t free_from_ = 0;       ///< samples before this belong to the last excursion
  bool open_ = false;
  Excursion x_;
  std::vector<Excursion> found_;
};

/// Fills in the marks of a bank as its errors come.
class MarkFinder {
 public:
  MarkFinder(BankMarks& marks, std::size_t samples) : marks_(marks) {
    GAPSCOPE_REQUIRE(marks.bounds.size() <= 32);
    marks.loud.reserve(samples);
    for (std::size_t j = 0; j < marks.bounds.size(); ++j) finders_.emplace_back(j, marks.floor[j]);
  }

  void step(std::size_t i, const double* errors) {
    std::uint32_t loud = 0;
    for (std::size_t j = 0; j < finders_.size(); ++j) {
      finders_[j].step(i, errors[j]);
      loud |= static_cast<std::uint32_t>(std::abs(errors[j]) > 2.0 * marks_.floor[j]) << j;
    }
    marks_.loud.push_back(loud);
    const std::size_t highest = finders_.size() - 1;
    if (marks_.is_loud(i, highest)) marks_.at_highest.push_back({i, std::abs(errors[highest])});
  }
  void finish() {
    for (ExcursionFinder& finder : finders_) marks_.excursions.push_back(finder.found(marks_.loud.size()));
  }

 private:
  BankMarks& marks_;
  std::vector<ExcursionFinder> finders_;
};

}  // namespace

BankMarks mark_bank(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<double> bounds) {
  BankMarks marks;
  marks.floor = chatter_floors(facts, trace.dt, bounds, Discretisation::kMatched);
  const BoundBank bank = started_bank(trace, facts, bounds, Discretisation::kMatched);
  marks.bounds = std::move(bounds);
  QuietCount before(marks);
  each_row(trace.x1, trace.dt, bank, [&](std::size_t, const double* e) { before.step(e); });
  marks.quiet = before.shares();
  raise_by_lag(marks, trace.dt);
  QuietCount after(marks);
  MarkFinder finder(marks, trace.size());
  each_row(trace.x1, trace.dt, bank,
           [&](std::size_t i, const double* e) { after.step(e), finder.step(i, e); });
  finder.finish();
  marks.quiet = after.shares();
  return marks;
}

double BankMarks::highest_peak(std::size_t from, std::size_t to) const {
  double most = 0.0;
  for (auto at = std::ranges::lower_bound(at_highest, from, {}, &Height::sample);
       at != at_highest.end() && at->sample < to; ++at)
    most = std::max(most, at->height);
  return most;
}

BankMarks marks_of(const BankErrors& run) {
  BankMarks marks{run, {}, {}, {}};
  MarkFinder finder(marks, run.samples());
  for (std::size_t i = 0; i < run.samples(); ++i) finder.step(i, &run.errors[i * run.bounds.size()]);
  finder.finish();
  return marks;
}

std::vector<Excursion> find_excursions(const BankErrors& run, std::size_t bound) {
  ExcursionFinder finder(bound, run.floor[bound]);
  for (std::size_t i = 0; i < run.samples(); ++i) finder.step(i, run.error(i, bound));
  return finder.found(run.samples());
}

double abruptness(const BankRun& run, std::size_t bound, double height) {
  const bool is_highest = bound + 1 == run.bounds.size();
  return run.bounds[bound] * (is_highest ? height / (2.0 * run.floor[bound]) : 1.0);
}

namespace {

void join(BankEvent& event, const Excursion& x, double k2) {
  event.last = x.bound;
  ++event.seen;
  if (event.seen <= 4 && x.peak > event.start) event.latency = std::max(event.latency, x.peak - event.start);
  if (event.steps.size() < 3) event.steps.push_back(std::sqrt(k2 * x.height / kStepPeak));
}

}  // namespace

std::vector<BankEvent> link_events(const BankRun& run, const std::vector<std::vector<Excursion>>& excursions,
                                   std::size_t tolerance) {
  std::vector<BankEvent> events;
  for (std::size_t j = excursions.size(); j-- > 0;) {
    std::sort(events.begin(), events.end(),
              [](const BankEvent& a, const BankEvent& b) { return a.start < b.start; });
    const std::size_t known = events.size();
    const double k2 = SuperTwistingGains::from_bound(run.bounds[j]).k2;
    for (const Excursion& x : excursions[j]) {
      bool joined = false;
      const auto first =
          std::partition_point(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(known),
                               [&](const BankEvent& e) { return e.start + tolerance < x.start; });
      for (auto e = first - events.begin(); e < static_cast<std::ptrdiff_t>(known); ++e) {
        BankEvent& event = events[static_cast<std::size_t>(e)];
        if (event.start >= x.end) break;
        if (event.sign != x.sign) continue;
        if (event.last != j) join(event, x, k2);
        joined = true;
      }
      if (joined) continue;
      events.push_back({x.sign, x.start, x.peak, j, j, 0, 0.0, {}, abruptness(run, j, x.height), 0});
      join(events.back(), x, k2);
    }
  }
  std::sort(events.begin(), events.end(),
            [](const BankEvent& a, const BankEvent& b) { return a.start < b.start; });
  for (BankEvent& event : events) event.step = median(event.steps);
  return events;
}

}  // namespace gapscope::internal::sliding_mode
