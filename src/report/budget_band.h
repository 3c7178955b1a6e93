#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"

/// The correcting torque as figures show it: in the band in which the error budget judges it, at a scale that
/// shows what it tells.
namespace gapscope::internal::report {

/// Means over the window that passes the budget's band (−3 dB at its top); as it is where there is no budget
/// or its band holds all that is recorded. At either end half a window has no mean: a shorter one would pass
/// what is above the band, where the last sample alone may be ten times what is in it.
/// @param values  of `trace`, one for each sample; NaN stays NaN, and is what has no mean
std::vector<double> within_band(const ErrorBudget& budget, const MismatchTrace& trace,
                                const std::vector<double>& values);

/// " below 64 Hz" where within_band() changes what it is given, else nothing.
std::string band_words(const ErrorBudget& budget, const MismatchTrace& trace);

/// Where the last of the lines over one x would be a black block (Stretches), the means of stretches in place
/// of the samples of all; how long a stretch is, 0: they stay as they are.
double draw_means_of_a_block(std::vector<Series>& lines);

/// How far an axis around zero reaches: to all values, or, where a few lie far away, to 99 % of them.
/// @param least  shown in any case, as far as there are values
double informative_reach(const std::vector<double>& values, double least);

}  // namespace gapscope::internal::report
