#include "sliding_mode/free_body.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>

namespace gapscope::internal::sliding_mode {
namespace {

using Eigen::Index, Eigen::VectorXd;

// Half and double of each on the drives of study_sliding_mode 8830001 24 gap sine wide, 8840001 16 gap sine
// wide slides and 8820001 20 gap_free trapezoid wide; one of them has several minima, and changes with any.
constexpr Index kMeans = 80;       ///< of a stretch: half leave 0.7 to 1.1 times as much, double 1 to 1.5
constexpr double kSettled = 1e-3;  ///< of the squared error, gained by the last step: within 1 %
constexpr double kNudge = 1e-4;    ///< of a number, for its derivative: within 7 %
constexpr int kMostTrials = 60;    ///< a limit of work: half leaves one drive 1.24 times as much, double 0.97
constexpr Index kFrictions[] = {1, 2, 4};  ///< of the numbers sought

/// x less the motion and less their mean difference [rad].
VectorXd left_of(const FreeMotion& m, const FreeStretch& s, const FreeBody& body, double v) {
  VectorXd left(s.last - s.first + 1);
  double x = m.x[s.first];
  for (std::size_t i = s.first; i <= s.last; ++i) {
    left(static_cast<Index>(i - s.first)) = m.x[i] - x;
    advance(body, m.u[i], m.dt, x, v);
  }
  return left.array() - left.mean();
}

/// The means that are left, by numbers of one size: those of the body over their scales (sticking with dry,
/// and the logarithm of the fading speed), then the speed at the begin of each stretch.
class LeftOver : public Eigen::DenseFunctor<double> {
 public:
  LeftOver(const FreeMotion& m, const FreeBody& start, FreeNumbers numbers)
      : DenseFunctor(static_cast<int>(numbers) + static_cast<int>(m.stretches.size()),
                     static_cast<int>(kMeans * std::ssize(m.stretches))),
        motion_(m),
        own_(static_cast<Index>(numbers)),
        first_(inputs()) {
    VectorXd speeds(std::ssize(m.stretches)), body(6);
    double strongest = 0.0, way = 0.0, time = 0.0;
    for (Index k = 0; const FreeStretch& s : m.stretches) {
      time = m.dt * static_cast<double>(s.last - s.first);
      const std::size_t some = std::max<std::size_t>(1, (s.last - s.first) / 12);
      speeds(k++) = (m.x[s.first + some] - m.x[s.first]) / (m.dt * static_cast<double>(some));
      for (std::size_t i = s.first; i <= s.last; ++i) {
        strongest = std::max(strongest, std::abs(m.u[i]));
        way = std::max(way, std::abs(m.x[i] - m.x[s.first]));
      }
    }
    drive_ = start.drive, viscous_ = std::max(start.viscous, 1.0 / time);
    pushed_ = drive_ * strongest, speed_ = way / time;
    body << 1.0, start.viscous / viscous_, start.dry / pushed_, start.constant / pushed_,
        (start.dry + start.sticking) / pushed_, std::log(start.fading / speed_);
    first_ << body.head(own_), speeds / speed_;
  }

  bool driven() const { return pushed_ > 0.0 && speed_ > 0.0; }
  const VectorXd& first() const { return first_; }

  FreeBody body(const VectorXd& n) const {
    FreeBody b{drive_ * n(0), viscous_ * std::max(n(1), 0.0), pushed_ * std::max(n(2), 0.0)};
    if (own_ > 3) b.constant = pushed_ * n(3);
    if (own_ > 4) b.sticking = pushed_ * std::max(n(4), 0.0) - b.dry, b.fading = speed_ * std::exp(n(5));
    return b;
  }
  VectorXd speeds(const VectorXd& n) const { return speed_ * n.tail(n.size() - own_); }

