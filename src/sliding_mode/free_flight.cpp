#include "sliding_mode/free_flight.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sliding_mode/least_squares.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kRows = 400;          ///< at most so many samples of a window are fitted
constexpr std::size_t kFewestSamples = 12;  ///< of the window that the growth starts with
constexpr double kConsistent = 3.0;  ///< standard deviations that the mean square error may exceed the noise
constexpr int kPatience = 5;         ///< misses in a row that end the growth
constexpr double kBeyond = 0.2;      ///< share of the flight that t1 is sought in before the law holds
constexpr double kLeastBeyond = 0.05;  ///< … at least
constexpr double kAlmostAsGood = 6.0;  ///< in χ²: 2.4 standard deviations
constexpr double kWithin = 0.45;       ///< … and after that

}  // namespace

FlightLaw::FlightLaw(const MotorTrace& trace, const FlightWindow& window, double noise)
    : trace_(trace), window_(window), noise_(noise) {
  const std::size_t n = window.last - window.first + 1;
  const double dt = trace.dt;
  input_.assign(n, 0.0);
  friction_ = input2_ = friction2_ = position_ = input_;
  const auto& x = trace.x1;
  for (std::size_t k = 1; k < n; ++k) {
    const std::size_t i = window.first + k;
    const double u = trace.u[i - 1];
    const double sign = std::clamp(2.0 * (static_cast<double>(i) - window.reversal) - 1.0, -1.0, 1.0);
    input_[k] = input_[k - 1] + u * dt;
    input2_[k] = input2_[k - 1] + (input_[k - 1] + 0.5 * u * dt) * dt;
    friction_[k] = friction_[k - 1] + sign * dt;
    friction2_[k] = friction2_[k - 1] + (friction_[k - 1] + 0.5 * sign * dt) * dt;
    position_[k] = position_[k - 1] + (0.5 * (x[i - 1] + x[i]) - x[window.first]) * dt;
  }
}

/// Entry of the regression: what multiplies x0, v0, b, −a, −f in x1(t).
double FlightLaw::row(std::size_t i, int column) const {
  const std::size_t k = index(i);
  const double values[kColumns] = {1.0, static_cast<double>(k) * trace_.dt, input2_[k], position_[k],
                                   friction2_[k]};
  return values[column];
}

/// Its time derivative.
double FlightLaw::rate(std::size_t i, int column) const {
  const std::size_t k = index(i);
  const double values[kColumns] = {0.0, 1.0, input_[k], trace_.x1[i] - trace_.x1[window_.first],
                                   friction_[k]};
  return values[column];
}

Eigen::MatrixXd FlightLaw::columns(std::size_t first, std::size_t last) const {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(last - first + 1), kColumns);
  for (Eigen::Index r = 0; r < A.rows(); ++r)
    for (int c = 0; c < kColumns; ++c) A(r, c) = row(first + static_cast<std::size_t>(r), c);
  return A;
}

FlightLaw::Fit FlightLaw::fit_without(std::size_t first, const Eigen::VectorXd& known) const {
  const Eigen::MatrixXd A = columns(first, first + static_cast<std::size_t>(known.size()) - 1);
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(&trace_.x1[first], known.size()) - known;
  const Eigen::VectorXd scale = A.colwise().norm().cwiseMax(1e-300);
  const Eigen::VectorXd solution = least_squares_of(A * scale.cwiseInverse().asDiagonal(), y);
  Fit result;
  result.first = first;
  result.freedom = static_cast<double>(A.rows() - A.cols());
  for (int c = 0; c < kColumns; ++c)
    result.coefficients[static_cast<std::size_t>(c)] = solution(c) / scale(c);
  result.error = (A * scale.cwiseInverse().asDiagonal() * solution - y).squaredNorm() / result.freedom;
  return result;
}

