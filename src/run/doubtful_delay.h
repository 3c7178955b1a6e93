#pragma once

#include <string>
#include <vector>

#include "config/configuration.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::run {

/// Of a delay or lag that was found in a recording which begins with its input on: what was sent before is
/// not in it. Where the delay comes out as another one without the beginning, both are told, and the window
/// that leaves it out; else, or without such a delay, nothing.
/// @param fitted  what the diagnosis fitted
std::string doubtful_delay(const Configuration& configuration, std::vector<MotorTrace> fitted,
                           const Diagnosis& diagnosis);

}  // namespace gapscope::internal::run
