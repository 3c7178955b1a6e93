#include "torque_view/low_pass.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::torque_view {

double kernel_sigma(double hz) { return std::sqrt(std::log(2.0)) / (2.0 * kPi * hz); }

std::vector<double> cell_lengths(std::span<const double> t) {
  std::vector<double> cells(t.size());
  const std::size_t last = t.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) cells[i] = 0.5 * (t[std::min(i + 1, last)] - t[i > 0 ? i - 1 : 0]);
  return cells;
}

std::vector<double> hold_corrected(std::span<const double> t, std::span<const double> u) {
  std::vector<double> mean(u.begin(), u.end());
  for (std::size_t i = 1; i + 1 < u.size(); ++i)
    mean[i] = (u[i - 1] * (t[i] - t[i - 1]) + u[i] * (t[i + 1] - t[i])) / (t[i + 1] - t[i - 1]);
  return mean;
}

SmoothingKernel::SmoothingKernel(std::span<const double> t, std::span<const double> cells, double sigma,
                                 double reach)
    : t_(t), cells_(cells), sigma_(sigma), half_(reach * sigma) {}

void SmoothingKernel::move_to(double T) noexcept {
  while (first_ < t_.size() && t_[first_] < T - half_) ++first_;
  end_ = std::max(end_, first_);
  while (end_ < t_.size() && t_[end_] <= T + half_) ++end_;
}

double SmoothingKernel::weight(std::size_t i, double T) const noexcept {
  const double s = (t_[i] - T) / sigma_;
  return cells_[i] * std::exp(-0.5 * s * s);
}

SmoothMotion SmoothingKernel::motion(std::span<const double> x, double T) noexcept {
  move_to(T);
  std::array<double, 5> m{};  // moments of the weights, s in σ
  std::array<double, 3> b{};  // of the positions
  const double origin = first_ < x.size() ? x[first_] : 0.0;
  for (std::size_t i = first_; i < end_; ++i) {
    const double s = (t_[i] - T) / sigma_, k = weight(i, T), y = x[i] - origin;
    const double ks = k * s, kss = ks * s;
    m[0] += k, m[1] += ks, m[2] += kss, m[3] += kss * s, m[4] += kss * s * s;
    b[0] += k * y, b[1] += ks * y, b[2] += kss * y;
  }
  Eigen::Matrix3d moments;
  moments << m[0], m[1], m[2], m[1], m[2], m[3], m[2], m[3], m[4];
  const Eigen::Vector3d c = moments.inverse() * Eigen::Vector3d(b[0], b[1], b[2]);
  const double level = (m[2] * b[0] - m[1] * b[1]) / (m[0] * m[2] - m[1] * m[1]);
  return {origin + level, c[1] / sigma_, 2.0 * c[2] / (sigma_ * sigma_)};
}

RowFilter::RowFilter(std::span<const double> t, std::span<const double> cells, std::span<const double> rows,
                     double sigma, double reach) {
  SmoothingKernel kernel(t, cells, sigma, reach);
  for (const double T : rows) {
    kernel.move_to(T);
    double m0 = 0.0, m1 = 0.0, m2 = 0.0;
    weights_.resize(weights_.size() + kernel.end_ - kernel.first_);
    double* const own = weights_.data() + offset_.back();
    for (std::size_t i = kernel.first_; i < kernel.end_; ++i) {
      const double s = (t[i] - T) / sigma, k = own[i - kernel.first_] = kernel.weight(i, T);
      m0 += k, m1 += k * s, m2 += k * s * s;
    }
    const double norm = m0 * m2 - m1 * m1;
    for (std::size_t i = kernel.first_; i < kernel.end_; ++i)
      own[i - kernel.first_] *= (m2 - m1 * (t[i] - T) / sigma) / norm;
    first_.push_back(kernel.first_);
    offset_.push_back(weights_.size());
  }
}

void RowFilter::apply(const double* samples, double* rows) const noexcept {
  using Terms = Eigen::Map<const Eigen::VectorXd>;
  for (std::size_t r = 0; r < first_.size(); ++r) {
    const auto count = static_cast<Eigen::Index>(offset_[r + 1] - offset_[r]);
    rows[r] = Terms(weights_.data() + offset_[r], count).dot(Terms(samples + first_[r], count));
  }
}

void RowFilter::keep(const std::vector<bool>& rows) {
  RowFilter kept;
  for (std::size_t r = 0; r < first_.size(); ++r) {
    if (!rows[r]) continue;
    kept.first_.push_back(first_[r]);
    kept.weights_.insert(kept.weights_.end(), weights_.begin() + static_cast<std::ptrdiff_t>(offset_[r]),
                         weights_.begin() + static_cast<std::ptrdiff_t>(offset_[r + 1]));
    kept.offset_.push_back(kept.weights_.size());
  }
  *this = std::move(kept);
}

}  // namespace gapscope::internal::torque_view
