#pragma once

#include <span>
#include <vector>

namespace gapscope::internal::signals {

/// y[i] − 4 y[i−1] + 6 y[i−2] − 4 y[i−3] + y[i−4] [unit of y]: smooth motion drops out; white noise of
/// standard deviation σ leaves one of √70 σ.
std::vector<double> fourth_differences(std::span<const double> y);

/// σ of white noise on a signal [unit of y]: the median size of its fourth differences.
double noise_from_differences(std::span<const double> y);

/// The same about any smooth motion, however seldom it is sampled: the spread of eighth differences about
/// their median (what they have in common is none of the noise).
/// @param stamps  time of each sample, for divided differences, which smooth motion leaves as well [s];
/// empty: evenly
///                sampled
double noise_about_motion(std::span<const double> y, std::span<const double> stamps = {});

}  // namespace gapscope::internal::signals
