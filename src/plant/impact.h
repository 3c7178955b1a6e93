#pragma once

#include <utility>

namespace gapscope {

/// Speeds of both bodies after a rigid impact with the given restitution coefficient e, eq. (3) of the source
/// paper generalised (e = 1 is eq. (3) itself):
///   ẋ₁⁺ = ẋ₁ − (1 + e) μ/(1 + μ) (ẋ₁ − ẋ₂),   ẋ₂⁺ = ẋ₂ + (1 + e)/(1 + μ) (ẋ₁ − ẋ₂),   μ = m₂/m₁ = −α
/// Momentum is conserved for every e, energy for e = 1.
/// @param w1, w2       speeds before the impact [rad/s]
/// @param mass_ratio   m2/m1 [-]
/// @param restitution  in [0, 1]
template <class T>
std::pair<T, T> speeds_after_impact(const T& w1, const T& w2, const T& mass_ratio, double restitution) {
  const T impulse = (1.0 + restitution) * (w1 - w2) / (1.0 + mass_ratio);  // over m2
  return {w1 - mass_ratio * impulse, w2 + impulse};
}

}  // namespace gapscope
