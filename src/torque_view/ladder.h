#pragma once

#include <span>
#include <string>
#include <vector>

#include "torque_view/band.h"
#include "torque_view/floors.h"

namespace gapscope::internal::torque_view {

/// What of the budget one law of the last model carries.
struct Share {
  const Law* law = nullptr;
  Shape shape;
  Eigen::VectorXd theta;
  Evidence alone, last;  ///< on top of the nominal model; taken out of the full one
  Visibility seen;
};

/// The error budget from the nominal model to what no law explains.
struct Budget {
  FrequencyBand band;
  Model nominal, model;
  double input_rms = 0.0, nominal_rms = 0.0, rms = 0.0;  ///< of the held-out rows [unit of u]
  Model addable;             ///< the model without the terms that the caller's model cannot have
  double addable_rms = 0.0;  ///< what it leaves of the held-out rows [unit of u]
  double torque_rms = 0.0;   ///< of the model, at the samples that were fitted [unit of u]
  Scales scales;             ///< of what was fitted
  std::vector<Rung> rungs;
  bool says_most = false;            ///< of the held-out input: the terms that the caller's model can have
  std::vector<std::string> dropped;  ///< by the backward step: the others say it as well
  std::vector<Share> shares;
  Floors floors;
};

/// The recordings in that band, ready for comparisons.
Bench bench_of(const SplitRecordings& data, const FrequencyBand& band, const TorqueViewOptions& options);
/// The free position curve and the harmonics have the period of the model's line.
void take_line(Bench& bench, const Model& model);

Budget error_budget(const SplitRecordings& data, const TorqueViewOptions& options = {});

}  // namespace gapscope::internal::torque_view
