#include "sliding_mode/one_body.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/least_squares.h"
#include "sliding_mode/light_load.h"
#include "sliding_mode/one_body_search.h"

namespace gapscope::internal::sliding_mode {
namespace {

// Half and double of each: see one_body_search.h.
/// Of the largest speed: the sign of slower motion is not believed at first. Double within 6 %; with half
/// 4100005 finds no law to begin with.
constexpr double kSlow = 0.1;
/// Of the rms speed: begins of friction that fades. Half leaves up to 6.6 times as much, double 1.08 times.
constexpr double kFadings[] = {0.02, 0.2};
/// Of its gap, what a light load leaves at most, as far as it is believed: a search for the law that ends
/// early leaves more (5650038 gap sine wide slides was denied 0.4 mrad of 9.1 without this).
constexpr double kMostLeft = 0.02;
constexpr int kTries = 2;                    ///< each corrects the gap by what the one before has left
constexpr double kMostOfTravelTried = 0.25;  ///< beyond it what is left no longer grows with the gap
/// How fast the light loads that are tried slow down by themselves, of the rate at which both do. Set on
/// study_sliding_mode 5620001 40 gap (all four inputs) wide slides.
constexpr double kSlowing[] = {0.0, 0.5, 1.0};
/// Between these loads and others, whose contact is soft or which rebound. Half of it denies 5 of the 60 of
/// 5650001 gap sine wide slides above the limit that is told (kLightestLoad = 0.1, kSlowing = 0), this 1
/// there and tells 14 of 5640401 40 gap_free sine wide that there is none, for 18 with loads of 0.2.
constexpr double kUnlikeLoads = 2.0;

/// Second differences of x1 over a thirtieth of a period, by the mean u that they had.
OneBodyLaw first_law(const Instants& s) {
  const auto m = static_cast<std::size_t>(kInstants / 60.0);
  const double span = 2.0 * static_cast<double>(m) * s.dt;
  const auto rows = static_cast<Eigen::Index>(s.x.size() / m);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, 4);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const std::size_t i = m * static_cast<std::size_t>(r);
    if (i < 2 * m || i + 2 * m >= s.x.size()) continue;
    const double v = s.speed(i, m);
    if (std::abs(v) < kSlow * s.fastest) continue;
    double u = 0.0, weights = 0.0;
    for (std::size_t k = i - 2 * m; k < i + 2 * m; ++k) {
      const double weight =
          2.0 * static_cast<double>(m) - std::abs(static_cast<double>(k) + 0.5 - static_cast<double>(i));
      u += weight * s.u[k], weights += weight;
    }
    A.row(r) << u / weights, 1.0, -v, -std::copysign(1.0, v);
    y(r) = (s.x[i + 2 * m] - 2.0 * s.x[i] + s.x[i - 2 * m]) / (span * span);
  }
  const Eigen::Vector4d found = signals::least_squares_of(A, y);
  return {found(0), found(1), std::max(found(2), 0.0), std::max(found(3), 0.0), 0.0, s.fastest};
}

OneBodyState begun(const Instants& s, const OneBodyLaw& law) {
  OneBodyState state{law, Eigen::VectorXd(std::ssize(s.periods))};
  for (Eigen::Index k = 0; k < state.speeds.size(); ++k) {
    const Instants::Period& p = s.periods[static_cast<std::size_t>(k)];
    state.speeds(k) = s.speed(p.first, std::max<std::size_t>(2, (p.last - p.first) / 100));
  }
  return state;
}

/// The law that leaves least, of friction that fades with speed or not.
OneBodyState best_law(const Instants& s, const OneBodyLaw& start, double speed_rms) {
  OneBodyState best = improved(s, start, begun(s, start), false);
  for (const double fading : kFadings) {
    OneBodyState other = best;
    other.law.sticking = 0.3 * std::max(other.law.dry, 0.02 * start.drive * s.strongest);
    other.law.fading = fading * speed_rms;
    if (other = improved(s, start, other, true); other.left < best.left) best = std::move(other);
  }
  return best;
}

/// Of the gap, what one body leaves of the motion of this body with a light load behind it.
double left_of_gap(Instants s, const OneBodyState& best, double slows, double gap) {
  const std::size_t first = s.periods.front().first;
  const std::vector<double> x = motion_with_light_load(best.law, kLightestLoad, slows, gap, best.speeds(0),
                                                       std::span(s.u).subspan(first), s.dt);
  std::ranges::copy(x, s.x.begin() + static_cast<std::ptrdiff_t>(first));
  return improved(s, best.law, begun(s, best.law), best.law.sticking != 0.0).left / gap;
}

/// The smallest gap of which any light load would have left as much.
double hidden_gap(const Instants& s, const OneBodyState& best, double travel) {
  double hidden = 0.0;
  for (const double share : kSlowing) {
    double gap = std::min(best.left / kMostLeft, kMostOfTravelTried * travel);
    for (int k = 0; k < kTries && gap < travel; ++k)
      gap = best.left / std::min(left_of_gap(s, best, share * best.law.viscous, gap), kMostLeft);
    hidden = std::max(hidden, gap);
  }
  return kUnlikeLoads * hidden;
}

}  // namespace

OneBodyFit fit_one_body(const MotorTrace& trace, const signals::SignalFacts& facts) {
  if (trace.u.size() != trace.size() || !facts.defect.empty()) return {};
  const Instants s = instants_of(trace, facts);
  if (s.periods.empty() || !(s.fastest > 0.0) || !(s.strongest > 0.0)) return {};
  const OneBodyLaw start = first_law(s);
  if (!(start.drive > 0.0)) return {};
  const OneBodyState best = best_law(s, start, facts.speed_rms);
  return {best.law, best.left, hidden_gap(s, best, facts.travel)};
}

}  // namespace gapscope::internal::sliding_mode
