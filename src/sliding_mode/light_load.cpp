#include "sliding_mode/light_load.h"

#include <algorithm>
#include <cmath>

#include "sliding_mode/one_body_search.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr int kParts = 10;  ///< of an interval: how finely impacts are placed

class MotorWithLoad {
 public:
  MotorWithLoad(const OneBodyLaw& law, double ratio, double slows, double gap, double v)
      : ratio_(ratio), slows_(slows), half_(0.5 * gap), both_(law), motor_(law), v_(v), load_speed_(v) {
    // Alone, the motor is that much easier to move, and to hold.
    for (double* per_inertia : {&motor_.viscous, &motor_.dry, &motor_.sticking}) *per_inertia *= 1.0 + ratio;
    motor_.viscous = std::max(motor_.viscous - ratio * slows, 0.0);
  }

  double x() const { return x_; }

  /// @param a  of both under the torque, without friction [rad/s²]
  void go_on(double a, double step) {
    if (flank_ != 0)
      together(a, step);
    else
      apart(a, step);
  }

 private:
  void together(double a, double step) {
    const double before = v_;
    advance(both_, a, step, x_, v_);
    load_speed_ = v_;
    const double carried = v_ - before + slows_ * step * v_;
    if (flank_ * carried < 0.0) flank_ = 0;  // only a pull could take the load along
  }

  void apart(double a, double step) {
    const double before = x_;
    advance(motor_, (1.0 + ratio_) * a, step, x_, v_);
    behind_ += x_ - before - load_speed_ * step;
    load_speed_ *= std::exp(-slows_ * step);
    if (std::abs(behind_) < half_) return;
    flank_ = behind_ > 0.0 ? 1 : -1;
    x_ -= behind_ - flank_ * half_;
    behind_ = flank_ * half_;
    v_ = load_speed_ = (v_ + ratio_ * load_speed_) / (1.0 + ratio_);
  }

  double ratio_, slows_, half_;
  OneBodyLaw both_, motor_;
  double x_ = 0.0, v_;
  double behind_ = 0.0, load_speed_;  // x1 less the load's place, within ±half the gap
  int flank_ = 0;                     // 1: the motor pushes forward, -1: backward, 0: neither
};

}  // namespace

std::vector<double> motion_with_light_load(const OneBodyLaw& law, double ratio, double slows, double gap,
                                           double v, std::span<const double> u, double dt) {
  MotorWithLoad drive(law, ratio, slows, gap, v);
  std::vector<double> x;
  x.reserve(u.size());
  for (const double held : u) {
    x.push_back(drive.x());
    for (int k = 0; k < kParts; ++k) drive.go_on(law.drive * held + law.constant, dt / kParts);
  }
  return x;
}

}  // namespace gapscope::internal::sliding_mode
