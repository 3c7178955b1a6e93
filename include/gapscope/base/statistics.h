#pragma once

#include <limits>
#include <span>
#include <vector>

namespace gapscope {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;

/// A closed interval; NaN bounds mean "no interval".
struct Interval {
  double low = kNaN;
  double high = kNaN;
};

double mean(std::span<const double> values);
double rms(std::span<const double> values);

/// Linear between order statistics, fraction in [0, 1]; NaN for no values.
double quantile(std::vector<double> values, double fraction);
double median(std::vector<double> values);

/// Median absolute deviation × 1.4826: the standard deviation of a normal sample.
double robust_std(const std::vector<double>& values);

/// 97.5 % point of Student's t, by the first terms of its series in one over the degrees of freedom (Fisher
/// and Cornish 1960): a tenth short for 2 of them, 2 % for 4, less than 1 % from 5 on.
/// @param freedom  1 or more
double student_975(double freedom);

/// Wilson score limits of a proportion at the given normal quantile (1.96: 95 %).
Interval wilson(int successes, int trials, double z = 1.96);

}  // namespace gapscope
