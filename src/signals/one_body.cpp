#include "signals/one_body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/local_motion.h"

namespace gapscope::internal::signals {
namespace {

constexpr std::size_t kRows = 500;  ///< of the balance, per recording

/// Least-squares slope over uneven steps.
double slope_over_stamps(std::span<const double> t, std::span<const double> x) {
  const double centre = mean(t);
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    sum += (t[i] - centre) * x[i];
    weight += (t[i] - centre) * (t[i] - centre);
  }
  return sum / weight;
}

/// Least-squares slope of x1 over n samples from `first`.
double slope(const MotorTrace& r, std::size_t first, std::size_t n) {
  if (!r.even()) return slope_over_stamps(r.stamps.subspan(first, n), r.x1.subspan(first, n));
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

/// Time from `stride` samples before a sample to it [s].
double time_before(const MotorTrace& r, std::size_t sample, std::size_t stride) {
  if (r.even()) return static_cast<double>(stride) * r.dt;
  return r.stamps[sample] - r.stamps[sample - stride];
}

Balance balance_of(const MotorTrace& r) {
  Balance b;
  const std::size_t n = speed_window(r);
  const std::size_t stride = std::max<std::size_t>(1, (r.size() - n) / kRows);
  double impulse = 0.0, direction = 0.0;
  std::size_t done = 0;
  for (std::size_t first = 0; first + n <= r.size(); first += stride) {
    const double w = slope(r, first, n);
    const std::size_t centre = first + n / 2;
    for (; done < centre; ++done) impulse += r.u[done] * r.step(done);
    if (first > 0) direction += (w > 0.0 ? 1.0 : w < 0.0 ? -1.0 : 0.0) * time_before(r, centre, stride);
    b.rows.push_back({w, r.x1[centre] - r.x1[0], direction, r.elapsed(centre)});
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

OneBody as_one_body(std::span<const MotorTrace> recordings) {
  OneBody body;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0.0, count = 0.0;
  for (const MotorTrace& r : recordings) {
    Balance b = balance_of(r);
    for (const auto& row : b.rows) {
      squares += row[0] * row[0];
      body.peak_speed = std::max(body.peak_speed, std::abs(row[0]));
    }
    count += static_cast<double>(b.rows.size());
    centre(b);
    for (std::size_t i = 0; i < b.rows.size(); ++i) {
      const Eigen::Map<const Eigen::Vector4d> row(b.rows[i].data());
      normal += row * row.transpose();
      right += row * b.impulse[i];
    }
    const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
    body.travel = std::max(body.travel, *high - *low);
    for (const double u : r.u) body.peak_input = std::max(body.peak_input, std::abs(u));
  }
  body.speed = std::sqrt(squares / std::max(1.0, count));
  const Eigen::Vector4d scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::Matrix4d scaled =
      scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
  const Eigen::Vector4d solution = (scaled + 1e-9 * Eigen::Matrix4d::Identity())
                                       .ldlt()
                                       .solve(right.cwiseQuotient(scale))
                                       .cwiseQuotient(scale);
  body.inertia = solution[0];
  body.damping = solution[1];
  body.friction = solution[2];
  return body;
}

}  // namespace gapscope::internal::signals
