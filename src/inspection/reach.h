#pragma once

#include <span>
#include <string>

#include "gapscope/base/coordinates.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

/// How far recordings take a drive: a model that is fitted to them is known that far.
struct MotionReach {
  double travel = 0.0;  ///< of x1, peak to peak [rad]
  double speed = 0.0;   ///< that 99 % of the samples stay below, over 20 ms [rad/s]
  double input = 0.0;   ///< the same of |u| [unit of u]; 0 where u is not known
  int reversals = 0;    ///< of the motion, of all recordings together
  double moving = 1.0;  ///< share of the samples in which it moves; of several the largest [-]
};

/// The farthest of several recordings, each quantity for itself; their reversals are added up. A long stretch
/// in which the drive was switched off (u zero at one go, while x1 moves) counts for nothing.
MotionReach reach_of(std::span<const MotorTrace> recordings);

/// In what the second goes clearly farther, with its numbers first: "speed up to 12.7 against 4.38 rad/s";
/// empty where it does not, or where the first goes clearly farther in something else: then neither covers
/// the other; or where the second moves in one direction only and the first in both.
std::string goes_farther(const MotionReach& first, const MotionReach& second, Coordinates coordinates);

/// Why one that is held out judges less than the fitted one shows, with what to do: "moves in one direction
/// only, ..." or "stands still in 83 % of its rows, ..."; empty: it judges all.
std::string judges_little(const MotionReach& fitted, const MotionReach& held_out);

/// Which of two recordings is better fitted, the other one being held out.
struct FittingOrder {
  enum class Fit { kFirst, kSecond, kEither };
  Fit fit = Fit::kEither;
  std::string why;  ///< in what that one goes farther, or that none does, with the numbers of both
};

/// The one that moves in both directions, where the other does not; else that which goes farther
/// (goes_farther()); of two that go as far, the one with clearly more reversals.
FittingOrder fitting_order(const MotionReach& first, const MotionReach& second, Coordinates coordinates);

}  // namespace gapscope
