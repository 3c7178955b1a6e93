#pragma once

#include <cstddef>
#include <vector>

#include "sliding_mode/marks/main_events.h"
#include "sliding_mode/marks/torque_turns.h"

/// The door of this room: when something happened to the motor.
namespace gapscope::internal::sliding_mode {

/// What a bank of bounds saw of one recording.
struct Marks {
  BankMarks bank;
  std::vector<BankEvent> events;  ///< main ones, in time
  std::size_t sliding = 0;        ///< index of L_acc, the smallest bound that slides 80 % of the time
  std::size_t deciding = 0;       ///< index of the bound that decides t2
  std::size_t hiding = 0;         ///< index of the bound above which nothing but an impact would show
};

/// @param facts  of this trace, in which something can be detected
Marks find_marks(const MotorTrace& trace, const signals::SignalFacts& facts);

}  // namespace gapscope::internal::sliding_mode
