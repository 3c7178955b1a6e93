#pragma once

#include <Eigen/Dense>

#include "gapscope/reference/fit_summary.h"
#include "reference/cost.h"

namespace gapscope::internal::reference {

/// Autocorrelation of the residual at one sample [-]: as it is, and as much as the quantiser explains on this
/// motion.
struct Correlation {
  double lag1 = kNaN;
  double quantiser = 0.0;
  double simulations = 0.0;  ///< spent on it
  double excess() const { return lag1 - quantiser; }
};

/// What the recordings say about the free numbers at a point, in solver units. Columns: the free
/// parameters, then the free initial numbers of each recording. Residuals are in floors.
struct Information {
  bool valid = false;       ///< false: the motion diverged there
  Eigen::MatrixXd normal;   ///< JᵀJ with the priors (n × n)
  Eigen::VectorXd score;    ///< Jᵀr with the priors: half of the slope of the cost (n)
  Eigen::MatrixXd windows;  ///< Σ over windows of score·scoreᵀ, score = Jᵀr of the window (n × n)
  /// score·scoreᵀ of the quantiser's error, averaged over where the counts lie (n × n).
  Eigen::MatrixXd quantiser;
  double variance = 1.0;   ///< of a residual [floor²], never below the quantiser's
  double inflation = 1.0;  ///< samples per independent sample, from the autocorrelation
  Correlation correlation;
  InputTiming timing;
  Eigen::VectorXd by_timing;  ///< how the numbers follow it at the least cost [1/row]; empty: it is not known
  int window_count = 0;
  std::vector<FitPiece> pieces;  ///< by the free numbers in solver units
  double simulations = 0.0;      ///< spent on it
};

/// By plain runs; NaN where the motion diverges.
Correlation correlation_at(const FitProblem& problem, const FitPoint& at, double observer_hz);

/// Variance of a number: the largest of that of autocorrelated residuals, that from the scatter of the
/// windows' scores, and that of the quantiser.
/// @param row       of the inverse of the normal matrix that belongs to it
/// @param diagonal  its own place in it
double variance_along(const Information& information, const Eigen::VectorXd& row, double diagonal);

Information information_at(const FitProblem& problem, const FitPoint& at, double observer_hz);

}  // namespace gapscope::internal::reference
