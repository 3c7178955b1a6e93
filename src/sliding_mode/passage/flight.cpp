#include "sliding_mode/passage/flight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "signals/least_squares.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kRows = 400;   ///< at most so many samples of a window are fitted
constexpr double kConsistent = 3.0;  ///< standard deviations that the mean square error may exceed the noise
constexpr int kPatience = 5;         ///< misses in a row that end the growth
constexpr double kBeyond = 0.2;      ///< share of the flight that t1 is sought in before the law holds
constexpr double kLeastBeyond = 0.05;  ///< … at least
constexpr double kAlmostAsGood = 6.0;  ///< in χ²: 2.4 standard deviations
constexpr double kWithin = 0.45;       ///< … and after that

FlightLaw::Fit solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, std::size_t first) {
  FlightLaw::Fit fit;
  fit.numbers = signals::least_squares_of(A, y);
  fit.first = first;
  fit.freedom = static_cast<double>(A.rows() - A.cols());
  fit.error = (A * fit.numbers - y).squaredNorm() / fit.freedom;
  return fit;
}

}  // namespace

FlightLaw::Fit FlightLaw::fit_without(std::size_t first, const Eigen::VectorXd& known) const {
  const std::size_t last = first + static_cast<std::size_t>(known.size()) - 1;
  return solved(columns_.rows(first, last), columns_.positions(first, last) - known, first);
}

/// Least squares over [first, last]. With power > 0, x1 departs from the law as (onset − t)^power before it.
FlightLaw::Fit FlightLaw::fit(std::size_t first, std::size_t last, double onset, int power) const {
  const std::size_t n = last - first + 1, stride = (n + kRows - 1) / kRows;
  const std::size_t begin = last - (n - 1) / stride * stride;
  Eigen::MatrixXd A = columns_.rows(begin, last, stride);
  if (power > 0) {
    A.conservativeResize(Eigen::NoChange, A.cols() + 1);
    for (Eigen::Index r = 0; r < A.rows(); ++r) {
      const double before =
          onset - static_cast<double>(begin) - static_cast<double>(r) * static_cast<double>(stride);
      A(r, A.cols() - 1) = std::pow(std::max(before, 0.0) / static_cast<double>(n), power);
    }
  }
  return solved(A, columns_.positions(begin, last, stride), first);
}

bool FlightLaw::holds(const Fit& f) const {
  return f.error <= noise_ * noise_ * 1.05 * (1.0 + kConsistent * std::sqrt(2.0 / f.freedom));
}

/// Earliest sample from which one law holds to `last`, within the noise.
std::size_t FlightLaw::grow_back(std::size_t first, std::size_t last) const {
  std::size_t good = first;
  for (int misses = 0; first > window().first && misses < kPatience;) {
    const std::size_t step = std::max<std::size_t>(1, (last - first) / 25);
    first = first > window().first + step ? first - step : window().first;
    if (holds(fit(first, last)))
      misses = 0, good = first;
    else
      ++misses;
  }
  return good;
}

bool FlightLaw::fit_before(std::size_t core, Fit& result) const {
  if (core < window().first + 2 * signals::MotionLaw::kFewestRows) return false;
  const std::size_t turn = std::clamp(static_cast<std::size_t>(window().turn), window().first, core);
  for (std::size_t length = (core - turn) / 2;; length /= 2) {
    const std::size_t seed = core - std::max(signals::MotionLaw::kFewestRows, length);
    if (holds(fit(seed, core))) {
      result = fit(grow_back(seed, core), core);
      return true;
    }
    if (length <= signals::MotionLaw::kFewestRows) return false;
  }
}

double FlightLaw::drive(const Fit& f, double time) const {
  const auto i = static_cast<std::size_t>(std::lround(std::max(time, 0.0)));
  return direction() * f.numbers(signals::LawColumns::kDrive) *
         trace_.u[std::clamp(i, window().first, window().last)];
}

FreeFlight FlightLaw::find_release(std::size_t core) const {
  FreeFlight flight;
  Fit law;
  if (!fit_before(core, law) || law.first == window().first)
    return flight;  // one law for the whole stroke: no contact lost
  const auto good = static_cast<double>(law.first), length = static_cast<double>(core - law.first);
  struct Trial {
    double onset;
    Fit fit;
  };
  std::vector<Trial> trials;
  std::size_t best = 0;
  // Before t1 x1 departs by a power of the time only near it: farther back none holds, and the best is any.
  for (double beyond = kBeyond; beyond >= kLeastBeyond; beyond *= 0.5) {
    const double before = std::min(beyond * length, static_cast<double>(law.first - window().first));
    const std::size_t first = law.first - static_cast<std::size_t>(before);
    trials.clear();
    best = 0;
    for (const int power : {3, 2})
      for (double onset = good - 0.5 * before; onset < good + kWithin * length; onset += 0.02 * length) {
        if (onset <= static_cast<double>(first)) continue;
        trials.push_back({onset, fit(first, core, onset, power)});
        if (trials.back().fit.error < trials[best].fit.error) best = trials.size() - 1;
      }
    if (!trials.empty() && holds(trials[best].fit)) break;
  }
  if (trials.empty()) return flight;
  const Trial& chosen = trials[best];
  const auto begin = [&](const Trial& t) { return FlightBegin{t.onset, state(t.fit, t.onset)}; };
  flight.found = true;
  flight.begin = flight.earliest = flight.latest = begin(chosen);
  flight.push = direction() * chosen.fit.numbers(columns_.count());
  for (const Trial& t : trials) {
    if (t.fit.error > chosen.fit.error * (1.0 + kAlmostAsGood / chosen.fit.freedom)) continue;
    if (t.onset < flight.earliest.time) flight.earliest = begin(t);
    if (t.onset > flight.latest.time) flight.latest = begin(t);
  }
  return flight;
}

}  // namespace gapscope::internal::sliding_mode
