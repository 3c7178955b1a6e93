#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// Where the motion does not bear out an established cause, which of the two tells it: " by the torque
/// balance alone; the free run cannot tell: its error shrinks by 46 % (95 %: -116 to 83)". Empty where it
/// does, or nothing was added.
std::string doubt_of_motion(const Diagnosis& diagnosis);

/// The doubts about established causes in brief and without their numbers, as the beginning of a cause:
/// "Likely, not confirmed (by the torque balance; the free run, restarted again and again, cannot tell)".
std::string brief_doubt(const Diagnosis& diagnosis, Coordinates coordinates);

/// A share of the error above the floor in per cent: below the floor nothing more can shrink.
std::string percent_of_shrink(double shrink);

/// "free-run error" or "prediction error": what the motion is judged by.
std::string motion_error(const Diagnosis& diagnosis);

/// The answer in a sentence or two.
std::string sentence_of(const Diagnosis& diagnosis, Coordinates coordinates);

/// " at 24 cycles per turn", " every 2.5 mm": tells lines of one law apart. Empty for what has no period.
std::string period_words(const AddedEffect& added, Coordinates coordinates);

/// Whether the first cause is open and a later one established: that one holds with the first in the model.
bool rests_on_open_cause(const Diagnosis& diagnosis);

/// What an added effect is called, with what the sign of its parameters makes of it, and with its period
/// where it was added more than once.
std::string name_of(const AddedEffect& added, const Diagnosis& diagnosis, Coordinates coordinates);

}  // namespace gapscope::internal::diagnosis
