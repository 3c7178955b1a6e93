#pragma once

#include <vector>

#include "report/figure_data.h"
#include "results/blind_score.h"

namespace gapscope::internal::report {

/// Confusion matrix; calibration and abstention; shares per rig, severity and effect.
std::vector<FigureData> blind_figures(const BlindScore& score);

}  // namespace gapscope::internal::report
