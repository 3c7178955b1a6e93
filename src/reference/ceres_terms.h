#pragma once

#include <ceres/cost_function.h>

#include "reference/cost.h"

namespace gapscope::internal::reference {

// The terms of Cost as Ceres takes them.

/// Blocks: the free parameters (left out if there are none), then the free initial numbers of the recording
/// (left out likewise).
class RecordingTerm final : public ceres::CostFunction {
 public:
  /// @param simulations what is spent is added here
  RecordingTerm(const RecordingCost& cost, double& simulations);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  const RecordingCost& cost_;
  double& simulations_;
};

/// The prior of one free parameter; block: all of them.
class PriorTerm final : public ceres::CostFunction {
 public:
  PriorTerm(const Parameter& parameter, std::size_t place, std::size_t count);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  const Parameter& parameter_;
  std::size_t place_;
};

/// The widths of one recording's free initial numbers.
class StateWidthTerm final : public ceres::CostFunction {
 public:
  explicit StateWidthTerm(std::size_t count);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;
};

}  // namespace gapscope::internal::reference
