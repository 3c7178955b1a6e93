#pragma once

#include <cmath>

#include "gapscope/sliding_mode/super_twisting.h"

namespace gapscope::internal {

/// The constants of one differentiator.
struct StepGains {
  double k1 = 0.0;     ///< [√rad/s]
  double k2 = 0.0;     ///< [rad/s²]
  double root1 = 0.0;  ///< −p₁ [√rad/s]
  double root2 = 0.0;  ///< −p₂ [√rad/s]
};

/// The state of one differentiator: x̂₁, ŵ₁ and e of the last sample.
struct StepState {
  double x = 0.0;
  double w = 0.0;
  double e = 0.0;
};

/// sign(e) with sign(0) = 0, without a branch, so that a loop over bounds vectorises.
inline double sign_of(double e) { return static_cast<double>(e > 0.0) - static_cast<double>(e < 0.0); }

/// As std::fmin and std::fmax, but one machine instruction: without their promises about NaN a loop
/// vectorises.
inline double lesser(double a, double b) { return a < b ? a : b; }
inline double greater(double a, double b) { return a > b ? a : b; }

/// exp(−x), x ≥ 0, without a call: Taylor at x/64, then six squarings. Relative error < 1e-5 for x < 40,
/// which maps the eigenvalues closely enough; above that 0 is as good.
inline double decay(double x) {
  const double r = lesser(x, 40.0) * (1.0 / 64.0);
  double z =
      1.0 - r * (1.0 - r / 2.0 * (1.0 - r / 3.0 * (1.0 - r / 4.0 * (1.0 - r / 5.0 * (1.0 - r / 6.0)))));
  z *= z, z *= z, z *= z, z *= z, z *= z, z *= z;
  return z;
}

/// One step of dt to the sample y. The same arithmetic serves one bound and the bank.
template <Discretisation D>
inline StepState advance(StepState s, const StepGains& g, double y, double dt) {
  if constexpr (D == Discretisation::kForwardEuler) {
    s.x += dt * (s.w + g.k1 * std::sqrt(std::fabs(s.e)) * sign_of(s.e));
    s.w += dt * g.k2 * sign_of(s.e);
    s.e = y - s.x;
  } else if constexpr (D == Discretisation::kSemiImplicit) {
    const double b = y - (s.x + dt * s.w);
    const double within = dt * dt * g.k2;  // |b| up to here is taken up by the set-valued sign alone
    const double beyond = greater(std::fabs(b) - within, 0.0);
    const double half = 0.5 * dt * g.k1;
    const double root = std::sqrt(half * half + beyond) - half;
    s.e = std::copysign(root * root, b);
    s.w += std::copysign(lesser(std::fabs(b), within), b) / dt;
    s.x = y - s.e;
  } else {
    const double inverse = dt / greater(std::sqrt(std::fabs(s.e)), 1e-150);
    const double z1 = decay(g.root1 * inverse);
    const double z2 = decay(g.root2 * inverse);
    s.x += dt * s.w + (2.0 - z1 - z2) * s.e;
    s.w += (1.0 - z1) * (1.0 - z2) / dt * s.e;
    s.e = y - s.x;
  }
  return s;
}

StepGains step_gains(double L);

}  // namespace gapscope::internal
