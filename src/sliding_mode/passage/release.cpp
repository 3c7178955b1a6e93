#include "sliding_mode/passage/release.h"

#include <algorithm>
#include <cmath>

#include "signals/least_squares.h"
#include "sliding_mode/kink_fit.h"
#include "sliding_mode/passage/flight.h"
#include "sliding_mode/passage/impact_time.h"
#include "sliding_mode/passage/passage.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kContactShare = 0.6;  ///< of the flight: how far before t1 the contact is looked at
constexpr double kBracket = 0.6;       ///< of its width, as a standard deviation
constexpr double kViscousShare = 0.3;  ///< of a load's deceleration at t1, where nothing else is known

/// The motor at t1 as the time before it tells, when the load still went with it.
MotorState state_in_contact(const MotorTrace& trace, const FlightBegin& begin, double flight) {
  const auto last = static_cast<std::size_t>(std::max(begin.time, 0.0));
  const std::size_t back =
      std::max(signals::MotionLaw::kFewestRows, static_cast<std::size_t>(kContactShare * flight));
  const std::size_t first = last - std::min(back, last), n = last - first + 1;
  if (n < signals::MotionLaw::kFewestRows) return begin.motor;
  const Eigen::MatrixXd A = polynomial_columns(n, 3);
  const Eigen::Vector4d c = signals::least_squares_of(
      A, Eigen::Map<const Eigen::VectorXd>(&trace.x1[first], static_cast<Eigen::Index>(n)));
  const double half = 0.5 * static_cast<double>(n - 1) * trace.dt;  // of the stretch [s]
  return {c.sum(), (c[1] + 2.0 * c[2] + 3.0 * c[3]) / half, (2.0 * c[2] + 6.0 * c[3]) / (half * half)};
}

}  // namespace

double load_travel(double w, double a, double D, double q) {
  if (w <= 0.0) return 0.0;
  if (a <= 0.0) return w * D;
  const double rate = q * a / w;
  if (rate * D < 1e-6) return w / a < D ? 0.5 * w * w / a : w * D - 0.5 * a * D * D;
  const double dry = w * (1.0 - q) / q;  // speed at which both would be alike
  const double stop = q < 1.0 ? std::log1p(w / dry) / rate : D;
  const double T = std::min(D, stop);
  return (w + dry) * -std::expm1(-rate * T) / rate - dry * T;
}

Release find_release(const PassageContext& context, const FlightLaw& law, const ImpactTime& impact) {
  Release release;
  const FreeFlight flight = law.find_release(impact.core);
  if (!flight.found) return release;
  const auto travel = [&](const FlightBegin& b, double viscous_share) {
    return load_travel(-law.direction() * b.motor.speed, law.direction() * b.motor.acceleration,
                       (impact.time - b.time) * context.trace.dt, viscous_share);
  };
  // Before t1 the load went with the motor: what an error of t1 does to x1(t1), it does to the travel, too.
  const auto gap = [&](const FlightBegin& b) {
    return travel(b, kViscousShare) - law.direction() * b.motor.position;
  };
  const double best = gap(flight.begin);
  const double doubt = std::max(std::abs(gap(flight.earliest) - best), std::abs(gap(flight.latest) - best));
  release.found = true;
  release.far_flank = flight.push > 0.0;
  release.time = flight.begin.time;
  release.first = flight.earliest.time;
  release.last = flight.latest.time;
  release.position = flight.begin.motor.position;
  release.load_travel = travel(flight.begin, kViscousShare);
  release.travel_half_width = 0.5 * (travel(flight.begin, 1.0) - travel(flight.begin, 0.0));
  release.dwell = release.load_travel <= 0.0;
  const FlightBegin in_contact{
      flight.begin.time, state_in_contact(context.trace, flight.begin, impact.time - flight.begin.time)};
  release.along = kInfinity;
  for (const FlightBegin& b : {flight.begin, flight.earliest, flight.latest, in_contact})
    release.along = std::min(release.along, law.direction() * b.motor.speed);
  if (!release.dwell) {
    release.contradiction = gap(in_contact) - best;
    release.load_travel += 0.5 * release.contradiction;
    release.passive = law.direction() * flight.begin.motor.acceleration > 0.0;
  }
  release.half_width = kBracket * release.travel_half_width + 0.5 * (doubt + std::abs(release.contradiction));
  return release;
}

}  // namespace gapscope::internal::sliding_mode
