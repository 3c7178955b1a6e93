#include "gapscope/sliding_mode/super_twisting.h"

#include <cmath>
#include <stdexcept>

#include "sliding_mode/marks/super_twisting_step.h"

namespace gapscope {

const char* to_string(Discretisation discretisation) {
  switch (discretisation) {
    case Discretisation::kForwardEuler:
      return "forward_euler";
    case Discretisation::kSemiImplicit:
      return "semi_implicit";
    case Discretisation::kImplicit:
      return "implicit";
    case Discretisation::kMatched:
      return "matched";
  }
  return "";
}

SuperTwistingGains SuperTwistingGains::from_bound(double L) {
  const double k2 = 1.1 * L;
  return {2.028 * std::sqrt(k2), k2};
}

namespace internal::sliding_mode {

StepGains step_gains(double L) {
  const SuperTwistingGains gains = SuperTwistingGains::from_bound(L);
  // k₁² = 4.11 k₂ > 4 k₂: both roots of p² + k₁ p + k₂ are real and negative. Written as multiples of √k₂, so
  // that L × 4 doubles them exactly.
  const double scale = std::sqrt(gains.k2);
  const double spread = std::sqrt(1.014 * 1.014 - 1.0);
  return {gains.k1, gains.k2, (1.014 - spread) * scale, (1.014 + spread) * scale};
}

}  // namespace internal::sliding_mode

SuperTwistingDifferentiator::SuperTwistingDifferentiator(double L, Discretisation discretisation)
    : gains_(SuperTwistingGains::from_bound(L)), discretisation_(discretisation) {
  if (!(L > 0.0) || !std::isfinite(L))
    throw std::invalid_argument("SuperTwistingDifferentiator: the bound L must be positive and finite");
  const internal::sliding_mode::StepGains gains = internal::sliding_mode::step_gains(L);
  root1_ = gains.root1;
  root2_ = gains.root2;
}

void SuperTwistingDifferentiator::start(double position, double velocity) noexcept {
  state_ = {position, velocity, 0.0};
  started_ = true;
}

SuperTwistingDifferentiator::Estimate SuperTwistingDifferentiator::step(double y, double dt) noexcept {
  if (!started_) {
    start(y, 0.0);
    return state_;
  }
  const internal::sliding_mode::StepGains gains{gains_.k1, gains_.k2, root1_, root2_};
  internal::sliding_mode::StepState s{state_.position, state_.velocity, state_.error};
  switch (discretisation_) {
    case Discretisation::kForwardEuler:
      s = internal::sliding_mode::advance<Discretisation::kForwardEuler>(s, gains, y, dt);
      break;
    case Discretisation::kSemiImplicit:
      s = internal::sliding_mode::advance<Discretisation::kSemiImplicit>(s, gains, y, dt);
      break;
    case Discretisation::kImplicit:
      s = internal::sliding_mode::advance<Discretisation::kImplicit>(s, gains, y, dt);
      break;
    case Discretisation::kMatched:
      s = internal::sliding_mode::advance<Discretisation::kMatched>(s, gains, y, dt);
      break;
  }
  state_ = {s.x, s.w, s.e};
  return state_;
}

}  // namespace gapscope
