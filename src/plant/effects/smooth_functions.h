#pragma once

#include <cmath>

#include "gapscope/plant/scalar.h"

namespace gapscope::internal::plant {

/// sin y + h₀ sin 2y + h₁ cos 2y + h₂ sin 3y + h₃ cos 3y. With derivatives at the price of one sine and one
/// cosine.
template <class T>
T three_harmonics(const T& y, const T* h) {
  const double s = std::sin(value_of(y)), c = std::cos(value_of(y));
  const double s2 = 2.0 * s * c, c2 = (c - s) * (c + s), s3 = s2 * c + c2 * s, c3 = c2 * c - s2 * s;
  const double a2 = value_of(h[0]), b2 = value_of(h[1]), a3 = value_of(h[2]), b3 = value_of(h[3]);
  const double value = s + a2 * s2 + b2 * c2 + a3 * s3 + b3 * c3;
  if constexpr (kIsJet<T>)
    return T(value, (c + 2.0 * (a2 * c2 - b2 * s2) + 3.0 * (a3 * c3 - b3 * s3)) * y.v + s2 * h[0].v +
                        c2 * h[1].v + s3 * h[2].v + c3 * h[3].v);
  else
    return value;
}

/// How much faster than sin y that changes.
template <class T>
double harmonics_rate(const T* h) {
  return 1.0 + std::abs(value_of(h[0])) + std::abs(value_of(h[1])) +
         2.0 * (std::abs(value_of(h[2])) + std::abs(value_of(h[3])));
}

/// bⁿ of a positive b. With derivatives at the price of one power and one logarithm.
template <class T>
T power(const T& b, const T& n) {
  const double value = std::pow(value_of(b), value_of(n));
  if constexpr (kIsJet<T>)
    return T(value, (value * n.a / b.a) * b.v + (value * std::log(b.a)) * n.v);
  else
    return value;
}

}  // namespace gapscope::internal::plant
