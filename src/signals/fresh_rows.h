#pragma once

#include <span>

namespace gapscope::internal::signals {

/// How the rows between two readings of a position came about.
enum class Filling {
  kNone,          ///< there are none: no rows are held, or on a line
  kHeld,          ///< the last reading stands again
  kInterpolated,  ///< they lie on a line from reading to reading
  kCannotBeTold   ///< the motion shows too little of it
};

/// Whether each row of a position is a reading of its own, from the rows alone.
struct FreshRows {
  Filling filling = Filling::kCannotBeTold;
  double every = 1.0;  ///< rows from one reading to the next

  bool are_filled() const { return filling == Filling::kHeld || filling == Filling::kInterpolated; }
};

/// A held position moves, and an interpolated one changes its speed, at readings alone. So the first, or the
/// second, difference of rows that are filled n at a time is other than zero only at distances that are
/// multiples of n, at any speed; rows that are read anew have any distance. Lines that were rounded to counts
/// again have second differences of a count anywhere: there only larger ones tell, and without these it
/// cannot be told. Where n is no whole number, as of a slower clock, a fast motion tells it by the rows for
/// which it stands still.
/// @param x        rows of a position, as they stand in the file [rad]
/// @param quantum  of the encoder, 0: none is known [rad]
FreshRows fresh_rows(std::span<const double> x, double quantum);

}  // namespace gapscope::internal::signals
