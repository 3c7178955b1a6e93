#include "drives/chain.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "gapscope/base/statistics.h"

namespace gapscope::independent_plant {
namespace {

double odd_power(double p, double exponent) {
  if (exponent == 1.0) return p;
  return std::copysign(std::pow(std::abs(p), exponent), p);
}

}  // namespace

double FrictionLevel::at(double w) const {
  const double more = breakaway_nm - coulomb_nm;
  if (more <= 0.0) return coulomb_nm;
  return coulomb_nm + more * std::exp(-std::pow(std::abs(w) / stribeck_speed_rad_s, stribeck_exponent));
}

void FrictionLevel::scale(double factor) { coulomb_nm *= factor, breakaway_nm *= factor; }

double ChainJoint::half_gap(double x) const {
  if (gap_share == 0.0) return 0.5 * gap;
  return 0.5 * gap * (1.0 + gap_share * std::cos(2.0 * kPi * x / gap_period_rad + gap_phase_rad));
}

double ChainJoint::push(double p, double rate) const {
  const double by_overlap = odd_power(p, exponent);
  return stiffness * by_overlap + cubic * p * p * p +
         (damping + impact_damping * std::abs(by_overlap)) * rate;
}

double ChainJoint::grip(double p, double rate) const {
  if (!ends_with_overlap()) return push(p, rate) + release_nm;
  return stiffness + cubic * std::pow(std::abs(p), 3.0 - exponent) + impact_damping * rate;
}

double ChainJoint::energy(double p) const {
  return stiffness * std::pow(std::abs(p), exponent + 1.0) / (exponent + 1.0) + 0.25 * cubic * p * p * p * p;
}

void require_sound(const ChainDrive& d) {
  GAPSCOPE_REQUIRE(!d.bodies.empty() && d.bodies.size() <= static_cast<std::size_t>(kMostBodies));
  GAPSCOPE_REQUIRE(d.joints.size() + 1 == d.bodies.size());
  for (const ChainBody& b : d.bodies)
    GAPSCOPE_REQUIRE(b.inertia > 0.0 && b.friction.coulomb_nm >= 0.0 && b.bristle_length_rad >= 0.0 &&
                     b.friction.stribeck_speed_rad_s > 0.0 &&
                     (!b.has_bristles() || b.friction.coulomb_nm > 0.0));
  for (const ChainJoint& j : d.joints)
    GAPSCOPE_REQUIRE(j.gap >= 0.0 && std::abs(j.gap_share) < 1.0 && j.stiffness > 0.0 && j.cubic >= 0.0 &&
                     j.exponent >= 1.0 && j.exponent <= 3.0 && j.damping >= 0.0 && j.impact_damping >= 0.0 &&
                     j.release_nm >= 0.0);
}

}  // namespace gapscope::independent_plant
