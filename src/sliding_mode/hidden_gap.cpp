#include "sliding_mode/hidden_gap.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kInstants = 400.0;  ///< of a period: half leaves 0.8 to 2.3 times as much, double 0.7 to 1.1
/// Of the rms speed: where friction that fades with it is sought from. Half and double leave within 14 %, one
/// of them alone up to 1.2 times as much.
constexpr double kFadings[] = {0.02, 0.2};
constexpr double kFirstSticking = 0.1;  ///< of what u (rms) drives: a tenth finds the same
/// Of its gap, what a light load leaves at most, as far as it is believed: a search that ends early leaves
/// more (5650038 gap sine wide slides was once denied 0.4 mrad of 9.1). Without it gaps are 1 % smaller.
constexpr double kMostLeft = 0.02;
constexpr double kMostTried = 0.25;  ///< of the travel, first: half finds gaps 4 % smaller, double 9 % larger
constexpr int kTries = 2;  ///< each corrects the gap by what the one before has left; a third by 3 %
/// Of the rate of both, how fast light loads slow down alone. Set on 5620001 40 gap (all inputs) wide slides.
constexpr double kSlowing[] = {0.0, 0.5, 1.0};
/// Between these loads and others, whose contact is soft or which rebound. Half of it denies 5 of the 60 of
/// 5650001 gap sine wide slides above the limit that is told (loads of 0.1, kSlowing = 0), this 1 there.
constexpr double kUnlikeLoads = 2.0;
constexpr int kParts = 10;  ///< of an interval, to place impacts: a third finds gaps 9 % smaller, double 1 %

/// The recording at the instants at which it is followed, and its periods.
FreeMotion sampled(const MotorTrace& trace, const signals::SignalFacts& facts) {
  const auto stride = static_cast<std::size_t>(std::max(2.0 * facts.half_period / trace.dt / kInstants, 1.0));
  FreeMotion m{trace.dt * static_cast<double>(stride), {}, {}};
  for (std::size_t i = 0; i + stride <= trace.size(); i += stride) {
    const std::size_t reach = std::min((stride - 1) / 2, i);
    m.u.push_back(mean(trace.u.subspan(i, stride)));
    m.x.push_back(mean(trace.x1.subspan(i - reach, 2 * reach + 1)));
  }
  const auto& at = facts.crossings;
  for (std::size_t k = 1; k + 2 < at.size(); k += 2) {
    const FreeStretch period{at[k] / stride, std::min(at[k + 2] / stride, m.x.size() - 1)};
    if (period.last > period.first) m.stretches.push_back(period);
  }
  m.stretches = spread<FreeStretch>(m.stretches);
  return m;
}

/// By the acceleration over a thirtieth of a period, and the mean u in it. Slow motion, of uncertain sign,
/// weighs less.
FreeBody first_body(const FreeMotion& m) {
  const auto half = static_cast<std::size_t>(kInstants / 60.0);
  const double time = 2.0 * static_cast<double>(half) * m.dt;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 2 * half; i + 2 * half < m.x.size(); i += half) {
    const double v = (m.x[i + half] - m.x[i - half]) / time;
    const double a = (m.x[i + 2 * half] - 2.0 * m.x[i] + m.x[i - 2 * half]) / (time * time);
    const double u = mean(std::span(m.u).subspan(i - half, 2 * half));
    const Eigen::Vector4d by(u, -v, -std::copysign(1.0, v), 1.0);
    normal += v * v * by * by.transpose();
    right += v * v * a * by;
  }
  const Eigen::Vector4d found = normal.ldlt().solve(right);
  return {found(0), std::max(found(1), 0.0), std::max(found(2), 0.0), found(3)};
}

/// The body that leaves least, with friction that fades with speed or without.
FollowedBody best_body(const FreeMotion& m, double speed_rms) {
  FollowedBody best = follow(m, first_body(m), FreeNumbers::kConstant);
  FreeBody sticks = best.body;
  sticks.sticking = kFirstSticking * sticks.drive * rms(m.u);
  for (const double fading : kFadings) {
    sticks.fading = fading * speed_rms;
    const FollowedBody other = follow(m, sticks, FreeNumbers::kSticking);
    if (other.left < best.left) best = other;
  }
  return best;
}

/// The motion of that body if a part of its inertia were a load behind a gap, without dry friction of its
/// own, and struck without a rebound. Of all loads of its inertia such ones show least: dry friction takes
/// them out of step with the motor.
/// @param slows  the load alone, its viscous friction [1/s]; the motor has the rest
FreeMotion with_light_load(FreeMotion m, const FollowedBody& both, double slows, double gap) {
  constexpr double kMotor = 1.0 + kLightestLoad;
  FreeBody motor = both.body;  // alone that much easier to move, and to hold
  for (double* n : {&motor.drive, &motor.viscous, &motor.dry, &motor.constant, &motor.sticking}) *n *= kMotor;
  motor.viscous = std::max(motor.viscous - kLightestLoad * slows, 0.0);
  double x = 0.0, v = both.speeds(0), load = v;  // [rad], [rad/s]
  double behind = 0.0;                           // x less the load's place, within ±half the gap
  int flank = 0;                                 // 1: the motor pushes forward, -1: backward, 0: neither
  const double step = m.dt / kParts;
  for (std::size_t i = kParts * m.stretches[0].first; i < kParts * m.x.size(); ++i) {
    if (i % kParts == 0) m.x[i / kParts] = x;
    const double x_before = x, v_before = v;
    advance(flank != 0 ? both.body : motor, m.u[i / kParts], step, x, v);
    if (flank != 0) {  // together, until only a pull could take the load along
      load = v;
      if (flank * (v - v_before + slows * step * v) < 0.0) flank = 0;
      continue;
    }
    behind += x - x_before - load * step;
    load *= std::exp(-slows * step);
    if (std::abs(behind) < 0.5 * gap) continue;
    flank = behind > 0.0 ? 1 : -1;
    x -= behind - flank * 0.5 * gap;
    behind = flank * 0.5 * gap;
    v = load = (v + kLightestLoad * load) / kMotor;
  }
  return m;
}

/// The smallest gap of which any light load would have left as much.
double hidden_gap(const FreeMotion& m, const FollowedBody& best, double travel) {
  const auto numbers = best.body.sticking != 0.0 ? FreeNumbers::kSticking : FreeNumbers::kConstant;
  double hidden = 0.0;
  for (const double share : kSlowing) {
    double gap = std::min(best.left / kMostLeft, kMostTried * travel);
    for (int k = 0; k < kTries && gap < travel; ++k) {
      const FreeMotion motion = with_light_load(m, best, share * best.body.viscous, gap);
      gap = best.left / std::min(follow(motion, best.body, numbers).left / gap, kMostLeft);
    }
    hidden = std::max(hidden, gap);
  }
  return kUnlikeLoads * hidden;
}

}  // namespace

OneBodyFit fit_one_body(const MotorTrace& trace, const signals::SignalFacts& facts) {
  if (trace.u.size() != trace.size() || !facts.defect.empty()) return {};
  const FreeMotion m = sampled(trace, facts);
  if (m.stretches.empty()) return {};
  const FollowedBody best = best_body(m, facts.speed_rms);
  return best.left < kInfinity ? OneBodyFit{best.body, best.left, hidden_gap(m, best, facts.travel)}
                               : OneBodyFit{};
}

}  // namespace gapscope::internal::sliding_mode
