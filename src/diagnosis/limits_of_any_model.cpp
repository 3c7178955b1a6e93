#include "diagnosis/limits_of_any_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "gapscope/recording/recording.h"
#include "signals/period.h"

namespace gapscope::internal::diagnosis {
namespace {

struct PooledSize {
  double sum = 0.0, count = 0.0;
  void add(double size, double samples) { sum += size * size * samples, count += samples; }
  double value() const { return count > 0.0 ? std::sqrt(sum / count) : kNaN; }
};

}  // namespace

Repeatability repeatability_of(const std::vector<Playback>& playbacks, const HeldOut& held_out) {
  PooledSize innovation, free, twice, once;
  std::string read_from;
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const double period = held_out.periods[r];
    const std::size_t size = held_out.traces[r].size();
    std::size_t from = std::max(held_out.scored_from[r], held_out.restart(r));
    const auto has = [&](double periods) {
      return static_cast<double>(from) + periods * period <= static_cast<double>(size);
    };
    if (!(period > 0.0) || !has(1.5)) continue;
    if (held_out.scored_from[r] == 0 && has(3.0))
      from += static_cast<std::size_t>(period);  // it starts there
    const double samples = static_cast<double>(size - from) - period;
    read_from += fmt::format("{}{:.1f} periods of {:.3g} s in {}", read_from.empty() ? "" : ", ",
                             static_cast<double>(size - from) / period, period * held_out.traces[r].dt,
                             held_out.traces[r].file);
    innovation.add(signals::repetition_error(playbacks[r].innovation, from, period), samples);
    free.add(signals::repetition_error(playbacks[r].free, from, period), samples);
    if (!has(2.5)) continue;
    once.add(signals::repetition_error(playbacks[r].innovation, from, period), samples);
    twice.add(signals::repetition_error(playbacks[r].innovation, from, 2 * period), samples);
  }
  Repeatability found{innovation.value(), free.value(), true, std::move(read_from)};
  if (twice.count > 0.0) found.stationary = twice.value() < kTelling.drift * once.value();
  return found;
}

namespace {

std::span<const double> supply_of(const MotorTrace& trace) {
  if (trace.command == nullptr) return {};
  return std::span(trace.command->supply).subspan(trace.command_first, trace.size());
}

/// By what the input may have been more or less; empty where nothing is open.
std::vector<double> drawn_factors(const MotorTrace& trace, std::mt19937_64& draw) {
  const std::span<const double> supply = supply_of(trace);
  const double step = supply.empty() ? 0.0 : seen_quantum(supply);
  if (!(step > 0.0)) return {};
  std::vector<double> factors;
  double off = 0.0;
  for (std::size_t i = 0; i < supply.size(); ++i) {
    if (i == 0 || supply[i] != supply[i - 1]) off = uniform(draw, -1.0, 1.0) < 0.0 ? -0.5 * step : 0.5 * step;
    factors.push_back(supply[i] != 0.0 ? 1.0 + off / supply[i] : 1.0);
  }
  return factors;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

bool add_supply_steps(const ReferenceModel& model, double observer_hz, HeldOut& held_out) {
  if (!held_out.free_open.empty()) return false;
  std::mt19937_64 draw = random_stream(0, "steps of the supply");
  HeldOut other = held_out;
  for (const MotorTrace& t : held_out.traces) other.input_factors.push_back(drawn_factors(t, draw));
  if (std::all_of(other.input_factors.begin(), other.input_factors.end(),
                  [](const std::vector<double>& f) { return f.empty(); }))
    return false;
  const auto from = settled_starts(held_out.traces, model, observer_hz);
  const std::vector<Playback> as_read = play_from(from, model, held_out, observer_hz, false),
                              drawn = play_from(from, model, other, observer_hz, false);
  if (as_read.empty() || drawn.empty()) return false;
  for (std::size_t r = 0; r < drawn.size(); ++r) {
    held_out.innovation_open.push_back(rms_difference(as_read[r].innovation, drawn[r].innovation));
    held_out.free_open.push_back(rms_difference(as_read[r].free, drawn[r].free));
  }
  return true;
}

}  // namespace gapscope::internal::diagnosis
