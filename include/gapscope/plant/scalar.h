#pragma once

#include <ceres/jet.h>

#include <type_traits>

namespace gapscope {

/// Forward-mode derivative numbers: a value and N partial derivatives. The plant and the simulator are
/// templated on the scalar and run on double or on these.
template <int N>
using Jet = ceres::Jet<double, N>;

inline double value_of(double x) { return x; }
template <int N>
double value_of(const Jet<N>& x) {
  return x.a;
}

/// True where T carries derivatives.
template <class T>
inline constexpr bool kIsJet = !std::is_same_v<T, double>;

}  // namespace gapscope
