#pragma once

#include <cmath>

#include "gapscope/sliding_mode/super_twisting.h"

/// Inlined whatever the compiler thinks: a call in the loop over the bounds would keep it from vectorising,
/// and a function compiled for a wider instruction set takes its callees along only so.
#if defined(__GNUC__)
#define GAPSCOPE_INLINE [[gnu::always_inline]] inline
#else
#define GAPSCOPE_INLINE inline
#endif

namespace gapscope::internal::sliding_mode {

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
GAPSCOPE_INLINE double sign_of(double e) {
  return static_cast<double>(e > 0.0) - static_cast<double>(e < 0.0);
}

/// As std::fmin and std::fmax, but one machine instruction: without their promises about NaN a loop
/// vectorises.
GAPSCOPE_INLINE double lesser(double a, double b) { return a < b ? a : b; }
GAPSCOPE_INLINE double greater(double a, double b) { return a > b ? a : b; }

/// exp(x), x ≥ 0, without a call: the exponential series at x/8 up to the fourth power, then three squarings.
/// Its inverse is within 3e-5 of exp(−x), which maps the eigenvalues closely enough.
GAPSCOPE_INLINE double growth(double x) {
  const double r = x * 0.125;
  double z = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0))));
  z *= z, z *= z, z *= z;
  return z;
}

constexpr double kDecayed = 40.0;  ///< exp(−40) is as good as 0

/// One step of dt to the sample y. The same arithmetic serves one bound and the bank.
template <Discretisation D>
GAPSCOPE_INLINE StepState advance(StepState s, const StepGains& g, double y, double dt) {
  if constexpr (D == Discretisation::kForwardEuler) {
    s.x += dt * (s.w + g.k1 * std::sqrt(std::fabs(s.e)) * sign_of(s.e));
    s.w += dt * g.k2 * sign_of(s.e);
    s.e = y - s.x;
  } else if constexpr (D == Discretisation::kSemiImplicit) {
    const double b = y - (s.x + dt * s.w);
    const double within = dt * (g.k1 * std::sqrt(std::fabs(s.e)) + dt * g.k2);
    const double size = std::fabs(b);
    const double share = lesser(size, within) / greater(within, 1e-300);  // of the sign, in [0, 1]
    s.e = std::copysign(greater(size - within, 0.0), b);
    s.w += std::copysign(dt * g.k2 * share, b);
    s.x = y - s.e;
  } else if constexpr (D == Discretisation::kImplicit) {
    const double b = y - (s.x + dt * s.w);
    const double within = dt * dt * g.k2;  // |b| up to here is taken up by the set-valued sign alone
    const double beyond = greater(std::fabs(b) - within, 0.0);
    const double half = 0.5 * dt * g.k1;
    const double root = std::sqrt(half * half + beyond) - half;
    s.e = std::copysign(root * root, b);
    s.w += std::copysign(lesser(std::fabs(b), within), b) / dt;
    s.x = y - s.e;
  } else {
    const double inverse = dt / greater(std::sqrt(std::fabs(s.e)), g.root2 * dt / kDecayed);
    const double g1 = growth(g.root1 * inverse);
    const double g2 = growth(g.root2 * inverse);
    const double both = 1.0 / (g1 * g2);
    const double z1 = g2 * both, z2 = g1 * both;
    s.x += dt * s.w + (2.0 - z1 - z2) * s.e;
    s.w += (1.0 - z1) * (1.0 - z2) / dt * s.e;
    s.e = y - s.x;
  }
  return s;
}

StepGains step_gains(double L);

}  // namespace gapscope::internal::sliding_mode
