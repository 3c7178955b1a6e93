#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {

/// Where a contact begins to act on x1, whatever its law: from t2 on it takes a speed at once (a rigid
/// contact, or one whose stroke is over within a sample) and accelerates against the passage by a torque that
/// is a quadratic in time, never pulling, as long as it is looked at:
///   −direction·(x1 − law) = v (t − t2) + ∬ [b0 (1−s)² + 2 b1 s(1−s) + b2 s²],  s = (t − t2)/(last − t2),
/// v, b0, b1, b2 ≥ 0. A damped spring begins with b0, a spring with b1, a progressive contact with b2.
struct Onset {
  double time = 0.0;                                  ///< t2 [samples]
  double sse = 0.0;                                   ///< sum of squared errors of all rows [rad²]
  Eigen::Vector4d numbers = Eigen::Vector4d::Zero();  ///< v and b, over the time they act: [rad]
  double last = 0.0;                                  ///< [samples]

  /// What the contact has taken of x1 by then, along the passage [rad].
  double operator()(double t) const;
  std::ptrdiff_t count() const { return (numbers.array() > 0.0).count(); }  ///< of the numbers in use
};

/// In χ²: what no noise tells apart.
inline constexpr double kAlike = 0.01;

/// Rows first … first + y.size() − 1 of a passage, prepared for many trial instants: the law's columns are
/// projected out once.
class OnsetScan {
 public:
  /// Whether a contact may take a speed at once: one that is met, none that is left.
  enum class Start { kImpact, kTorque };
  /// @param y        x1 less that of row `first` [rad]
  /// @param columns  of the law without contact (y.size() × at most 8); they may depend on each other
  OnsetScan(const Eigen::VectorXd& y, std::size_t first, int direction, const Eigen::MatrixXd& columns,
            Start start);

  Onset trial(double time) const;
  /// The best of [from, to], tried every `step` and finer around the best: the middle of those whose squared
  /// error is no more than `alike` [rad²] above the least, which rounding alone would choose among.
  Onset best(double from, double to, double step, double alike) const;
  /// The earliest and the latest instant of [from, to] whose squared error is at most `limit`.
  Interval within(double from, double to, double step, double limit) const;

 private:
  std::size_t first_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> basis_;  // orthonormal
  Eigen::VectorXd residual_;  // of the law alone, against the passage
  double smooth_ = 0.0;
  unsigned fixed_;  // bits of the numbers that are zero
};

}  // namespace gapscope::internal::sliding_mode
