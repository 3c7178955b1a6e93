#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "gapscope/reference/fit_summary.h"
#include "results/drive_changes.h"

namespace gapscope::internal::changes {

/// One group of recordings: its values v of the numbers that are compared, and what its pieces say near them.
struct Group {
  const FitSummary* fit = nullptr;
  std::vector<std::string> keys;  ///< compared, then those that are this group's own affair
  std::vector<FitPiece> pieces;   ///< by these numbers, in this order
  double misfit = 1.0;            ///< what the model leaves, in floors, 1 at least
};

/// Two groups of recordings fitted together, some numbers one for both, others one for each. Near its own
/// values a group's cost is a square (FitPiece), and a joint fit that explains both groups is near the values
/// of either: there the joint cost is exact to second order. Where it is not, no joint fit explains both.
class TwoGroups {
 public:
  /// Which of the compared numbers may differ between the groups, one for each.
  using Differ = std::vector<bool>;

  /// @param compared  numbers that both fits have determined
  TwoGroups(const FitSummary& first, const FitSummary& now, const std::vector<std::string>& compared);

  /// How probable it is that the groups' values lie so far apart or farther, were these numbers alone to
  /// differ: by χ², each number as uncertain as its interval says, correlated as the pieces say. NaN: without
  /// pieces.
  double p_if_only(const Differ& differ) const;

  /// What a piece is off by, rms [floor], in a joint fit of all pieces but one of either group, that one left
  /// out in turn. NaN: with fewer than two pieces in a group.
  double held_out(const Differ& differ) const;

 private:
  Group first_, now_;
  Eigen::Index compared_ = 0;
  Eigen::VectorXd difference_;  ///< now less first (compared)
  Eigen::MatrixXd covariance_;  ///< of the difference; empty: without pieces
};

/// Where the model leaves more than the encoder, its errors are that much larger; 1 at least.
double misfit(const FitSummary& fit);

}  // namespace gapscope::internal::changes
