#pragma once

#include <cstddef>
#include <cstdint>

namespace gapscope::internal::recording {

/// More rows or samples than this are refused: a mistyped rate must not eat the machine.
constexpr std::size_t kMostSamples = 20'000'000;

/// Files of recordings with more bytes than this are refused: kMostSamples rows of 200 characters.
constexpr std::uintmax_t kMostBytes = 200 * std::uintmax_t{kMostSamples};

/// Numbers beyond this [SI] are no measurement, and their powers would leave the range of a double.
constexpr double kLargestNumber = 1e15;

/// Rows closer than this, or farther apart, are no samples of a drive [s].
constexpr double kShortestStep = 1e-10, kLongestStep = 1e9;

/// Largest deviation of a step from the mean step that still counts as uniform [-].
constexpr double kUniformTolerance = 1e-3;

}  // namespace gapscope::internal::recording
