#pragma once

#include <Eigen/Dense>
#include <vector>

#include "reference/recording_cost.h"

namespace gapscope::internal::reference {

/// Initial numbers are held within about ten of their scales, unless the data says otherwise.
constexpr double kStateWidth = 10.0;

/// What is known beforehand of one free number, as a residual and its derivative by q.
double prior_residual(const Parameter& parameter, double q);  ///< (p − prior)/std; 0 without a prior
double prior_slope(const Parameter& parameter, double q);
inline double state_residual(double q) { return q / kStateWidth; }
constexpr double kStateSlope = 1.0 / kStateWidth;

/// Priors of all free parameters, squared and added to a sum one by one [floor²].
double prior_square(const FitProblem& problem, std::span<const double> q, double sum = 0.0);

/// What every search minimises, at a given gain of the observer (0: the free run), in floor²:
///   Σ |residuals of a recording|² + Σ prior residual² + Σ state residual²
/// over one vector x: the free parameters, then the free initial numbers of one recording after the other.
/// Which these are depends on where a recording's load starts (RecordingStart::variant): that of the point
/// which it is made from, and that does not change.
class Cost {
 public:
  using Vector = Eigen::VectorXd;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Cost(const FitProblem& problem, const FitPoint& from, double observer_hz);

  const FitProblem& problem() const { return problem_; }
  Eigen::Index size() const { return size_; }
  Eigen::Index shared() const { return shared_; }
  std::size_t recordings() const { return recordings_.size(); }
  const RecordingCost& recording(std::size_t r) const { return recordings_[r]; }
  Eigen::Index first_state(std::size_t r) const { return first_state_[r]; }  ///< place in x
  Eigen::Index states(std::size_t r) const { return std::ssize(recordings_[r].states()); }
  Eigen::Index samples(std::size_t r) const { return static_cast<Eigen::Index>(recordings_[r].samples()); }
  double all_samples() const;

  Vector pack(const FitPoint& at) const;
  /// The point with the numbers of x.
  FitPoint unpack(const Vector& x) const;
  /// The numbers of recording r: the shared ones, then its own.
  Vector own(std::size_t r, const Vector& x) const;
  Vector low() const { return bounds(false); }
  Vector high() const { return bounds(true); }

  /// @param derivatives by own(), row-major, or null
  Evaluation evaluate(std::size_t r, const Vector& x, double* residuals, double* derivatives) const;

  /// Priors and state widths, squared.
  double beside(const Vector& x) const;
  double beside_residual(Eigen::Index i, double value) const;
  double beside_slope(Eigen::Index i, double value) const;
  /// What they add to the normal matrix; of a state it is not the square of the slope to the last bit.
  double beside_curvature(Eigen::Index i, double value) const;

 private:
  const Parameter& parameter(Eigen::Index i) const {
    return problem_.free_parameter(static_cast<std::size_t>(i));
  }
  Vector bounds(bool upper) const;

  const FitProblem& problem_;
  FitPoint from_;
  Eigen::Index shared_ = 0, size_ = 0;
  std::vector<RecordingCost> recordings_;
  std::vector<Eigen::Index> first_state_;
};

/// A sum of squares, and what it took.
struct Square {
  double value = kInfinity;  ///< [floor²]; infinite where the motion diverges
  double simulations = 0.0;
};

/// Sum of squared residuals of one recording, by a plain run.
Square recording_square(const FitProblem& problem, const std::vector<double>& q, std::size_t recording,
                        const RecordingStart& start, double observer_hz);

/// Mean over the samples of the squared residuals and priors, by plain runs.
Square mean_square_with_priors(const FitProblem& problem, const FitPoint& at, double observer_hz);

}  // namespace gapscope::internal::reference
