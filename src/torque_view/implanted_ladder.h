#pragma once

#include "torque_view/least_named.h"

namespace gapscope::internal::torque_view {

/// Whether the ladder, from the nominal model on, adds a law to what the recordings would be if the drive had
/// it at this shape and amount, beside all that it has.
bool ladder_adds(SplitRecordings data, const Budget& budget, const Law& law, const Shape& shape,
                 const Eigen::VectorXd& theta, TorqueViewOptions options = {});

/// The foretold amounts, each corrected by such implants of half of it, it and twice of it, of less while the
/// least is added and of more while the most is not, as far as the input's own torque: told is the amount
/// from which on the law is added, with the fewest exceptions. One that is not added even there has none,
/// since other laws take its place on the way.
void correct_by_implants(const SplitRecordings& data, const Budget& budget, std::vector<LeastNamed>& laws,
                         const TorqueViewOptions& options = {});

}  // namespace gapscope::internal::torque_view
