#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/loop_numbers.h"
#include "gapscope/recording/recording.h"

namespace gapscope::internal::diagnosis {

/// Something that a loop has.
struct LoopPart {
  std::string key;
  std::function<void(Loop& loop)> take_out;
  bool of_law = false;  ///< of the controller itself, not of the drive
};

/// Something that a loop may lack, and the sizes at which it is begun with.
struct LoopAddition {
  std::vector<double> starts;
  std::function<void(Loop& loop, double start)> put;
  std::vector<LoopPart> parts;
};

/// Those that the loop does not have.
std::vector<LoopAddition> additions_to(const Loop& loop, std::span<const MotorTrace> recordings);

/// The loop with the torque constant with which its controller holds what hangs on the drive where it stands,
/// and a drive as quick as the motion: what no law of the goal has spoiled. Nothing without such rests, or
/// where the constant is known.
std::optional<Loop> held_at_rest(const Loop& loop, std::span<const MotorTrace> recordings);

}  // namespace gapscope::internal::diagnosis
