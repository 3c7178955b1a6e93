#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gapscope/recording/loss.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

/// The steps that are longer than 1.5 usual ones, where the rows behind stay late. Usual is the mean of all
/// steps but pauses, or that of the twenty around where it is longer: a loop that slows down for a while has
/// lost nothing.
/// @param t  times of rows, rising [s]
std::vector<Loss> losses_of(std::span<const double> t);

/// How many rows are missing between the others; 0 for rows on a grid.
std::size_t lost_rows(const Recording& recording);

/// Rows that were lost took their inputs with them, and u is held over each step: the input of the row before
/// a loss becomes the mean of what stood there, the lost ones drawn as a line to the next row, so that its
/// impulse is that of the drive to first order. Rows on a grid stay as they are.
/// @returns how many rows were bridged
std::size_t bridge_lost_rows(Recording& recording);

}  // namespace gapscope
