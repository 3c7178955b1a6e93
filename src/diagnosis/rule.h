#pragma once

namespace gapscope::internal::diagnosis {

/// Every number by which the search with the simulator decides. `study_rule judge` shows what half and double
/// of each make of drives of the independent plant; the first five were set so on the seeds 810001 to 810190
/// (known) and 820001 to 820075 (outside).
///
/// S is the score of a model: the mean over held-out windows of the log of what it leaves.
struct DecisionRule {
  double tells_apart = 0.3;  ///< S by which two models differ that the recordings tell apart
  double indistinct = 0.08;  ///< S below which no two models differ
  double least_way = 0.3;    ///< share of the way in S to the floor that a step must go
  double asked_for = 0.99;   ///< of the fitted mean square that a step leaves at most: luck is no finding
  double part = 0.1;  ///< of the free runs' error that a law without freedom may leave and be all of it
  double least_windows =
      0.6;                   ///< of the held-out windows that a step improves where the floor is out of reach
  double clear = 0.6;        ///< S by which evidence leads all others that needs no further experiment
  double floor_ratio = 1.3;  ///< medians of windows within it are at the floor [floor]
  double near_floor = 4.0;   ///< mean square up to which a fit may sit in a minimum beside the best [floor²]
  double far_more = 20.0;    ///< times the size left of what was fitted: what is held out asks for more
  double bad_repetition = 10.0;  ///< floors of the encoder from which the drive's own repetition is the floor
  double least_help = 0.1;       ///< share of the mean square, held out and fitted, that is worth having
};

inline constexpr DecisionRule kRule;

}  // namespace gapscope::internal::diagnosis
