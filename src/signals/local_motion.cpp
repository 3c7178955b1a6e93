#include "signals/local_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace gapscope::internal::signals {
namespace {

constexpr double kSpeedWindow = 0.02;  ///< over which the slope of x1 is taken as the speed [s]
constexpr std::size_t kFewestInWindow = 9;

/// Cubic over the first n samples (a drive at rest starts with t³ under an input that starts at zero);
/// `misfit` is its rms residual.
LocalMotion cubic(const MotorTrace& r, std::size_t samples, double floor, double& misfit) {
  const auto n = static_cast<Eigen::Index>(samples);
  Eigen::MatrixXd basis(n, 4);
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = r.even() ? static_cast<double>(i) : r.elapsed(static_cast<std::size_t>(i)) / r.dt;
    basis.row(i) << 1.0, t, t * t, t * t * t;
    x[i] = r.x1[static_cast<std::size_t>(i)] - r.x1[0];
  }
  const Eigen::Matrix4d inverse = (basis.transpose() * basis).inverse();
  const Eigen::Vector4d fitted = inverse * (basis.transpose() * x);
  misfit = (x - basis * fitted).norm() / std::sqrt(static_cast<double>(n - 4));
  return {r.x1[0] + fitted[0], fitted[1] / r.dt, std::sqrt(inverse(1, 1)) * floor / r.dt};
}

}  // namespace

std::size_t speed_window(const MotorTrace& r) {
  const auto samples = static_cast<std::size_t>(std::lround(kSpeedWindow / r.dt));
  return std::min(std::max(samples | 1U, kFewestInWindow), r.size() / 2);
}

LocalMotion local_motion(const MotorTrace& r, double floor) {
  LocalMotion motion;
  for (std::size_t n = speed_window(r);; n = std::max(2 * n / 3, kFewestInWindow)) {
    double misfit = 0.0;
    motion = cubic(r, n, floor, misfit);
    if (misfit < 1.3 * floor || n <= kFewestInWindow) return motion;
  }
}

}  // namespace gapscope::internal::signals
