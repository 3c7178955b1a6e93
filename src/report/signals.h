#pragma once

#include <span>
#include <vector>

#include "gapscope/base/statistics.h"

/// What the figures compute from stored traces.
namespace gapscope::internal::report {

std::vector<double> difference_of(std::span<const double> a, std::span<const double> b);  ///< a − b
std::vector<double> times(std::span<const double> a, double factor);

/// Mean over each sample and up to `reach` neighbours on either side, as many on both.
std::vector<double> moving_mean(const std::vector<double>& values, std::size_t reach);

/// A long trace in equal parts; what is left over at its end is in none.
struct Stretches {
  std::size_t each = 0;                ///< samples of one
  std::vector<double> means, spreads;  ///< mean and standard deviation of each
  /// Whether a line through all samples would be a black block: they differ more within the stretches than
  /// the means do, and are more than a picture of one column has room for.
  bool are_a_block() const;
};
Stretches stretches_of(std::span<const double> values);

/// Middle between the 1 % and the 99 % quantile.
double robust_middle(const std::vector<double>& values);
/// Largest minus smallest value.
double peak_to_peak(std::span<const double> values);
double largest_magnitude(std::span<const double> values);

/// Times at which a signal crosses its middle, with a hysteresis of 30 % of its range: two a period
/// [samples].
std::vector<std::size_t> middle_crossings(std::span<const double> values);

/// Factor 1, 2 or 5 × 10^n that brings `size` nearest below `target`.
double round_factor(double size, double target);

/// Correlation of what came first with what came k samples later, for k = 0, step, 2 step ... lags:
///   c_k = Σ_i (a_i − ā)(b_{i+k} − b̄) / √(Σ (a_i − ā)² Σ (b_i − b̄)²)
/// @param a, b  equally many
std::vector<double> correlation(std::span<const double> a, std::span<const double> b, std::size_t lags,
                                std::size_t step = 1);

/// correlation() of values with themselves. White noise of n samples keeps 95 % of r_1, r_2, ... within
/// ±kNormal95/√n.
std::vector<double> autocorrelation(std::span<const double> values, std::size_t lags, std::size_t step = 1);

}  // namespace gapscope::internal::report
