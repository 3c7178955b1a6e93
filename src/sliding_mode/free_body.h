#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {

/// The law of a body that nothing else acts on, be it the motor alone within its gap or motor and load as
/// one: ẍ = drive·u + constant − viscous·ẋ − (dry + sticking·e^(−|ẋ|/fading))·sign(ẋ). It stays where it came
/// to rest while the torque is below dry + sticking, and friction never drives it.
struct FreeBody {
  double drive = 0.0;     ///< [rad/s² per unit of u]
  double viscous = 0.0;   ///< [1/s], at least 0
  double dry = 0.0;       ///< [rad/s²], at least 0
  double constant = 0.0;  ///< gravity, an offset of u [rad/s²]
  double sticking = 0.0;  ///< more than that at rest; with `dry` at least 0 [rad/s²]
  double fading = 1.0;    ///< speed at which that has fallen to 1/e [rad/s]
};

/// How many of these numbers a fit seeks, from the first on.
enum class FreeNumbers { kDriveAndFriction = 3, kConstant = 4, kSticking = 6 };

/// One instant further: input and friction are constant meanwhile, but for the friction's sign.
void advance(const FreeBody& body, double u, double dt, double& x, double& v);

/// Instants through which a body is followed, from a speed of its own.
struct FreeStretch {
  std::size_t first = 0, last = 0;
};

/// A motion, and what is followed of it.
struct FreeMotion {
  double dt = 0.0;           ///< between instants [s]
  std::vector<double> u, x;  ///< the input, held from its instant to the next, and the place [rad]
  std::vector<FreeStretch> stretches = {};
};

/// A limit of work: at most 24 of all, spread evenly.
template <class T>
std::vector<T> spread(std::span<const T> all) {
  std::vector<T> some;
  for (std::size_t k = 0; k < all.size(); k += (all.size() + 23) / 24) some.push_back(all[k]);
  return some;
}

/// What a body leaves of x, less the mean over its stretch: where that begins does not matter to the motion.
struct FollowedBody {
  FreeBody body;
  Eigen::VectorXd speeds = {};  ///< at the begin of each stretch [rad/s]
  double left = kInfinity;      ///< rms, in means over eightieths of a stretch [rad]
  double squares = kInfinity;   ///< sum over all instants [rad²]
};

/// The body, and the speeds, that leave least squares of those means: Levenberg and Marquardt (Eigen's).
/// @param start  of the search; if it is not driven, nothing is followed and left is infinite
FollowedBody follow(const FreeMotion& motion, const FreeBody& start, FreeNumbers numbers);

}  // namespace gapscope::internal::sliding_mode
