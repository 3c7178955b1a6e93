#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "reference/fit_problem.h"

namespace gapscope::internal::reference {
namespace {

using Vector = Eigen::VectorXd;

constexpr double kDifference = 1e-4;           ///< of a number in solver units, or of one where that is more
constexpr double kLeastSquaresDamping = 1e-3;  ///< Marquardt's λ
/// Of a step, eight times as damped each; with older derivatives.
constexpr int kMostTrials = 10, kStaleTrials = 2;
constexpr double kLeastGain = 5e-3;  ///< in the mean log of the sizes; less comes and goes with single stops
constexpr int kRunsBySecants = 4;    ///< of Broyden between two derivatives by differences
constexpr double kForetold = 0.5;    ///< share of the foretold gain that leaves the derivatives alone

/// Damped Gauss–Newton of Σ log |e|²/2 over kinds of errors: each step is that of least squares of errors in
/// their present sizes, whose slope is the same. Derivatives by differences cost a run for each number: in
/// between they follow the errors by Broyden's rank-one formula.
class Lessening {
 public:
  Lessening(const FitProblem& problem, const ModelFit& fit, const FitPoint& from, const ErrorKinds& kinds,
            std::span<const ParameterId> held, int threads)
      : fit_(fit), kinds_(kinds), at_(from), threads_(threads) {
    for (std::size_t i = 0; i < problem.free_count(); ++i) {
      const Parameter& p = problem.free_parameter(i);
      if (std::find(held.begin(), held.end(), p.id) != held.end()) continue;
      places_.push_back(i);
      low_.push_back(p.coordinate.solver(p.low)), high_.push_back(p.coordinate.solver(p.high));
    }
  }

  std::optional<FitPoint> run(int iterations) {
    errors_ = errors_at(at_);
    value_ = value_of(errors_);
    const double first = value_;
    if (!std::isfinite(value_) || places_.empty()) return {};
    for (int i = 0; i < iterations; ++i) {
      stop_point();
      const bool is_fresh = secants_ == 0 || !trusted_ || secants_ > kRunsBySecants;
      if (is_fresh && !differentiate()) break;
      const double before = value_;
      const bool gone = descend(is_fresh ? kMostTrials : kStaleTrials) && before - value_ >= kLeastGain;
      if (!gone && is_fresh) break;
      trusted_ = trusted_ && gone;
    }
    if (!(value_ < first)) return {};
    return at_;
  }

 private:
  using Errors = std::vector<std::vector<double>>;

  Errors errors_at(const FitPoint& point) const { return kinds_(fit_.run_at(point)); }

  static double mean_square(const std::vector<double>& e) {
    return Eigen::Map<const Vector>(e.data(), std::ssize(e)).squaredNorm() / static_cast<double>(e.size());
  }

  /// Mean of the logs of their sizes; infinite where the motion diverges.
  static double value_of(const Errors& errors) {
    double sum = 0.0;
    for (const std::vector<double>& e : errors) sum += 0.5 * std::log(mean_square(e));
    return errors.empty() || !std::isfinite(sum) ? kInfinity : sum / static_cast<double>(errors.size());
  }

  double step_at(std::size_t k) const {
    const double q = at_.q[places_[k]], step = kDifference * std::max(1.0, std::abs(q));
    return q + step > high_[k] ? -step : step;
  }

  bool differentiate() {
    std::vector<Errors> beside(places_.size());
    parallel_for(beside.size(), threads_, [&](std::size_t k) {
      FitPoint point = at_;
      point.q[places_[k]] += step_at(k);
      beside[k] = errors_at(point);
    });
    for (const Errors& errors : beside)
      if (errors.size() != errors_.size()) return false;
    const auto n = std::ssize(places_);
    columns_.clear();
    for (std::size_t b = 0; b < errors_.size(); ++b) {
      const auto size = std::ssize(errors_[b]);
      const Eigen::Map<const Vector> here(errors_[b].data(), size);
      Eigen::MatrixXd& columns = columns_.emplace_back(size, n);
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto place = static_cast<std::size_t>(k);
        columns.col(k) = (Eigen::Map<const Vector>(beside[place][b].data(), size) - here) / step_at(place);
      }
    }
    secants_ = 1, trusted_ = true;
    set_normal();
    return slope_.allFinite();
  }

