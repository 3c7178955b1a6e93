#include "reference/ceres_terms.h"

#include <algorithm>

namespace gapscope::internal::reference {

RecordingTerm::RecordingTerm(const RecordingCost& cost, double& simulations)
    : cost_(cost), simulations_(simulations) {
  set_num_residuals(static_cast<int>(cost.samples()));
  const int states = static_cast<int>(cost.states().size()), shared = cost.numbers() - states;
  for (const int size : {shared, states})
    if (size > 0) mutable_parameter_block_sizes()->push_back(size);
}

bool RecordingTerm::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const auto& sizes = parameter_block_sizes();
  std::vector<double> q;
  std::vector<DerivativeColumn> columns;
  for (std::size_t b = 0; b < sizes.size(); ++b) {
    q.insert(q.end(), blocks[b], blocks[b] + sizes[b]);
    for (int i = 0; i < sizes[b] && jacobians != nullptr; ++i)
      columns.push_back(
          {jacobians[b] == nullptr ? nullptr : jacobians[b] + i, static_cast<std::size_t>(sizes[b])});
  }
  const Evaluation done = cost_.evaluate(q.data(), residuals, columns);
  simulations_ += done.simulations;
  return done.valid;
}

PriorTerm::PriorTerm(const Parameter& parameter, std::size_t place, std::size_t count)
    : parameter_(parameter), place_(place) {
  set_num_residuals(1);
  mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
}

bool PriorTerm::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const double q = blocks[0][place_];
  residuals[0] = prior_residual(parameter_, q);
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
  jacobians[0][place_] = prior_slope(parameter_, q);
  return true;
}

StateWidthTerm::StateWidthTerm(std::size_t count) {
  set_num_residuals(static_cast<int>(count));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
}

bool StateWidthTerm::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const int n = num_residuals();
  for (int i = 0; i < n; ++i) residuals[i] = state_residual(blocks[0][i]);
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  std::fill_n(jacobians[0], n * n, 0.0);
  for (int i = 0; i < n; ++i) jacobians[0][i * n + i] = kStateSlope;
  return true;
}

}  // namespace gapscope::internal::reference
