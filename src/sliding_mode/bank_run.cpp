#include "sliding_mode/bank_run.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/random.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kBounds = 24;
constexpr std::size_t kSurrogate = 3000;  // samples
constexpr std::size_t kSettle = 600;      // of them, not looked at

/// A ramp of half the rms speed as this encoder would read it: what e is while nothing happens.
std::vector<double> surrogate(const signals::SignalFacts& facts, double dt) {
  auto generator = random_stream(1, "surrogate of the chatter floor");
  const double q = facts.quantum;
  const double white = std::sqrt(std::max(facts.noise * facts.noise - q * q / 12.0, 0.0));
  std::vector<double> y(kSurrogate);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double x = 0.5 * facts.speed_rms * dt * static_cast<double>(i) + white * normal(generator);
    y[i] = q > 0.0 ? q * std::round(x / q) : x;
  }
  return y;
}

BoundBank started(double y, double speed, double dt, std::span<const double> bounds,
                  Discretisation discretisation) {
  BoundBank bank(bounds, discretisation);
  bank.start(y - speed * dt, speed);
  return bank;
}

std::vector<double> run_errors(std::span<const double> y, double dt, BoundBank bank) {
  std::vector<double> errors(y.size() * bank.size());
  bank.run(y, dt, errors);
  return errors;
}

std::vector<double> column(const std::vector<double>& errors, std::size_t bounds, std::size_t j,
                           std::size_t from) {
  std::vector<double> values;
  for (std::size_t i = from; i * bounds < errors.size(); ++i)
    values.push_back(std::abs(errors[i * bounds + j]));
  return values;
}

/// Mean speed over the first few samples, for a start without a long transient.
double first_speed(const MotorTrace& trace, const signals::SignalFacts& facts) {
  const auto m = std::clamp<std::size_t>(static_cast<std::size_t>(0.02 * facts.half_period / trace.dt), 1,
                                         trace.size() - 1);
  return (trace.x1[m] - trace.x1[0]) / (trace.dt * static_cast<double>(m));
}

double quiet_share(const BankRun& run, std::size_t bound) {
  std::size_t quiet = 0;
  for (std::size_t i = 0; i < run.samples(); ++i)
    quiet += std::abs(run.error(i, bound)) < 2.0 * run.floor[bound];
  return static_cast<double>(quiet) / static_cast<double>(run.samples());
}

}  // namespace

std::size_t smallest_sliding(const BankRun& run) {
  for (std::size_t j = 0; j < run.quiet.size(); ++j)
    if (run.quiet[j] >= 0.8) return j;
  return run.bounds.size() - 1;
}

std::vector<double> bound_grid(const signals::SignalFacts& facts, double dt) {
  const double omega = std::sqrt(2.0) * facts.speed_rms / facts.amplitude;
  const double low = 0.15 * facts.amplitude * omega * omega;
  const double high = std::max(150.0 * low, 0.12 * facts.speed_rms / dt);
  std::vector<double> bounds(kBounds);
  for (std::size_t j = 0; j < kBounds; ++j)
    bounds[j] = low * std::pow(high / low, static_cast<double>(j) / static_cast<double>(kBounds - 1));
  return bounds;
}

BoundBank started_bank(const MotorTrace& trace, const signals::SignalFacts& facts,
                       std::span<const double> bounds, Discretisation discretisation) {
  return started(trace.x1[0], first_speed(trace, facts), trace.dt, bounds, discretisation);
}

BankRun run_bank(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<double> bounds,
                 Discretisation discretisation) {
  BankRun run;
  run.bounds = std::move(bounds);
  const std::size_t m = run.bounds.size();
  const auto y = surrogate(facts, trace.dt);
  const auto ramp =
      run_errors(y, trace.dt, started(y[0], 0.5 * facts.speed_rms, trace.dt, run.bounds, discretisation));
  run.errors = run_errors(trace.x1, trace.dt, started_bank(trace, facts, run.bounds, discretisation));
  for (std::size_t j = 0; j < m; ++j) {
    const double chatter = quantile(column(ramp, m, j, kSettle), 0.999);
    run.floor.push_back(std::max({chatter, 1.5 * facts.noise, 1e-12 * facts.amplitude}));
    run.quiet.push_back(quiet_share(run, j));
  }
  if (discretisation == Discretisation::kForwardEuler)
    return run;  // its chatter of O(L dt²) covers the lag below
  // Steps that do not chatter lag by ÿ dt² instead, which the ramp does not show.
  const double lag = run.bounds[smallest_sliding(run)] * trace.dt * trace.dt;
  for (std::size_t j = 0; j < m; ++j) {
    run.floor[j] = std::max(run.floor[j], lag);
    run.quiet[j] = quiet_share(run, j);
  }
  return run;
}

std::vector<Excursion> find_excursions(const BankRun& run, std::size_t bound) {
  std::vector<Excursion> found;
  const double floor = run.floor[bound];
  const std::size_t n = run.samples();
  std::size_t free_from = 0;  // samples before this belong to the last excursion
  for (std::size_t i = 0; i < n; ++i) {
    const double e = run.error(i, bound);
    if (!(std::abs(e) > 2.0 * floor)) continue;  // also what is no number
    Excursion x{bound, e > 0.0 ? 1 : -1, i, i, i, 0.0};
    while (x.start > free_from && run.error(x.start, bound) * x.sign > floor) --x.start;
    for (x.end = i; x.end < n && run.error(x.end, bound) * x.sign > 0.5 * floor; ++x.end) {
      if (run.error(x.end, bound) * x.sign <= x.height) continue;
      x.height = run.error(x.end, bound) * x.sign;
      x.peak = x.end;
    }
    free_from = i = x.end - 1;
    found.push_back(x);
  }
  return found;
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
  if (event.steps.size() < 3) event.steps.push_back(std::sqrt(k2 * x.height / 0.102));
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
