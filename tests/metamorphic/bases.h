#pragma once

#include "metamorphic/told_drive.h"

namespace gapscope::metamorphic {

/// Three drives whose gap is known. A: passages of the gap and nothing else (configs/02). B: a recording by
/// the independent plant (configs/03), begun and, as W, whole. C: a random motion with detents that the model
/// lacks (configs/08), in which nothing reads a gap without a model.
enum class Base { kSine, kRecorded, kRecordedWhole, kCogging };

char letter_of(Base base);
Base base_of(char letter);

/// As its configuration has it, the simulated ones as a CSV and no longer than their estimate needs.
const ToldDrive& drive_of(Base base);

double true_gap(Base base);  ///< [rad]

}  // namespace gapscope::metamorphic
