#include "sliding_mode/passage/flight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/least_squares.h"
#include "sliding_mode/passage/contact_onset.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kRows = 400;            ///< at most so many samples of a window are fitted
constexpr std::size_t kRowsOfRelease = 2000;  ///< … where its begin is sought
constexpr double kConsistent = 3.0;  ///< standard deviations that the mean square error may exceed the noise
constexpr int kPatience = 5;         ///< misses in a row that end the growth
constexpr double kShows = 10.0;      ///< standard deviations by which x1 is off before t1, once it shows
constexpr double kWithin = 0.45;     ///< of the flight: t1 is sought so far in it
/// Noise in quanta up to which slow samples share roundings. SignalFacts::sharing() has 0.4, by which
/// heavy_wide 3, whose noise of a rounding alone is taken for 0.53, reads 2.2 % short of an interval of 1.7
/// %.
constexpr double kDithersSlow = 0.75;
constexpr double kStep = 0.02;         ///< … at such distances
constexpr double kAlmostAsGood = 4.0;  ///< in χ²

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

FlightLaw::Fit FlightLaw::fit(std::size_t first, std::size_t last) const {
  const std::size_t n = last - first + 1, stride = (n + kRows - 1) / kRows;
  const std::size_t begin = last - (n - 1) / stride * stride;
  return solved(columns_.rows(begin, last, stride), columns_.positions(begin, last, stride), first);
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

std::size_t FlightLaw::contact_seen(const Fit& law) const {
  std::size_t i = law.first;
  const auto off = [&](std::size_t k) {
    return std::abs(trace_.x1[k] - state(law, static_cast<double>(k)).position);
  };
  while (i > window().first && off(i) < kShows * noise_) --i;
  return i;
}

/// Read backwards in time: t1 is where a contact begins to act (contact_onset.h).
FreeFlight FlightLaw::find_release(std::size_t core) const {
  FreeFlight flight;
  Fit law;
  if (!fit_before(core, law) || law.first == window().first)
    return flight;  // one law for the whole stroke: no contact lost
  const std::size_t from = contact_seen(law), stride = (core - from) / kRowsOfRelease + 1;
  const std::size_t first = core - (core - from) / stride * stride;
  const Eigen::MatrixXd columns = columns_.rows(first, core, stride).colwise().reverse();
  const Eigen::VectorXd y = columns_.positions(first, core, stride).reverse();
  if (columns.rows() <= columns.cols()) return flight;
  const OnsetScan pushed(y, 0, -direction(), columns, OnsetScan::Start::kTorque);
  const OnsetScan pulled(y, 0, direction(), columns, OnsetScan::Start::kTorque);
  // Rows back from `core`.
  const auto back = [&](double t) { return (static_cast<double>(core) - t) / static_cast<double>(stride); };
  const auto time = [&](double b) { return static_cast<double>(core) - b * static_cast<double>(stride); };
  const auto good = static_cast<double>(law.first), length = static_cast<double>(core - law.first);
  const double least = std::max(back(good + kWithin * length), 2.0),
               most = back(static_cast<double>(first)) - 1.0;
  if (!(most > least)) return flight;
  const double step = std::max(kStep * length / static_cast<double>(stride), 0.25);
  const Onset push = pushed.best(least, most, step, kAlike * noise_ * noise_),
              pull = pulled.best(least, most, step, kAlike * noise_ * noise_);
  const bool pulls = pull.sse < push.sse;
  const Onset& best = pulls ? pull : push;
  const double freedom = static_cast<double>(columns.rows() - columns.cols());
  const std::size_t until = law.first + static_cast<std::size_t>(kWithin * length);
  double way = 0.0;
  for (std::size_t i = first + 1; i <= until; ++i) way += std::abs(trace_.x1[i] - trace_.x1[i - 1]);
  const double sharing = noise_ < kDithersSlow * trace_.quantum
                             ? std::max(1.0, trace_.quantum * static_cast<double>(until - first) / way) /
                                   static_cast<double>(stride)
                             : 1.0;
  const double limit =
      best.sse + kAlmostAsGood * std::max(1.0, sharing) * std::max(noise_ * noise_, best.sse / freedom);
  const OnsetScan& scan = pulls ? pulled : pushed;
  Interval open = scan.within(least, most, step, limit);
  open.low = std::min(open.low, best.time), open.high = std::max(open.high, best.time);
  const auto begin = [&](double b) {
    const Onset onset = scan.trial(b);
    Eigen::VectorXd known(static_cast<Eigen::Index>(core - first) + 1);
    for (Eigen::Index i = 0; i < known.size(); ++i)
      known(i) = (pulls ? -1.0 : 1.0) * direction() *
                 onset(back(static_cast<double>(first) + static_cast<double>(i)));
    const double t = time(b);
    return FlightBegin{t, state(fit_without(first, known), t)};
  };
  flight.found = true;
  flight.begin = begin(best.time);
  flight.earliest = begin(open.high);
  flight.latest = begin(open.low);
  flight.push = pulls ? -1.0 : 1.0;
  return flight;
}

}  // namespace gapscope::internal::sliding_mode