  void set_normal() {
    const auto n = std::ssize(places_);
    normal_ = Eigen::MatrixXd::Zero(n, n), slope_ = Vector::Zero(n);
    for (std::size_t b = 0; b < errors_.size(); ++b) {
      const Eigen::Map<const Vector> here(errors_[b].data(), std::ssize(errors_[b]));
      const double weight = 1.0 / here.squaredNorm();
      normal_.noalias() += weight * (columns_[b].transpose() * columns_[b]);
      slope_.noalias() += weight * (columns_[b].transpose() * here);
    }
  }

  /// The least change of the derivatives that explains the last differences of the errors.
  void follow(const FitPoint& to, const Errors& errors) {
    Vector step(std::ssize(places_));
    for (std::size_t k = 0; k < places_.size(); ++k)
      step[static_cast<Eigen::Index>(k)] = to.q[places_[k]] - at_.q[places_[k]];
    ++secants_;
    const double square = step.squaredNorm();
    for (std::size_t b = 0; b < errors.size() && square > 0.0; ++b) {
      const auto size = std::ssize(errors[b]);
      const Eigen::Map<const Vector> now(errors[b].data(), size), before(errors_[b].data(), size);
      const Vector missed = now - before - columns_[b] * step;
      columns_[b].noalias() += missed * (step.transpose() / square);
    }
    const double foretold = -step.dot(slope_) - 0.5 * step.dot(normal_ * step);
    trusted_ = (value_ - value_of(errors)) * static_cast<double>(errors.size()) > kForetold * foretold;
  }

  /// The damped step within the bounds: numbers that a bound holds back stay.
  FitPoint stepped() const {
    std::vector<Eigen::Index> moving;
    for (Eigen::Index k = 0; k < slope_.size(); ++k) {
      const auto place = static_cast<std::size_t>(k);
      const double q = at_.q[places_[place]];
      const bool is_held = (q <= low_[place] && slope_[k] > 0.0) || (q >= high_[place] && slope_[k] < 0.0);
      if (!is_held && normal_(k, k) > 0.0) moving.push_back(k);
    }
    Eigen::MatrixXd a = normal_(moving, moving);
    a.diagonal() *= 1.0 + damping_;
    const Vector step = a.ldlt().solve(-slope_(moving));
    FitPoint to = at_;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const auto k = static_cast<std::size_t>(moving[i]);
      double& q = to.q[places_[k]];
      q = std::clamp(q + step[static_cast<Eigen::Index>(i)], low_[k], high_[k]);
    }
    return to;
  }

  /// @returns whether a step was found that goes down
  bool descend(int trials) {
    for (int trial = 0; trial < trials; ++trial, damping_ *= 8.0) {
      FitPoint to = stepped();
      Errors errors = errors_at(to);
      if (const double value = value_of(errors); value < value_) {
        follow(to, errors);
        at_ = std::move(to), errors_ = std::move(errors), value_ = value;
        damping_ = std::max(1e-6, 0.1 * damping_);
        set_normal();
        return true;
      }
    }
    damping_ = kLeastSquaresDamping;
    return false;
  }

  const ModelFit& fit_;
  const ErrorKinds& kinds_;
  FitPoint at_;
  int threads_;
  std::vector<std::size_t> places_;  ///< of the numbers that move
  std::vector<double> low_, high_;
  Errors errors_;
  double value_ = kInfinity, damping_ = kLeastSquaresDamping;
  std::vector<Eigen::MatrixXd> columns_;  ///< derivatives of the errors, by kind
  int secants_ = 0;                       ///< steps since these were taken, and one
  bool trusted_ = true;                   ///< they have foretold the last step
  Eigen::MatrixXd normal_;
  Vector slope_;
};

}  // namespace

std::optional<FitPoint> ModelFit::lessen(const FitPoint& from, const ErrorKinds& kinds,
                                         std::span<const ParameterId> held, int iterations,
                                         int threads) const {
  return Lessening(*problem_, *this, from, kinds, held, threads).run(iterations);
}

}  // namespace gapscope::internal::reference
