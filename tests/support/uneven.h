#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/random.h"
#include "independent_plant/simulate.h"

namespace gapscope::test {

/// How a recording with steps of their own length comes about.
struct UnevenClock {
  double rate = 1000.0;     ///< on average, without what is lost [Hz]
  double duration = 4.0;    ///< [s]
  double jitter = 0.3;      ///< each step is off by up to this share
  double lost = 0.0;        ///< share of the rows that the logger has dropped, their inputs with them
  double tolerance = 1e-9;  ///< of the plant's integrator
  std::uint64_t seed = 1;
};

constexpr int kFineSteps = 20;  ///< of the plant, in a mean step

/// The rows' places on the plant's grid.
inline std::vector<std::size_t> places_of(const UnevenClock& clock) {
  auto draw = random_stream(clock.seed, "uneven clock");
  const auto end = static_cast<std::size_t>(clock.duration * clock.rate * kFineSteps);
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at < end;
       at +=
       static_cast<std::size_t>(std::lround(kFineSteps * (1.0 + uniform(draw, -1.0, 1.0) * clock.jitter))))
    places.push_back(at);
  return places;
}

/// The independent plant under an input that each row gives anew, recorded at the rows.
inline Recording uneven_recording(const independent_plant::BlindDrive& drive,
                                  const std::function<double(double)>& input,
                                  const independent_plant::BlindSensor& sensor, const UnevenClock& clock) {
  const std::vector<std::size_t> places = places_of(clock);
  const double fine = 1.0 / (clock.rate * kFineSteps);
  std::vector<double> u;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    u.insert(u.end(), places[i + 1] - places[i], input(fine * static_cast<double>(places[i])));
  const Recording all =
      independent_plant::simulate_blind_command(
          drive, u, sensor,
          {clock.rate * kFineSteps, fine * static_cast<double>(u.size()), clock.seed, clock.tolerance})
          .recording;
  auto draw = random_stream(clock.seed, "lost rows");
  Recording r;
  r.file = "uneven.csv", r.quantum = all.quantum;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (i > 0 && uniform(draw, 0.0, 1.0) < clock.lost) continue;
    r.stamps.push_back(all.time(places[i]));
    r.u.push_back(u[places[i]]);
    r.x1.push_back(all.x1[places[i]]);
  }
  r.start = r.stamps.front();
  r.dt = (r.stamps.back() - r.stamps.front()) / static_cast<double>(r.stamps.size() - 1);
  return r;
}

/// The same drive under the same input, sampled evenly.
inline Recording even_recording(const independent_plant::BlindDrive& drive,
                                const std::function<double(double)>& input,
                                const independent_plant::BlindSensor& sensor, UnevenClock clock) {
  clock.jitter = clock.lost = 0.0;
  Recording r = uneven_recording(drive, input, sensor, clock);
  r.file = "even.csv", r.dt = 1.0 / clock.rate;
  r.stamps.clear();
  return r;
}

}  // namespace gapscope::test
