#include "reference/cost.h"

#include <cmath>

namespace gapscope::internal::reference {
namespace {

/// The initial numbers of one recording that are free, behind what stands in x.
void append_states(const RecordingCost& cost, const RecordingStart& start, std::vector<double>& x) {
  for (const int s : cost.states()) x.push_back(start.q[static_cast<std::size_t>(s)]);
}

}  // namespace

double prior_residual(const Parameter& p, double q) {
  return p.prior ? (p.coordinate.physical(q) - p.prior->value) / p.prior->std : 0.0;
}

double prior_slope(const Parameter& p, double q) {
  return p.prior ? p.coordinate.slope(q) / p.prior->std : 0.0;
}

double prior_square(const FitProblem& problem, std::span<const double> q, double sum) {
  for (std::size_t i = 0; i < q.size(); ++i)
    sum += std::pow(prior_residual(problem.free_parameter(i), q[i]), 2);
  return sum;
}

Cost::Cost(const FitProblem& problem, const FitPoint& from, double observer_hz)
    : problem_(problem), from_(from), shared_(std::ssize(from.q)), size_(shared_) {
  recordings_.reserve(from.starts.size());
  for (std::size_t r = 0; r < from.starts.size(); ++r) {
    recordings_.emplace_back(problem, r, from.starts[r], observer_hz);
    first_state_.push_back(size_);
    size_ += states(r);
  }
}

double Cost::all_samples() const {
  double sum = 0.0;
  for (const RecordingCost& r : recordings_) sum += static_cast<double>(r.samples());
  return sum;
}

Cost::Vector Cost::pack(const FitPoint& at) const {
  std::vector<double> x = at.q;
  for (std::size_t r = 0; r < recordings_.size(); ++r) append_states(recordings_[r], at.starts[r], x);
  return Eigen::Map<const Vector>(x.data(), std::ssize(x));
}

FitPoint Cost::unpack(const Vector& x) const {
  FitPoint to = from_;
  to.q.assign(x.data(), x.data() + shared_);
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    Eigen::Index next = first_state_[r];
    for (const int s : recordings_[r].states()) to.starts[r].q[static_cast<std::size_t>(s)] = x[next++];
  }
  return to;
}

Cost::Vector Cost::own(std::size_t r, const Vector& x) const {
  Vector q(shared_ + states(r));
  q.head(shared_) = x.head(shared_);
  q.tail(states(r)) = x.segment(first_state_[r], states(r));
  return q;
}

Cost::Vector Cost::bounds(bool upper) const {
  Vector bounds = Vector::Constant(size_, upper ? kInfinity : -kInfinity);
  for (Eigen::Index i = 0; i < shared_; ++i)
    bounds[i] = parameter(i).coordinate.solver(upper ? parameter(i).high : parameter(i).low);
  return bounds;
}

Evaluation Cost::evaluate(std::size_t r, const Vector& x, double* residuals, double* derivatives) const {
  const Vector q = own(r, x);
  return recordings_[r].evaluate(q.data(), residuals, derivatives);
}

double Cost::beside(const Vector& x) const {
  const double states = x.tail(x.size() - shared_).squaredNorm() / (kStateWidth * kStateWidth);
  return prior_square(problem_, {x.data(), static_cast<std::size_t>(shared_)}, states);
}

double Cost::beside_residual(Eigen::Index i, double value) const {
  return i < shared_ ? prior_residual(parameter(i), value) : state_residual(value);
}

double Cost::beside_slope(Eigen::Index i, double value) const {
  return i < shared_ ? prior_slope(parameter(i), value) : kStateSlope;
}

double Cost::beside_curvature(Eigen::Index i, double value) const {
  return i < shared_ ? std::pow(prior_slope(parameter(i), value), 2) : 1.0 / (kStateWidth * kStateWidth);
}

Square recording_square(const FitProblem& problem, const std::vector<double>& shared, std::size_t recording,
                        const RecordingStart& start, double observer_hz) {
  const RecordingCost cost(problem, recording, start, observer_hz);
  std::vector<double> q = shared;
  append_states(cost, start, q);
  std::vector<double> residuals(cost.samples());
  const Evaluation done = cost.evaluate(q.data(), residuals.data(), nullptr);
  if (!done.valid) return {kInfinity, done.simulations};
  double sum = 0.0;
  for (const double v : residuals) sum += v * v;
  return {std::isfinite(sum) ? sum : kInfinity, done.simulations};
}

Square mean_square_with_priors(const FitProblem& problem, const FitPoint& at, double observer_hz) {
  Square mean{prior_square(problem, at.q), 0.0};
  double count = 0.0;
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    const Square square = recording_square(problem, at.q, r, at.starts[r], observer_hz);
    mean.value += square.value;
    mean.simulations += square.simulations;
    count += static_cast<double>(problem.recordings[r].size());
  }
  mean.value /= count;
  return mean;
}

}  // namespace gapscope::internal::reference
