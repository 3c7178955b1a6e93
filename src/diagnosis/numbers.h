#pragma once

#include <array>
#include <cstddef>

#include "reference/model_fit.h"

/// Every number of the diagnosis that was chosen, with those by which it decides (rule.h) and those of its
/// probabilities, which are learned (probability.cpp). docs/science.md tells what half and double of the rule
/// and of the effort do.
namespace gapscope::internal::diagnosis {

/// How a model is laid beside a recording.
struct Measure {
  double slow_hz = 3.0;            ///< poles of the observer at which slow drifts show [Hz]
  double fast_hz = 30.0;           ///< of the one at which ripple shows [Hz]
  double ripple_hz = 150.0;        ///< of one that follows a torque over the motor angle at most speeds [Hz]
  double restart = 0.5;            ///< of the free runs [s]
  double fewest_restarts = 8.0;    ///< short recordings are divided into so many
  double train_share = 2.0 / 3.0;  ///< of each file, where nothing else is held out
  double score_offset = 0.3;       ///< of a mean square in its logarithm [floor²]: below it nothing counts
  double score_per_parameter = 0.04;  ///< of an effect, in S
};
inline constexpr Measure kMeasure;

/// Recordings that a search looks at, of many: what a servo lacks shows on some minutes of them, and its
/// numbers are fitted to all in the end.
struct FewRecordings {
  std::size_t fewest = 3;           ///< recordings, however long
  std::size_t rows = 6000;          ///< of all together, from which no more are taken
  std::size_t longest_rows = 2000;  ///< of one, or more where these are shorter than
  double longest = 20.0;            ///< [s]
};
inline constexpr FewRecordings kFewRecordings;

/// Free runs by which the numbers of a recommended model are fitted, see long_runs.h. Of the linear axis of
/// docs/torque_balance.md, fitted to one recording, seven ways of cutting it left 7.7 to 8.8 mm rms of the
/// whole of the other one; this one, which was settled on with that one in sight, leaves 8.15.
struct LongRuns {
  std::array<std::size_t, 3> parts = {1, 3, 12};  ///< of a recording, for each of which the runs begin anew
  double fine = 0.1;  ///< of the travel: period of a line whose phase a run soon loses
  int iterations = 12;
};
inline constexpr LongRuns kLongRuns;

/// How far the search with the simulator goes: as far as the seeds 860001 to 860036 of study_diagnosis
/// (known) and those of 880001 to 880140 that shorter searches had lost ask for. `study_rule effort` shows
/// half and double.
struct SearchEffort {
  int race_steps = 2;    ///< by which a start is adjusted before it is compared with others
  double weaker = 0.15;  ///< of a start: a weaker one; there a sine acts in proportion, too
  /// To tell whether a start, or a law, is worth a whole refinement.
  reference::RefineEffort quick = {3, 8, 1e-3};
  /// Iterations of each local search by which the numbers of an answer settle: with 60, as fit() has, no gap
  /// of eight drives (`study_rows`, seeds 5111 to 5140) moves by more than about a tenth of its interval.
  int settling = 20;
  /// Period with which a torque over the whole travel begins [travel]: it need not close.
  double past_travel = 2.0;
  /// Of the race that are refined, of these that are refined once more, and rounds of refining a law of last
  /// resort.
  std::size_t leaders = 5;
  double far_better = 0.5;   ///< of the mean square: another minimum, or an effect that explains much
  std::size_t lines = 3;     ///< of the correcting torque that periodic effects begin with and that are told
  std::size_t branches = 2;  ///< first steps that are followed where the best is unsure
  std::size_t most_effects = 4;
  /// Work of further steps after which none is begun [first steps]: of 20 pairs (`study_diagnosis 7310005 10
  /// pair`, `7310101 10 pair`) the last right one began at 1.1 at most, while what nothing explains would be
  /// looked for in every branch, up to 16.
  double most_steps_of_work = 3.0;
};

/// Lines of the correcting torque over the motor angle. One cycle over the travel is as wide as a line.
struct LineSearch {
  std::size_t bins = 2048;   ///< of the motor angle
  double step = 0.2;         ///< between lines that are tried [cycles over the travel]; as many as bins
  double neighbours = 6.0;   ///< as far as a line is compared with others [cycles over the travel]
  double stands_out = 20.0;  ///< share of a line over the median of its neighbours': of noise it is 11
  double spike = 3.0;        ///< at which a torque is cut [robust standard deviations]
};
inline constexpr LineSearch kLineSearch;

/// When a thing is worth a word, beside the rule by which effects are named. The two of other recordings were
/// set on the seeds 860001 to 860140 of study_diagnosis (known).
struct Telling {
  double beyond_chance = 0.1;    ///< of the error, that a phase has more than its share of time
  double hardly_any = 0.1;       ///< of the time in motion: a direction that has less is hardly recorded
  double whole_run_drift = 0.1;  ///< of the travel, that a whole run drifts off
  double clear_change = 0.1;     ///< of a number, that it moves
  double narrow = 0.1;           ///< half the interval of a change, over the change
  double open_gap = 0.1;         ///< half the interval of a gap, over the gap: said to be left open
  double little_torque_percent = 1.0;  ///< of the input: one may stop there [%]
  double clearly_more = 3.16;  ///< ratio of sizes, midway between alike and beyond doubt (DecisionRule::far)
  double strength = 0.25;      ///< share of the correcting torque that a pattern explains to be named
  double dense = 1.5;          ///< times what an error without a place would have in a phase of the contact
  double most_left = 0.25;     ///< of the motion: 0.02 on drives, 0.5 and more where u moves nothing
  double drift = 1.6;          ///< growth of the difference from one period to two that is a drift
  double rival_share = 0.5;    ///< of what the best gains: else no experiment is worth its time
  double separated = 1.0;      ///< σ by which an experiment tells two models apart
  double coarser = 1.5;        ///< times the sheet's quantum: another encoder than it says
  double on_grid = 0.1;        ///< mean distance from whole quanta of samples that are counted in it [quanta]
  double other_recording = 4.0;  ///< times that another recording shows more or less of what is missing
  double floor_spread = 0.5;     ///< by which recordings of a drive differ near the floor [floor]
  int fewest_in_bin = 20;        ///< samples of a correcting torque whose mean is drawn
  double inflation = 2.0;  ///< of a torque's interval: blocks of one recording agree too well for the next
};
inline constexpr Telling kTelling;

}  // namespace gapscope::internal::diagnosis
