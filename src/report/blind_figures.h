#pragma once

#include <vector>

#include "gapscope/results/blind_score.h"
#include "report/figure_data.h"

namespace gapscope::internal::report {

/// Confusion matrix; calibration and abstention; shares per rig, severity and effect.
std::vector<FigureData> blind_figures(const BlindScore& score);

}  // namespace gapscope::internal::report
