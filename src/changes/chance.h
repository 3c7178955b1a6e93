#pragma once

namespace gapscope::internal::changes {

/// Probability of a standard normal number that far from zero or farther, on either side.
double normal_beyond(double z);

/// Two-sided quantile of a normal distribution: exceeded with probability p on both sides together.
double two_sided_quantile(double p);

/// Probability of a sum of squares of so many standard normal numbers that is as large or larger (Wilson and
/// Hilferty, PNAS 17, 1931; off by less than 0.002).
double squares_beyond(double sum, double freedom);

/// The normal number that is as improbable as Student's t (Wallace, Annals of Mathematical Statistics 30,
/// 1959).
double normal_of_student(double t, double freedom);

}  // namespace gapscope::internal::changes