  int operator()(const VectorXd& n, VectorXd& left) const {
    const FreeBody b = body(n);
    for (Index row = 0; const FreeStretch& s : motion_.stretches) {
      const VectorXd of = left_of(motion_, s, b, speed_ * n(own_ + row / kMeans));
      for (Index k = 0; k < kMeans; ++k) {
        const Index from = k * of.size() / kMeans, to = (k + 1) * of.size() / kMeans;
        left(row++) = of.segment(from, std::max<Index>(1, to - from)).mean();
      }
    }
    return 0;
  }

  /// By differences, of all speeds at once: a stretch knows its own alone. A friction that is none stays none
  /// where it would become less.
  int df(const VectorXd& n, Eigen::MatrixXd& slopes) const {
    VectorXd here(values()), there(values());
    (*this)(n, here);
    slopes.setZero();
    for (Index k = 0; k <= own_; ++k) {
      VectorXd near = n;
      near.segment(k, k < own_ ? 1 : n.size() - own_).array() += kNudge;
      (*this)(near, there);
      there = (there - here) / kNudge;
      if (k < own_) slopes.col(k) = there;
    }
    for (Index k = own_, row = 0; k < n.size(); ++k, row += kMeans)
      slopes.col(k).segment(row, kMeans) = there.segment(row, kMeans);
    for (const Index k : kFrictions)
      if (k < own_ && n(k) <= 0.0 && slopes.col(k).dot(here) > 0.0) slopes.col(k).setZero();
    return 0;
  }

 private:
  const FreeMotion& motion_;
  Index own_;
  double drive_, viscous_, pushed_, speed_;
  VectorXd first_;
};

}  // namespace

void advance(const FreeBody& body, double u, double dt, double& x, double& v) {
  const double a = body.drive * u + body.constant, held = body.dry + body.sticking;
  if (v == 0.0 && std::abs(a) <= held) return;
  const bool fades = v != 0.0 && body.sticking != 0.0;
  const double dry = fades ? body.dry + body.sticking * std::exp(-std::abs(v) / body.fading) : held;
  const auto after = [&](double speed, double sign, double time) {
    const double half = 0.5 * body.viscous * time;
    return (speed * (1.0 - half) + (a - dry * sign) * time) / (1.0 + half);
  };
  const double sign = std::copysign(1.0, v != 0.0 ? v : a);
  double next = after(v, sign, dt), left = dt;
  if (next * sign < 0.0 && v != 0.0) {  // comes to rest on the way, and may turn round
    const double until = dt * v / (v - next);
    x += 0.5 * v * until;
    v = 0.0, left = dt - until;
    next = std::abs(a) <= held ? 0.0 : after(0.0, std::copysign(1.0, a), left);
    if (next * a < 0.0) next = 0.0;
  }
  x += 0.5 * (v + next) * left;
  v = next;
}

FollowedBody follow(const FreeMotion& motion, const FreeBody& start, FreeNumbers numbers) {
  LeftOver left(motion, start, numbers);
  if (!left.driven()) return {start};
  Eigen::LevenbergMarquardt<LeftOver> search(left);
  search.setFtol(kSettled);
  search.setMaxfev(kMostTrials);
  search.setExternalScaling(true);  // the numbers are of one size
  search.diag() = VectorXd::Ones(left.inputs());
  VectorXd n = left.first();
  auto status = search.minimizeInit(n);
  do {
    status = search.minimizeOneStep(n);
    for (const Index k : kFrictions)
      if (k < static_cast<Index>(numbers)) n(k) = std::max(n(k), 0.0);
  } while (status == Eigen::LevenbergMarquardtSpace::Running);
  const double rms_left = search.fnorm() / std::sqrt(static_cast<double>(left.values()));
  FollowedBody found{left.body(n), left.speeds(n), rms_left, 0.0};
  for (Index k = 0; const FreeStretch& s : motion.stretches)
    found.squares += left_of(motion, s, found.body, found.speeds(k++)).squaredNorm();
  return found;
}

}  // namespace gapscope::internal::sliding_mode
