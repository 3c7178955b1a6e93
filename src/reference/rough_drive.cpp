#include "reference/rough_drive.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::reference {
namespace {

constexpr double kSpeedWindow = 0.02;  ///< over which the slope of x1 is taken as the speed [s]
constexpr std::size_t kFewestInWindow = 9;
constexpr std::size_t kRows = 500;  ///< of the balance, per recording

std::size_t window_of(const MotorTrace& r) {
  const auto samples = static_cast<std::size_t>(std::lround(kSpeedWindow / r.dt));
  return std::min(std::max(samples | 1U, kFewestInWindow), r.size() / 2);
}

/// Least-squares slope of x1 over n samples from `first`.
double slope(const MotorTrace& r, std::size_t first, std::size_t n) {
  const double centre = 0.5 * static_cast<double>(n - 1);
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) - centre;
    sum += t * r.x1[first + i];
    weight += t * t;
  }
  return sum / (weight * r.dt);
}

/// Rows of the balance of one recording, with a constant of integration of its own.
struct Balance {
  std::vector<std::array<double, 4>> rows;  ///< w, x, ∫sign w, t
  std::vector<double> impulse;              ///< ∫u
};

Balance balance_of(const MotorTrace& r) {
  Balance b;
  const std::size_t n = window_of(r);
  const std::size_t stride = std::max<std::size_t>(1, (r.size() - n) / kRows);
  double impulse = 0.0, direction = 0.0;
  std::size_t done = 0;
  for (std::size_t first = 0; first + n <= r.size(); first += stride) {
    const double w = slope(r, first, n);
    const std::size_t centre = first + n / 2;
    for (; done < centre; ++done) impulse += r.u[done] * r.dt;
    if (first > 0) direction += (w > 0.0 ? 1.0 : w < 0.0 ? -1.0 : 0.0) * static_cast<double>(stride) * r.dt;
    b.rows.push_back({w, r.x1[centre] - r.x1[0], direction, static_cast<double>(centre) * r.dt});
    b.impulse.push_back(impulse);
  }
  return b;
}

/// Means over one recording removed: its constant of integration.
void centre(Balance& b) {
  std::array<double, 4> sums{};
  double total = 0.0;
  const double count = static_cast<double>(b.rows.size());
  for (std::size_t i = 0; i < b.rows.size(); ++i) {
    for (std::size_t j = 0; j < 4; ++j) sums[j] += b.rows[i][j] / count;
    total += b.impulse[i] / count;
  }
  for (std::size_t i = 0; i < b.rows.size(); ++i) {
    for (std::size_t j = 0; j < 4; ++j) b.rows[i][j] -= sums[j];
    b.impulse[i] -= total;
  }
}

}  // namespace

RoughDrive rough_drive(std::span<const MotorTrace> recordings) {
  RoughDrive rough;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0.0, count = 0.0;
  for (const MotorTrace& r : recordings) {
    Balance b = balance_of(r);
    for (const auto& row : b.rows) {
      squares += row[0] * row[0];
      rough.peak_speed = std::max(rough.peak_speed, std::abs(row[0]));
    }
    count += static_cast<double>(b.rows.size());
    centre(b);
    for (std::size_t i = 0; i < b.rows.size(); ++i) {
      const Eigen::Map<const Eigen::Vector4d> row(b.rows[i].data());
      normal += row * row.transpose();
      right += row * b.impulse[i];
    }
    const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
    rough.travel = std::max(rough.travel, *high - *low);
    for (const double u : r.u) rough.peak_input = std::max(rough.peak_input, std::abs(u));
  }
  rough.speed = std::sqrt(squares / std::max(1.0, count));
  const Eigen::Vector4d scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::Matrix4d scaled =
      scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
  const Eigen::Vector4d solution = (scaled + 1e-9 * Eigen::Matrix4d::Identity())
                                       .ldlt()
                                       .solve(right.cwiseQuotient(scale))
                                       .cwiseQuotient(scale);
  rough.inertia = solution[0];
  rough.damping = solution[1];
  rough.friction = solution[2];
  return rough;
}

namespace {

/// Cubic over the first n samples (a drive at rest starts with t³ under an input that starts at zero);
/// `misfit` is its rms residual.
LocalMotion cubic(const MotorTrace& r, std::size_t samples, double floor, double& misfit) {
  const auto n = static_cast<Eigen::Index>(samples);
  Eigen::MatrixXd basis(n, 4);
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i);
    basis.row(i) << 1.0, t, t * t, t * t * t;
    x[i] = r.x1[static_cast<std::size_t>(i)] - r.x1[0];
  }
  const Eigen::Matrix4d inverse = (basis.transpose() * basis).inverse();
  const Eigen::Vector4d fitted = inverse * (basis.transpose() * x);
  misfit = (x - basis * fitted).norm() / std::sqrt(static_cast<double>(n - 4));
  return {r.x1[0] + fitted[0], fitted[1] / r.dt, std::sqrt(inverse(1, 1)) * floor / r.dt};
}

}  // namespace

LocalMotion local_motion(const MotorTrace& r, double floor) {
  LocalMotion motion;
  for (std::size_t n = window_of(r);; n = std::max(2 * n / 3, kFewestInWindow)) {
    double misfit = 0.0;
    motion = cubic(r, n, floor, misfit);
    if (misfit < 1.3 * floor || n <= kFewestInWindow) return motion;
  }
}

double encoder_floor(const MotorTrace& r) {
  std::vector<double> fourth;
  fourth.reserve(r.size());
  for (std::size_t i = 4; i < r.size(); ++i)
    fourth.push_back((r.x1[i] - 4.0 * r.x1[i - 1] + 6.0 * r.x1[i - 2] - 4.0 * r.x1[i - 3] + r.x1[i - 4]) /
                     std::sqrt(70.0));
  const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
  const double quantised = r.quantum / std::sqrt(12.0);
  return std::max({quantised, robust_std(fourth), 1e-9 * (*high - *low), 1e-15});
}

}  // namespace gapscope::internal::reference
