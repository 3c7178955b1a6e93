#pragma once

#include "gapscope/recording/recording.h"

namespace gapscope {

/// How many rows are missing between the others: what each step of the stamps has room for beside its own, by
/// the median step. 0 for rows on a grid.
std::size_t lost_rows(const Recording& recording);

/// Rows that were lost took their inputs with them, and u is held over each step: the input of the row before
/// a loss becomes the mean of what stood there, the lost ones drawn as a line to the next row, so that its
/// impulse is that of the drive to first order. Rows on a grid stay as they are.
/// @returns how many rows were bridged
std::size_t bridge_lost_rows(Recording& recording);

}  // namespace gapscope
