#pragma once

#include <span>

#include "reference/fit_problem.h"
#include "reference/observer.h"

namespace gapscope::internal::reference {

/// What became of an evaluation.
struct Evaluation {
  bool valid = false;        ///< false: the motion diverged, or was refused
  double simulations = 0.0;  ///< spent on it, a run with Jets, or with smooth effects, counted as its
                             ///< measured cost in plain ones
};

/// Where the derivatives by one number go: that of each sample `stride` places after the one before.
struct DerivativeColumn {
  double* first = nullptr;  ///< null: nowhere
  std::size_t stride = 0;
};

/// Residuals of one recording, in units of its floor: innovations (measured − predicted) of the model run as
/// an observer; the free run at zero gain. Its numbers: the free parameters, then the free initial numbers of
/// this recording. One Jet run yields values and derivatives of up to 12 numbers; more take several runs. A
/// rollout that diverges is refused, never a residual.
class RecordingCost {
 public:
  RecordingCost(const FitProblem& problem, std::size_t recording, const RecordingStart& start,
                double observer_hz);

  /// @param q all numbers
  /// @param jacobian row-major (samples × numbers), or null
  Evaluation evaluate(const double* q, double* residuals, double* jacobian) const;

  /// @param columns one for each number; none: only the residuals are asked for
  Evaluation evaluate(const double* q, double* residuals, std::span<const DerivativeColumn> columns) const;

  std::size_t samples() const { return recording_.size(); }
  int numbers() const { return static_cast<int>(shared_ + states_.size()); }
  const std::vector<int>& states() const { return states_; }  ///< the initial numbers that are free

 private:
  template <class T, class Keep>
  Evaluation run(const T* q, const Keep& keep) const;
  template <int N>
  Evaluation run_chunk(const double* q, int first, double* residuals,
                       std::span<const DerivativeColumn> columns) const;
  void apply_loss(double* residuals, std::span<const DerivativeColumn> columns) const;

  const FitProblem& problem_;
  const MotorTrace& recording_;
  std::size_t place_;  ///< among the recordings of the problem
  RecordingStart start_;
  std::vector<int> states_;
  std::size_t shared_;
  ObserverGains gains_;
  double floor_;
};

}  // namespace gapscope::internal::reference
