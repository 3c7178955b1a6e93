#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "diagnosis/loop_numbers.h"
#include "gapscope/recording/recording.h"

namespace gapscope::internal::diagnosis {

constexpr double kLost = 10.0;  ///< error of a motion that diverges [rad]

/// Mean absolute error of the position [rad].
double mean_error(const MotorTrace& trace, const std::vector<double>& x);

/// Where the loop's encoder is at each row of a recording [rad]; empty where the motion diverges.
/// @param phase  of the firmware's turn at the first row, as a share of the turn
std::vector<double> positions_at(double phase, const Loop& loop, const MotorTrace& trace);

/// The phase with which the loop comes nearest to the recording.
double phase_of(const Loop& loop, const MotorTrace& trace);

/// Whole recordings beside a loop, goal in and position out.
class LoopFitter {
 public:
  /// @param threads  0: all cores; the answer is the same for any number
  LoopFitter(std::span<const MotorTrace> traces, int threads)
      : traces_(traces), threads_(threads), phases_(traces.size(), 0.0) {}

  /// Of each recording, in place of zero.
  void find_phases(const Loop& loop);

  /// Mean over the recordings of the mean absolute error [rad].
  double error(const Loop& loop) const;

  /// Down to where no step lessens the error by much. @returns the error there
  double refine(Loop& loop, const std::vector<LoopPlace>& free, int steps) const;

  /// Half of each number's interval, in units of its move.
  Eigen::VectorXd spread(const Loop& loop, const std::vector<LoopPlace>& free) const;

 private:
  struct Normal {
    Eigen::MatrixXd square;
    Eigen::VectorXd slope;
    Eigen::MatrixXd slopes;  ///< the same of each stretch, [numbers × stretches]
  };

  double turn(const Loop& loop) const;  ///< of the firmware [s]
  std::vector<double> positions(const Loop& loop, std::size_t r) const;
  Normal normal_at(const Loop& loop, const std::vector<LoopPlace>& free) const;
  Normal normal_of(const Loop& loop, const std::vector<Loop>& moved, const std::vector<double>& by,
                   std::size_t r) const;

  std::span<const MotorTrace> traces_;
  int threads_;
  std::vector<double> phases_;
};

}  // namespace gapscope::internal::diagnosis
