#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gapscope::internal::torque_view {

/// σ of the zero-phase Gaussian low-pass with −3 dB at f: √(ln 2)/(2π f) = 0.1325/f [s].
double kernel_sigma(double hz);

/// Lengths that each sample stands for, (t[i+1] − t[i−1])/2: sums over samples become integrals over the
/// recorded intervals, however uneven.
std::vector<double> cell_lengths(std::span<const double> t);

/// An input that is held from its sample to the next, as the mean over both intervals that meet in a sample;
/// on even stamps (u[k−1] + u[k])/2.
std::vector<double> hold_corrected(std::span<const double> t, std::span<const double> u);

/// Position, speed and acceleration through one Gaussian at one instant: G ∗ x, G' ∗ x, G'' ∗ x.
struct SmoothMotion {
  double x = 0.0, w = 0.0, a = 0.0;
};

/// The kernels are Gaussians times a polynomial in s = t − T that gives them the moments of what they stand
/// for on the samples that there are: Σk = 1, Σks = 0 (mean); Σk = 0, Σks = 1, Σks² = 0 (slope); Σk = 0,
/// Σks = 0, Σks² = 2 (curvature). So neither uneven stamps nor a cut tail leave an offset of x in a speed.
class SmoothingKernel {
 public:
  /// The views must outlive the kernel. @param reach  half its length [σ]
  SmoothingKernel(std::span<const double> t, std::span<const double> cells, double sigma, double reach);

  /// The motion at the time T; calls must come with rising T. Neither allocates nor throws.
  SmoothMotion motion(std::span<const double> x, double T) noexcept;

 private:
  friend class RowFilter;
  void move_to(double T) noexcept;
  double weight(std::size_t i, double T) const noexcept;

  std::span<const double> t_, cells_;
  double sigma_, half_;
  std::size_t first_ = 0, end_ = 0;
};

/// The mean kernel at given rows, kept as weights: one multiplication per sample within reach.
class RowFilter {
 public:
  RowFilter() = default;
  /// @param rows  times, rising [s]
  RowFilter(std::span<const double> t, std::span<const double> cells, std::span<const double> rows,
            double sigma, double reach);

  std::size_t rows() const { return first_.size(); }
  /// What the kernel of a row sees: samples from first to end.
  std::size_t first(std::size_t row) const { return first_[row]; }
  std::size_t end(std::size_t row) const { return first_[row] + offset_[row + 1] - offset_[row]; }
  /// rows = kernel ∗ samples. Neither allocates nor throws.
  void apply(const double* samples, double* rows) const noexcept;
  /// Only those rows.
  void keep(const std::vector<bool>& rows);

 private:
  std::vector<std::size_t> first_, offset_{0};
  std::vector<double> weights_;
};

}  // namespace gapscope::internal::torque_view
