#pragma once

#include <ceres/cost_function.h>

#include "reference/fit_problem.h"
#include "reference/rollout.h"

namespace gapscope::internal::reference {

/// Residuals of one recording, in units of its floor: innovations (measured − predicted) of the model run as
/// an observer; the free run at zero gain. Blocks: the free parameters (left out if there are none), then the
/// free initial numbers of this recording (left out likewise). One Jet run yields values and derivatives of
/// up to 12 numbers; more take several runs. A rollout that diverges is refused, never a residual.
class RecordingCost final : public ceres::CostFunction {
 public:
  RecordingCost(const FitProblem& problem, std::size_t recording, const RecordingStart& start,
                double observer_hz);

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

  /// The same without Ceres' blocks: all free numbers in one vector, Jacobian row-major (samples × numbers),
  /// may be null. Without the robust loss if `plain`.
  bool evaluate(const double* q, double* residuals, double* jacobian, bool plain = false) const;

  int numbers() const { return static_cast<int>(shared_ + states_.size()); }
  const std::vector<int>& states() const { return states_; }

 private:
  template <class T>
  bool run(const T* q, T* out) const;
  template <int N>
  bool run_chunk(const double* q, int first, int count, double* residuals, double* jacobian) const;
  void apply_loss(double* residuals, double* jacobian) const;

  const FitProblem& problem_;
  const MotorTrace& recording_;
  RecordingStart start_;
  std::vector<int> states_;
  std::size_t shared_;
  ObserverGain gain_;
  double floor_;
};

}  // namespace gapscope::internal::reference
