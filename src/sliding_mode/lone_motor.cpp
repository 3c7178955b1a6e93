#include "sliding_mode/lone_motor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr int kIterations = 40;
constexpr double kConverged = 1e-4;  ///< of the squared error
constexpr double kNudge = 1e-4;      ///< of a parameter, for its derivative
constexpr double kOtherDry = 0.1;    ///< of what the largest torque drives: a second begin

/// Place and speed of one stretch at its first sample.
struct LoneBegin {
  double position = 0.0, speed = 0.0;  ///< [rad], [rad/s]
};

struct LoneFit {
  LoneLaw law;
  std::vector<LoneBegin> begins;
  double squares = kInfinity;
};

/// x1 less the motion, at every sample of the stretch.
void follow(const MotorTrace& trace, const LoneStretch& s, const LoneLaw& law, const LoneBegin& begin,
            Eigen::VectorXd& left) {
  left.resize(static_cast<Eigen::Index>(s.last - s.first + 1));
  const double half = 0.5 * law.viscous * trace.dt, held = law.dry * trace.dt;
  double x = begin.position, v = begin.speed;
  for (std::size_t i = s.first;; ++i) {
    left(static_cast<Eigen::Index>(i - s.first)) = trace.x1[i] - x;
    if (i == s.last) return;
    const double pushed = (1.0 - half) * v + law.drive * trace.dt * trace.u[i];
    const double next = std::copysign(std::max(std::abs(pushed) - held, 0.0), pushed) / (1.0 + half);
    x += 0.5 * trace.dt * (v + next);
    v = next;
  }
}

/// Of the law and the begins, in one column: drive, viscous, dry, then place and speed of each stretch.
constexpr Eigen::Index kOfLaw = 3;

struct LoneScales {
  double drive, viscous, dry, position, speed;  ///< what one unit of a step is

  double of(Eigen::Index k) const {
    if (k < kOfLaw) return k == 0 ? drive : k == 1 ? viscous : dry;
    return (k - kOfLaw) % 2 == 0 ? position : speed;
  }
};

double& parameter(LoneFit& fit, Eigen::Index k) {
  if (k < kOfLaw) return k == 0 ? fit.law.drive : k == 1 ? fit.law.viscous : fit.law.dry;
  LoneBegin& begin = fit.begins[static_cast<std::size_t>((k - kOfLaw) / 2)];
  return (k - kOfLaw) % 2 == 0 ? begin.position : begin.speed;
}

class LoneSearch {
 public:
  LoneSearch(const MotorTrace& trace, std::span<const LoneStretch> stretches, const LoneScales& scales)
      : trace_(trace), stretches_(stretches), scales_(scales) {}

  /// From `fit` downhill.
  LoneFit improve(LoneFit fit) {
    fit.squares = squares(fit);
    double damping = 1e-3;
    for (int i = 0; i < kIterations && damping < 1e8; ++i) {
      linearise(fit);
      LoneFit best = fit;
      for (; damping < 1e8; damping *= 8.0) {
        const LoneFit next = stepped(fit, damping);
        if (!(next.squares < fit.squares)) continue;
        best = next;
        damping *= 0.1;
        break;
      }
      const bool converged = best.squares > (1.0 - kConverged) * fit.squares;
      fit = best;
      if (converged) break;
    }
    return fit;
  }

 private:
  double squares(const LoneFit& fit) {
    double sum = 0.0;
    for (std::size_t p = 0; p < stretches_.size(); ++p) {
      follow(trace_, stretches_[p], fit.law, fit.begins[p], left_);
      sum += left_.squaredNorm();
    }
    return sum;
  }