/// Least squares over [first, last]. With power > 0, x1 departs from the law as (onset − t)^power before it.
FlightLaw::Fit FlightLaw::fit(std::size_t first, std::size_t last, double onset, int power) const {
  const std::size_t n = last - first + 1, stride = (n + kRows - 1) / kRows;
  const auto rows = static_cast<Eigen::Index>((n - 1) / stride + 1);
  const int columns = kColumns + (power > 0 ? 1 : 0);
  Eigen::MatrixXd A(rows, columns);
  Eigen::VectorXd y(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const std::size_t i = last - static_cast<std::size_t>(r) * stride;
    for (int c = 0; c < kColumns; ++c) A(r, c) = row(i, c);
    if (power > 0)
      A(r, kColumns) =
          std::pow(std::max(onset - static_cast<double>(i), 0.0) / static_cast<double>(n), power);
    y(r) = trace_.x1[i];
  }
  const Eigen::VectorXd scale = A.colwise().norm().cwiseMax(1e-300);
  A = A * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd solution = least_squares_of(A, y);
  Fit result;
  result.first = first;
  result.freedom = static_cast<double>(rows - columns);
  result.error = (A * solution - y).squaredNorm() / result.freedom;
  for (int c = 0; c < columns; ++c) result.coefficients[static_cast<std::size_t>(c)] = solution(c) / scale(c);
  return result;
}

bool FlightLaw::holds(const Fit& f) const {
  return f.error <= noise_ * noise_ * 1.05 * (1.0 + kConsistent * std::sqrt(2.0 / f.freedom));
}

/// Earliest sample from which one law holds to `last`, within the noise.
std::size_t FlightLaw::grow_back(std::size_t first, std::size_t last) const {
  std::size_t good = first;
  for (int misses = 0; first > window_.first && misses < kPatience;) {
    const std::size_t step = std::max<std::size_t>(1, (last - first) / 25);
    first = first > window_.first + step ? first - step : window_.first;
    if (holds(fit(first, last)))
      misses = 0, good = first;
    else
      ++misses;
  }
  return good;
}

bool FlightLaw::fit_before(std::size_t core, Fit& result) const {
  if (core < window_.first + 2 * kFewestSamples) return false;
  const std::size_t turn = std::clamp(static_cast<std::size_t>(window_.reversal), window_.first, core);
  for (std::size_t length = (core - turn) / 2;; length /= 2) {
    const std::size_t seed = core - std::max(kFewestSamples, length);
    if (holds(fit(seed, core))) {
      result = fit(grow_back(seed, core), core);
      return true;
    }
    if (length <= kFewestSamples) return false;
  }
}

MotorState FlightLaw::state(const Fit& f, double time) const {
  const auto nearest = static_cast<std::size_t>(std::lround(std::max(time, 0.0)));
  const std::size_t i = std::clamp(nearest, window_.first, window_.last);
  const double late = (time - static_cast<double>(i)) * trace_.dt;
  MotorState s;
  for (int c = 0; c < kColumns; ++c) {
    s.position += f.coefficients[static_cast<std::size_t>(c)] * row(i, c);
    s.speed += f.coefficients[static_cast<std::size_t>(c)] * rate(i, c);
  }
  const double sign = static_cast<double>(i) <= window_.reversal ? -1.0 : 1.0;
  s.acceleration = f.coefficients[2] * trace_.u[i] + f.coefficients[3] * s.speed + f.coefficients[4] * sign;
  s.position += s.speed * late;
  s.speed += s.acceleration * late;
  return s;
}

double FlightLaw::drive(const Fit& f, double time) const {
  const auto i = static_cast<std::size_t>(std::lround(std::max(time, 0.0)));
  return window_.direction * f.coefficients[2] * trace_.u[std::clamp(i, window_.first, window_.last)];
}

FreeFlight FlightLaw::find_release(std::size_t core) const {
  FreeFlight flight;
  Fit law;
  if (!fit_before(core, law) || law.first == window_.first)
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
    const double before = std::min(beyond * length, static_cast<double>(law.first - window_.first));
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
  flight.push = window_.direction * chosen.fit.coefficients[kColumns];
  for (const Trial& t : trials) {
    if (t.fit.error > chosen.fit.error * (1.0 + kAlmostAsGood / chosen.fit.freedom)) continue;
    if (t.onset < flight.earliest.time) flight.earliest = begin(t);
    if (t.onset > flight.latest.time) flight.latest = begin(t);
  }
  return flight;
}

}  // namespace gapscope::internal::sliding_mode
