#include "sliding_mode/marks/bank_run.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

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

double quiet_share(const BankErrors& run, std::size_t bound) {
  std::size_t quiet = 0;
  for (std::size_t i = 0; i < run.samples(); ++i)
    quiet += std::abs(run.error(i, bound)) < 2.0 * run.floor[bound];
  return static_cast<double>(quiet) / static_cast<double>(run.samples());
}

}  // namespace

std::vector<double> chatter_floors(const signals::SignalFacts& facts, double dt,
                                   std::span<const double> bounds, Discretisation discretisation) {
  const auto y = surrogate(facts, dt);
  const auto ramp = run_errors(y, dt, started(y[0], 0.5 * facts.speed_rms, dt, bounds, discretisation));
  std::vector<double> floors;
  for (std::size_t j = 0; j < bounds.size(); ++j) {
    const double chatter = quantile(column(ramp, bounds.size(), j, kSettle), 0.999);
    floors.push_back(std::max({chatter, 1.5 * facts.noise, 1e-12 * facts.amplitude}));
  }
  return floors;
}

void raise_by_lag(BankRun& run, double dt) {
  const double lag = run.bounds[smallest_sliding(run)] * dt * dt;
  for (double& floor : run.floor) floor = std::max(floor, lag);
}

std::size_t smallest_sliding(const BankRun& run) {
  for (std::size_t j = 0; j < run.quiet.size(); ++j)
    if (run.quiet[j] >= 0.8) return j;
  return run.bounds.size() - 1;
}

std::vector<double> bound_grid(const signals::SignalFacts& facts, double dt) {
  const double omega = std::sqrt(2.0) * facts.speed_rms / facts.amplitude;
  const double low = 0.15 * facts.amplitude * omega * omega;
  const double high = std::max(150.0 * low, 0.12 * facts.speed_rms / dt);
  std::vector<double> bounds(kBankBounds);
  for (std::size_t j = 0; j < kBankBounds; ++j)
    bounds[j] = low * std::pow(high / low, static_cast<double>(j) / static_cast<double>(kBankBounds - 1));
  return bounds;
}

BoundBank started_bank(const MotorTrace& trace, const signals::SignalFacts& facts,
                       std::span<const double> bounds, Discretisation discretisation) {
  return started(trace.x1[0], first_speed(trace, facts), trace.dt, bounds, discretisation);
}

BankErrors run_bank(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<double> bounds,
                    Discretisation discretisation) {
  BankErrors run;
  run.floor = chatter_floors(facts, trace.dt, bounds, discretisation);
  run.errors = run_errors(trace.x1, trace.dt, started_bank(trace, facts, bounds, discretisation));
  run.bounds = std::move(bounds);
  const auto count = [&] {
    run.quiet.clear();
    for (std::size_t j = 0; j < run.bounds.size(); ++j) run.quiet.push_back(quiet_share(run, j));
  };
  count();
  if (discretisation == Discretisation::kForwardEuler) return run;  // its chatter of O(L dt²) covers the lag
  raise_by_lag(run, trace.dt);
  count();
  return run;
}

}  // namespace gapscope::internal::sliding_mode
