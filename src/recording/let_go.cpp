#include "recording/let_go.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace gapscope::internal::recording {
namespace {

constexpr double kRests = 0.3;         ///< so long at the end of a file, at least [s]
constexpr double kRestsWithin = 0.01;  ///< of the way that the drive has gone
constexpr double kFarOff = 0.25;       ///< of that way, off the goal: a controller at work would move it
constexpr double kSmooth = 0.03;       ///< over which each derivative is taken, to either side [s]
constexpr double kStandstill = 0.05;   ///< speed about which friction turns over [rad/s]
/// Square that is left of the acceleration, with a torque that ends over one that goes on. Of 14 real logs
/// 12 in which an arm falls leave 0.27 to 0.83 (the two that leave most jump besides), the two of a weak
/// controller 0.95 and 0.99; with half and double of kSmooth 0.24 to 0.88 and 0.93 to 1.0.
constexpr double kLeft = 0.9;

Eigen::VectorXd slope_of(const Eigen::VectorXd& x, const std::vector<double>& t, Eigen::Index reach) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = reach; i < n - reach; ++i)
    slope(i) = (x(i + reach) - x(i - reach)) / (t[i + reach] - t[i - reach]);
  return slope;
}

class Fall {
 public:
  explicit Fall(const CommandRows& rows) : t_(rows.t), size_(static_cast<Eigen::Index>(rows.t.size())) {
    const double dt = (t_.back() - t_.front()) / static_cast<double>(size_ - 1);
    const auto reach = std::max<Eigen::Index>(1, std::lround(kSmooth / dt));
    const Eigen::VectorXd x = Eigen::VectorXd::Map(rows.position.data(), size_);
    error_ = Eigen::VectorXd::Map(rows.target.data(), size_) - x;
    speed_ = slope_of(x, t_, reach);
    motion_ = slope_of(speed_, t_, reach);
    laws_.resize(size_, 5);
    laws_.col(1) = speed_;
    laws_.col(2) = (speed_.array() / kStandstill).tanh();
    laws_.col(3) = x.array().sin(), laws_.col(4) = x.array().cos();
  }

  /// Where the fastest motion away from the last goal begins, its speed drawn back to zero: within 21 ms of
  /// what 14 real logs have [s].
  double begins() const {
    const Eigen::VectorXd away = std::copysign(1.0, -error_(size_ - 1)) * speed_;
    Eigen::Index top = 0;
    const double most = away.maxCoeff(&top);
    if (!(most > 0.0)) return kInfinity;
    const auto rises_past = [&](double share) {
      Eigen::Index i = top;
      while (i > 0 && away(i) > share * most) --i;
      const double t = t_[i], next = t_[i + 1];
      return t + (share * most - away(i)) / (away(i + 1) - away(i)) * (next - t);
    };
    return 2.0 * rises_past(0.1) - rises_past(0.2);
  }

  /// Square of the acceleration that is left where the controller's torque ends at a time.
  double left_until(double off) {
    for (Eigen::Index i = 0; i < size_; ++i) laws_(i, 0) = t_[i] < off ? error_(i) : 0.0;
    return (motion_ - laws_ * laws_.colPivHouseholderQr().solve(motion_)).squaredNorm();
  }

 private:
  const std::vector<double>& t_;
  Eigen::Index size_;
  Eigen::VectorXd error_, speed_, motion_;
  Eigen::MatrixXd laws_;  // (rows × 5): of the controller, of the speed, its sign, sine and cosine of x
};

bool rests_far_off(const CommandRows& rows) {
  const std::vector<double>& x = rows.position;
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  const double way = *high - *low;
  std::size_t i = x.size() - 1;
  while (i > 0 && std::abs(x[i - 1] - x.back()) <= kRestsWithin * way) --i;
  return rows.t.back() - rows.t[i] >= kRests && std::abs(rows.target.back() - x.back()) > kFarOff * way;
}

}  // namespace

double let_go_at(const CommandRows& rows) {
  if (!rests_far_off(rows)) return kInfinity;
  Fall fall(rows);
  const double begins = fall.begins();
  return fall.left_until(begins) < kLeft * fall.left_until(kInfinity) ? begins : kInfinity;
}

}  // namespace gapscope::internal::recording
