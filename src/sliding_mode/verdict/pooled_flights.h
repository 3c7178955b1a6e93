#pragma once

#include <Eigen/Core>
#include <vector>

#include "gapscope/recording/recording.h"
#include "sliding_mode/kink_fit.h"
#include "sliding_mode/marks/marks.h"

namespace gapscope::internal::sliding_mode {

/// The stretch of one passage that is fitted.
struct PooledStretch {
  TorqueTurn turn;
  double rest = 0.0;  ///< x1 at the zero of the torque [rad]
  double beyond =
      0.0;  ///< how far x1 stays from where it was farthest against the passage without torque [rad]
  double slid = 0.0;  ///< how far x1 still goes against the passage while there is no torque [rad]
  std::size_t first = 0, last = 0;
  double speed = 1.0;  ///< where the tried gap ends, over the median of all
};

/// One kink in all passages at the same distance from rest, and the law of the free motor before it.
struct PooledKink {
  KinkShape shape;
  bool brakes = false;     ///< from the kink on, the load also holds the motor back all the time
  double gap = 0.0;        ///< distance from rest [rad]
  double amplitude = 0.0;  ///< of x1, along the passage, per speed
  double sse = 0.0;        ///< [rad²]
};

/// All passages of a recording looked at together: between the end of its rest and the impact the motor obeys
/// one law of motion with the same numbers in all of them, so that what each of them shows too weakly (a
/// light load, few quanta) shows in their sum.
class PooledFlights {
 public:
  /// @param gap  tried: what is fitted begins at a tenth of it, and ends behind it [rad]
  PooledFlights(const MotorTrace& trace, const std::vector<TorqueTurn>& turns, double noise, double gap);

  std::size_t passages() const { return stretches_.size(); }
  double freedom() const;
  double smooth_sse() const { return smooth_sse_; }
  const std::vector<PooledStretch>& stretches() const { return stretches_; }
  /// What may begin at the kink.
  enum class Onset {
    kAny,     ///< a smooth departure of any sign
    kImpact,  ///< a loss of speed; neither the motor's friction nor the impact drives
    kBraked,  ///< the same, and the friction of a load that is taken along from then on
  };
  /// Least squares with a kink of this shape, the distances low … high tried.
  PooledKink best(const KinkShape& shape, Onset onset, double low, double high, double step) const;
  PooledKink trial(const KinkShape& shape, Onset onset, double gap) const;
  double duration() const {
    return duration_;
  }  ///< median from the zero of the torque to the gap tried [samples]
  double crossing(const PooledStretch& s, double distance) const;  ///< [samples]

 private:
  double smooth(std::size_t i, std::size_t half) const;
  bool prepare(const TorqueTurn& turn, double gap);
  void lay_columns();
  void take_own(Eigen::Ref<Eigen::MatrixXd> columns) const;
  void lay_tracks();
  std::vector<double> crossings(double distance) const;  ///< of all passages [samples]
  Eigen::VectorXd kink_column(const KinkShape& shape, const std::vector<double>& times) const;

  const MotorTrace& trace_;
  double noise_;
  std::size_t half_ = 1;  ///< samples that x1 is smoothed over to either side
  std::vector<double> sums_;
  std::vector<PooledStretch> stretches_;
  struct Track {                        // of a passage, from the zero of the torque on
    std::vector<double> way, farthest;  // of the smoothed x1 from its rest, and so far [rad]
  };
  std::vector<Track> tracks_;
  std::size_t stride_ = 1;            // from row to row of a passage [samples]
  std::vector<Eigen::Index> begins_;  // rows of each passage
  Eigen::MatrixXd own_;               // orthonormal within each passage: 1 and t
  Eigen::MatrixXd basis_, made_;      // orthonormal: what all share, and how the columns are made of it
  Eigen::VectorXd along_, residual_;  // x1 along it, and what is left
  double smooth_sse_ = 0.0, duration_ = 0.0;
};

}  // namespace gapscope::internal::sliding_mode
