#pragma once

namespace gapscope::internal::diagnosis {

/// Every number by which the search with the simulator decides. `study_rule judge` shows what half and double
/// of each make of drives of the independent plant; the first five were set so on the seeds 810001 to 810190
/// (known) and 820001 to 820075 (outside), and seen again on 1700001 and 1710001 (60 each).
///
/// S is the score of a model: the mean over held-out windows of the log of what it leaves.
struct DecisionRule {
  double tells_apart = 0.3;   ///< S by which two models differ that the recordings tell apart
  double indistinct = 0.08;   ///< S below which no two models differ
  double least_way = 0.3;     ///< share of the way in S to the floor that a step must go
  double asked_for = 0.99;    ///< of the fitted mean square that a step leaves at most: luck is no finding
  double worth_having = 0.1;  ///< of the fitted mean square, that a step takes at least
  /// Of the free runs' error beyond their floor: an effect that leaves less is all of the cause.
  double all_of_cause = 0.1;
  double all_of_free_run = 0.01;      ///< the same of a single step, where the prediction is not at its floor
  double evident = 0.1;               ///< of what there was: share that a step must take from the windows
  double best_windows = 0.1;          ///< quantile of the windows in which a free-form law holds best
  double torque_behind_motion = 0.1;  ///< share by which torque and motion may fall apart
  double same_period = 0.1;           ///< by which two lines of one periodic torque differ at most [period]
  double faded = 0.1;  ///< of its size in the balance: an effect that is refitted to less is gone
  /// Of a gap, that the free runs leave where it is told: of 41 drives (`study_diagnosis 7530001 33 unstarted
  /// FILE`, `7530035 8`) half tells one less, double two more, 2.0 and 4.5 % off.
  double little_of_gap = 0.01;
  /// Of the held-out windows that a step improves where the floor is out of reach.
  double least_windows = 0.6;
  double clear = 0.6;  ///< S by which evidence leads all others that bears out others or needs no experiment
  double floor_ratio = 1.3;  ///< medians of windows within it are at the floor [floor]
  double near_floor = 4.0;   ///< mean square up to which a fit may sit in a minimum beside the best [floor²]
  /// Ratio of sizes beyond doubt: a motion over the encoder's floor; the drive's own repetition over it,
  /// which then is the floor; what is held out over what was left of the fitted
  double far = 10.0;
};

inline constexpr DecisionRule kRule;

}  // namespace gapscope::internal::diagnosis
