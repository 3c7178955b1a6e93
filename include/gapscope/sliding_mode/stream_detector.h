#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gapscope/sliding_mode/gap_estimate.h"

namespace gapscope {

/// What a stream was told by its first two periods, and holds to from then on.
struct LearntFacts {
  double until = kNaN;          ///< time of the last sample that it was learnt from [s]
  double half_period = kNaN;    ///< [s]
  double quantum = kNaN;        ///< of the encoder [rad]; 0: none seen
  double noise = kNaN;          ///< standard deviation of a sample [rad]
  double travel = kNaN;         ///< [rad]
  double sliding_bound = kNaN;  ///< L_acc, the smallest bound that slides 80 % of the time [rad/s²]
  double least_bound = kNaN;    ///< that an event must reach to count [rad/s²]
  std::vector<double> bounds;   ///< L, rising [rad/s²]
  std::vector<double> floors;   ///< of |e_x|, one for each bound [rad]
};

/// The impact method on samples as they come (bound: auto), in memory that does not grow: 8 periods of 50
/// numbers a sample, and what is learnt from. Bounds, floors and thresholds are learnt from the first two
/// periods and then frozen; a passage is told at most three quarters of a half period after its impact.
/// detect_gap() with `frozen` finds the same events, bit for bit, whatever the pieces in which samples come.
/// Against a detect_gap() that looks at the whole recording: what the drive does later cannot correct what
/// was learnt, and there is no mean period and no lost-motion loop to fall back on.
class StreamDetector {
 public:
  /// Passages that estimate() judges: the last so many.
  static constexpr std::size_t kMostJudged = 8192;

  /// @param dt  time from sample to sample [s]   @param quantum  of the encoder [rad]; 0: as the samples show
  /// @throws std::logic_error unless dt > 0
  StreamDetector(double start, double dt, double quantum = 0.0);
  ~StreamDetector();
  StreamDetector(StreamDetector&&) noexcept;
  StreamDetector& operator=(StreamDetector&&) noexcept;

  void push(double u, double x1);
  void finish();  ///< no more samples: what is left is read with what there is

  bool has_learnt() const;
  LearntFacts learnt() const;    ///< NaN and empty before
  std::vector<GapEvent> take();  ///< passages since the last call, in time
  std::size_t passages() const;  ///< since the start
  GapEstimate estimate() const;  ///< verdict and gap of the last kMostJudged passages; lists no events

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gapscope