  /// Normal equations at `fit`: each stretch knows the law, and its own begin.
  void linearise(const LoneFit& fit) {
    const Eigen::Index all = kOfLaw + 2 * std::ssize(stretches_);
    normal_ = Eigen::MatrixXd::Zero(all, all);
    gradient_ = Eigen::VectorXd::Zero(all);
    for (std::size_t p = 0; p < stretches_.size(); ++p) {
      const Eigen::Index own = kOfLaw + 2 * static_cast<Eigen::Index>(p);
      const Eigen::Index of[] = {0, 1, 2, own, own + 1};
      follow(trace_, stretches_[p], fit.law, fit.begins[p], left_);
      Eigen::MatrixXd J(left_.size(), std::ssize(of));
      for (Eigen::Index c = 0; c < J.cols(); ++c) {
        LoneFit near = fit;
        parameter(near, of[c]) += kNudge * scales_.of(of[c]);
        follow(trace_, stretches_[p], near.law, near.begins[p], nudged_);
        J.col(c) = (left_ - nudged_) / kNudge;
      }
      const Eigen::MatrixXd square = J.transpose() * J;
      const Eigen::VectorXd down = J.transpose() * left_;
      for (Eigen::Index a = 0; a < J.cols(); ++a) {
        gradient_(of[a]) += down(a);
        for (Eigen::Index b = 0; b < J.cols(); ++b) normal_(of[a], of[b]) += square(a, b);
      }
    }
  }

  /// Friction never drives: one that is zero and would become less stays.
  LoneFit stepped(const LoneFit& fit, double damping) {
    Eigen::MatrixXd A = normal_;
    Eigen::VectorXd b = gradient_;
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
      const bool stays = (k == 1 || k == 2) && b(k) < 0.0 && (k == 1 ? fit.law.viscous : fit.law.dry) <= 0.0;
      if (stays) A.row(k).setZero(), A.col(k).setZero(), b(k) = 0.0;
      A(k, k) = stays ? 1.0 : A(k, k) * (1.0 + damping) + 1e-300;
    }
    const Eigen::VectorXd step = A.ldlt().solve(b);
    LoneFit next = fit;
    for (Eigen::Index k = 0; k < step.size(); ++k) parameter(next, k) += scales_.of(k) * step(k);
    next.law.viscous = std::max(next.law.viscous, 0.0), next.law.dry = std::max(next.law.dry, 0.0);
    next.squares = step.allFinite() ? squares(next) : kInfinity;
    return next;
  }

  const MotorTrace& trace_;
  std::span<const LoneStretch> stretches_;
  LoneScales scales_;
  Eigen::VectorXd left_, nudged_, gradient_;
  Eigen::MatrixXd normal_;
};

/// A first guess, by the mean speed of its first samples.
LoneBegin begin_of(const MotorTrace& trace, const LoneStretch& s, std::size_t samples) {
  const std::size_t to = std::min(s.first + std::max<std::size_t>(samples, 1), s.last);
  const double time = static_cast<double>(to - s.first) * trace.dt;
  return {trace.x1[s.first], (trace.x1[to] - trace.x1[s.first]) / time};
}

}  // namespace

double lone_motor_squares(const MotorTrace& trace, std::span<const LoneStretch> stretches,
                          const LoneLaw& start) {
  double most = 0.0, time = 0.0, way = 0.0;
  LoneFit begin{start, {}, kInfinity};
  for (const LoneStretch& s : stretches) {
    for (std::size_t i = s.first; i <= s.last; ++i) most = std::max(most, std::abs(trace.u[i]));
    time = std::max(time, static_cast<double>(s.last - s.first) * trace.dt);
    way = std::max(way, std::abs(trace.x1[s.last] - trace.x1[s.first]));
    begin.begins.push_back(begin_of(trace, s, (s.last - s.first) / 12));
  }
  const double pushed = start.drive * most;  // [rad/s²]
  if (!(pushed > 0.0) || !(time > 0.0)) return kInfinity;
  LoneSearch search(trace, stretches,
                    {start.drive, std::max(start.viscous, 1.0 / time), pushed, way, way / time});
  double least = kInfinity;
  for (const double dry : {start.dry, kOtherDry * pushed}) {
    begin.law.dry = dry;
    least = std::min(least, search.improve(begin).squares);
  }
  return least;
}

}  // namespace gapscope::internal::sliding_mode
