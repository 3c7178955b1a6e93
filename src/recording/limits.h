#pragma once

#include <cstddef>

namespace gapscope::internal {

/// More rows or samples than this are refused: a mistyped rate must not eat the machine.
constexpr std::size_t kMostSamples = 20'000'000;

/// Largest deviation of a step from the mean step that still counts as uniform [-].
constexpr double kUniformTolerance = 1e-3;

}  // namespace gapscope::internal
