#pragma once

#include <cstddef>
#include <span>

#include "gapscope/recording/recording.h"
#include "signals/torque_cycles.h"

namespace gapscope::internal::sliding_mode {

/// A branch of a loop: from one extreme of the input over a zero to the next.
struct LoopBranch {
  const MotorTrace* trace = nullptr;
  const signals::TorqueCycles* cycles = nullptr;
  std::size_t crossing = 0;
  double amplitude() const;  ///< smaller one of both half cycles [unit of u]
};

/// Where x1 moves on the branches of one torque level: a gap is passed at once, at one torque; friction and
/// compliance let x1 go along with u.
struct LoopShape {
  double flank = 0.0;  ///< compliance of the loaded flank, upper quarter of the torque [rad per unit of u]
  double free_run =
      0.0;  ///< travel where x1 moves kFree times as easily as elsewhere, median of the branches [rad]
  double sure_run =
      0.0;             ///< the same against the end of the ramp, where noise and counts cannot feign it [rad]
  double alone = 0.0;  ///< the largest move over a tenth of the torque, over the next largest [-]
  double travel = 0.0;      ///< of x1 on a branch, median over them [rad]
  double stands_out = 0.0;  ///< smallest sure run that is one [rad]; infinite: no whole branch
  double visible = 0.0;     ///< smallest gap that would have stood out [rad]; infinite: no whole branch
};

/// @param amplitude  of the level: branches of kSameLevel times as much belong to it as well
/// @param resolution of one position [rad]   @param least_way  that is surely none of noise and counting
/// [rad]
LoopShape read_shape(std::span<const LoopBranch> branches, double amplitude, double resolution,
                     double least_way);

constexpr double kSameLevel = 1.3;  ///< amplitudes within this factor are one level
constexpr double kFinest = 30.0;    ///< smallest play that is read, in standard deviations of one position

bool within_level(double amplitude, double level);

}  // namespace gapscope::internal::sliding_mode
