#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "report/geometry.h"

namespace gapscope::internal::report {

/// Indices of the samples that a drawing of a long trace needs: of each of `columns` equal parts of the x
/// range the first, lowest, highest and last sample, in order, so that no spike is lost. All indices of a
/// short trace.
/// @param x not falling
std::vector<std::size_t> decimate_columns(std::span<const double> x, std::span<const double> y,
                                          std::size_t columns);

/// For lines that go to and fro (loops): leaves out points nearer than `distance` to the last one kept.
Polyline thin_out(const Polyline& line, double distance);

}  // namespace gapscope::internal::report
