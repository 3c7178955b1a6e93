#pragma once

#include <Eigen/Dense>
#include <vector>

#include "gapscope/base/statistics.h"
#include "torque_view/model.h"

namespace gapscope::internal::torque_view {

/// What a step takes of the squared residual of held-out rows, decided by blocks of time.
struct Evidence {
  double share = kNaN;   ///< 1 − (mean square after)/(before)
  Interval interval;     ///< 95 %, of blocks drawn with replacement, before and after drawn together
  double better = kNaN;  ///< share of the blocks that improve
};

/// Blocks of held-out rows, and the draws that all comparisons share: they are paired.
class Blocks {
 public:
  Blocks() = default;
  Blocks(const Rows& rows, const TorqueViewOptions& options);
  /// Blocks whose squared residuals are known.
  Blocks(std::size_t count, const TorqueViewOptions& options);

  std::size_t count() const { return count_; }
  /// Squared residual of each block.
  Eigen::VectorXd squares(const Eigen::VectorXd& residual) const;
  Evidence compare(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;
  /// Share of the draws in which the squares of one are less than those of another.
  double leading(const Eigen::VectorXd& squares, const Eigen::VectorXd& other) const;

 private:
  void draw(const TorqueViewOptions& options);

  std::size_t count_ = 0;
  std::vector<std::size_t> of_row_;
  std::vector<std::vector<std::size_t>> draws_;
};

/// What these rows could show of a term, without a simulation: with g its columns, P the projection on the
/// model's, R the model's squared residual and E = ‖(I − P) g θ‖²
struct Visibility {
  double predicted = kNaN;  ///< E/(E + R): the share that it should take
  double absorbed = kNaN;   ///< 1 − ‖(I − P) g θ‖²/‖g θ‖²: what the model says in its place
  double smallest = kNaN;   ///< √(least share/(1 − least share) R/E) of its size: what would be named
};

}  // namespace gapscope::internal::torque_view
