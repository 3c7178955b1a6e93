#pragma once

#include <cmath>

#include "gapscope/plant/scalar.h"

namespace gapscope::internal::plant {

/// sin y + h sin 2y. With derivatives at the price of one sine and one cosine.
template <class T>
T two_harmonics(const T& y, const T& h) {
  const double s = std::sin(value_of(y)), c = std::cos(value_of(y)), twice = 2.0 * value_of(h);
  if constexpr (kIsJet<T>)
    return T(s * (1.0 + twice * c), (c + twice * (c - s) * (c + s)) * y.v + (2.0 * s * c) * h.v);
  else
    return s * (1.0 + twice * c);
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
