#pragma once

#include "exports/carried.h"

namespace gapscope::internal::exports {

/// What a loop around a target calls the joint's state and what it may set.
struct LoopWords {
  const char* position;  ///< "qpos"
  const char* speed;
  const char* command;  ///< to which the input goes: "ctrl"
  double gain = 1.0;    ///< of the command [torque per unit of u], where the loop applies it
  const char* torque;   ///< a torque beside it: "qfrc_applied"
  double step = 0.0;    ///< of the loop [s]
};

/// Says beside every effect that the target leaves out and that has a closed form the line that adds it in a
/// loop around the engine, with its numbers: "ctrl = u*(1 + 0.08*sin(6*qpos + 0.5))".
void add_loop_lines(const ExportSource& source, const LoopWords& words, Certificate& certificate);

/// Whether the target lacks a part of the drive that takes it so far off that its steps do not show.
/// @param rms  of x1 at a small step [rad]
bool hides_the_steps(const ExportSource& source, const std::vector<CarriedPart>& parts, double rms,
                     double travel);

/// That the controller is not in the file, and what is its input then.
void tell_controller(const ExportSource& source, Certificate& certificate);

/// A warning, where the target lacks a part of the drive, or approximates one so badly that it is far off,
/// and is off by more than the encoder's floor, by the least row of its errors: how far, what it lacks, and
/// the lines that mend it.
void warn_of_left_out(const ExportSource& source, Certificate& certificate);

}  // namespace gapscope::internal::exports
