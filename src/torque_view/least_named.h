#pragma once

#include <functional>

#include "torque_view/ladder.h"

namespace gapscope::internal::torque_view {

/// The least amount of a law that the rule of a rung would have named on these recordings, on top of the
/// budget's model.
///
/// With r the held-out residual without what it already says of the law, and g what the held-out rows show of
/// it once the model is fitted anew (see Signature), a drive that has θ of it leaves r + θ g before the step
/// and r after it; every rival takes of it what its own fit to the fitted rows foretells. All of this is
/// linear in θ, so the whole rule (share, bounds, blocks, lead over rivals, encoder) is tried at any θ for
/// nothing.
struct LeastNamed {
  const Law* law = nullptr;
  Shape shape;                 ///< that it is told for: of its grid the one in the middle, by least amount
  Eigen::VectorXd theta;       ///< coefficients at the least amount; empty: there is none
  double torque = kNaN;        ///< rms of it on the held-out rows [unit of u]
  bool said_by_model = false;  ///< the model takes it up at any amount
  const Law* hidden_by = nullptr;  ///< law that keeps it from being named, at the largest amount tried

  bool exists() const { return theta.size() > 0; }
};

/// Whether a free-form law follows another variable than a law: where it takes nearly as much, the law's
/// cause is open.
using FollowsAnother = std::function<bool(const Law& free_form, const Law& law)>;

/// For every law that a rung could add and that has values of its effect, up to a torque as large as the
/// input's. A line is told for the worse of two phases. A law that adds to one which the model lacks is left
/// out: it has nothing to add to.
std::vector<LeastNamed> least_named(const SplitRecordings& data, const Budget& budget,
                                    const FollowsAnother& follows_another,
                                    const TorqueViewOptions& options = {});

}  // namespace gapscope::internal::torque_view
