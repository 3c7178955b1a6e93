#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "results/blind_score.h"

namespace gapscope::internal::report {

/// What was implanted, by effect, over the share of the held-out error that was foretold for it.
FigureData implant_figure(const BlindScore& score);

/// The text of report.md of a check whose effects were implanted into real recordings.
/// @param sealed  what the seals prove, a sentence
/// @param counts  as a table
std::string implant_text(const BlindScore& score, const std::vector<FigureData>& figures,
                         const std::string& sealed, const std::string& counts);

}  // namespace gapscope::internal::report
