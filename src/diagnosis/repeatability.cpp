#include "diagnosis/repeatability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

}  // namespace gapscope::internal::diagnosis
