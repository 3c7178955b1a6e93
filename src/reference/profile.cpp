#include "reference/profile.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/normal.h"

namespace gapscope::internal::reference {
namespace {

constexpr Effort kRefit{1e-7, 0.5};
constexpr int kMostSteps = 12;
constexpr double kCloseEnough = 0.02;  ///< of the rise, as a root

/// The problem with one parameter held.
struct HeldParameter {
  FitProblem problem;
  int parameter;

  HeldParameter(const FitProblem& whole, std::size_t i) : problem(whole), parameter(whole.free[i]) {
    problem.parameters[parameter].estimated = false;
    problem.free.erase(problem.free.begin() + static_cast<std::ptrdiff_t>(i));
  }
};

/// Walks to one side until the root of the cost's rise is the wanted one.
class ProfileWalk {
 public:
  /// @param square at the point, see mean_square_with_priors()
  ProfileWalk(const FitProblem& whole, const FitPoint& at, double square, double hz, std::size_t i)
      : held_(whole, i), hz_(hz), at_(at), square_(square) {
    at_.q.erase(at_.q.begin() + static_cast<std::ptrdiff_t>(i));
    for (const MotorTrace& r : whole.recordings) samples_ += static_cast<double>(r.size());
  }

  double end(double value, double step, double bound, double wanted) {
    double near = 0.0, far = 0.0;  // distances that rise too little, and too much (0: none yet)
    double distance = std::abs(step), near_rise = 0.0;
    const double most = std::abs(bound - value);
    for (int k = 0; k < kMostSteps; ++k) {
      stop_point();
      distance = std::min(distance, most);
      const double rise = root_of_rise(value + std::copysign(distance, step));
      if (std::abs(rise - wanted) < kCloseEnough * wanted) break;
      if (rise < wanted) {
        near = distance, near_rise = rise;
        if (distance >= most) return bound;
      } else {
        far = distance;
      }
      const double ahead = near_rise > 0.0 ? near * wanted / near_rise : 2.0 * near;
      if (far == 0.0) {
        distance = std::clamp(ahead, 1.2 * near, 4.0 * near);
      } else {
        const double guess = std::isfinite(rise) ? distance * wanted / rise : 0.0;
        distance = guess > near && guess < far ? guess : 0.5 * (near + far);
      }
    }
    return value + std::copysign(distance, step);
  }

  double simulations() const { return simulations_; }

 private:
  double root_of_rise(double value) {
    held_.problem.parameters[held_.parameter].start = value;
    const Solution found = solve(held_.problem, at_, hz_, kRefit);
    simulations_ += found.simulations;
    if (!found.usable()) return kInfinity;
    return std::sqrt(std::max(0.0, (found.mean_square_with_priors - square_) * samples_));
  }

  HeldParameter held_;
  double hz_;
  FitPoint at_;
  double square_, samples_ = 0.0, simulations_ = 0.0;
};

}  // namespace

Profile profile_interval(const FitProblem& problem, const FitPoint& at, double observer_hz, std::size_t i,
                         const ParameterError& error) {
  const Parameter& p = problem.free_parameter(i);
  const double value = p.coordinate.physical(at.q[i]);
  const double step = kNormal95 * error.reported, wanted = kNormal95 * error.reported / error.linear;
  if (!(step > 0.0) || !std::isfinite(wanted)) return {};
  const Square square = mean_square_with_priors(problem, at, observer_hz);
  ProfileWalk walk(problem, at, square.value, observer_hz, i);
  const Interval found{walk.end(value, -step, p.low, wanted), walk.end(value, step, p.high, wanted)};
  return {found, square.simulations + walk.simulations()};
}

}  // namespace gapscope::internal::reference
