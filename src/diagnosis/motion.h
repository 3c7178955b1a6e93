#pragma once

#include <string>

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// What stands still is explained by any friction, so its recording asks nothing.
/// @throws ConfigError naming the file unless x1 moves beyond its encoder's noise and counts
void require_motion(const MotorTrace& recording);

/// @throws ConfigError naming the first of the recordings that judge, where none of them moves in any window
void require_motion(const HeldOut& held_out);

/// Whether x1 stands still in most of the windows that judge: those ask for nothing.
bool mostly_rests(const HeldOut& held_out);

/// Share of the motion that a model leaves: error of its free runs over x1 about its mean, rms over a window,
/// median over the windows in which x1 moves. A drive that stands still leaves 1. NaN: x1 moves in no window.
double unexplained_motion(const HeldOut& held_out, const ScoredModel& model);

/// What such a model leaves, in words, where it is hardly better than a drive that stands still: it says
/// nothing of the real one, however small its errors are. Empty where it explains the motion.
std::string motion_left(const HeldOut& held_out, const ScoredModel& model);

}  // namespace gapscope::internal::diagnosis
