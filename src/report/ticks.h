#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "report/figure_data.h"

namespace gapscope::internal::report {

/// Round places on an axis: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 0.0;
  int decimals = 0;            ///< that the labels need
  std::vector<double> values;  ///< all multiples of the step within [low, high]
};

/// The finest round step that puts at most `most` (≥ 2) ticks on [low, high]; up to two more where the next
/// coarser one would leave a single tick, which tells no scale.
Ticks round_ticks(double low, double high, int most);

/// Round places on a logarithmic axis: these multiples of the powers of ten.
/// @param range of the decimal logarithms, in which the places are given
std::vector<Place> log_places(const Interval& range, std::initializer_list<double> multiples);

/// "−0.25" with the decimals of the step and a true minus sign.
std::string tick_label(double value, int decimals);

/// Values are divided by `factor` and shown in `unit`.
struct AxisScale {
  double factor = 1.0;
  std::string unit;
};

/// rad → mrad, µrad, nrad for magnitudes below 1, so that the numbers on the axis stay between 1 and 1000;
/// the same for m, s and torques and forces. Other units stay as they are.
AxisScale axis_scale(const std::string& unit, double magnitude);

}  // namespace gapscope::internal::report
