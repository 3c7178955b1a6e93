#pragma once

#include "results/blind_records.h"
#include "results/blind_score.h"

namespace gapscope {

/// Counts the cases of the report part; probabilities are calibrated on the other part alone. Labels and
/// answers are taken as they are: whoever calls has verified them.
BlindScore score_blind_answers(const BlindLabels& labels, const BlindAnswers& answers);

}  // namespace gapscope
