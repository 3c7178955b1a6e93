#include "sliding_mode/one_body_search.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unsupported/Eigen/LevenbergMarquardt>

namespace gapscope::internal::sliding_mode {
namespace {

/// Followed: a limit of work. 24 and 6 change nothing (these drives have 6), 3 no verdict.
constexpr std::size_t kMostPeriods = 12;
/// Of linear steps, from each begin; half leaves one drive 1.4 times as much, double nothing else.
constexpr int kRounds = 30;
/// Of the squared error; half, double and a hundredth leave the same.
constexpr double kSettled = 1e-3;
/// Of a number, for its derivative; half and double within 7 %.
constexpr double kStep = 1e-4;

}  // namespace

Instants instants_of(const MotorTrace& trace, const signals::SignalFacts& facts) {
  Instants s;
  const auto stride = static_cast<std::size_t>(std::max(2.0 * facts.half_period / trace.dt / kInstants, 1.0));
  s.dt = trace.dt * static_cast<double>(stride);
  const std::size_t half = (stride - 1) / 2;
  for (std::size_t i = 0; i + stride <= trace.size(); i += stride) {
    const auto mean = [](std::span<const double> values, std::size_t from, std::size_t to) {
      double sum = 0.0;
      for (std::size_t k = from; k < to; ++k) sum += values[k];
      return sum / static_cast<double>(to - from);
    };
    s.u.push_back(mean(trace.u, i, i + stride));
    const std::size_t reach = std::min(half, i);
    s.x.push_back(mean(trace.x1, i - reach, i + reach + 1));
  }
  const auto& at = facts.crossings;
  for (std::size_t k = 1; k + 2 < at.size(); k += 2)
    s.periods.push_back({at[k] / stride, std::min(at[k + 2] / stride, s.x.size() - 1)});
  std::erase_if(s.periods, [](const Instants::Period& p) { return p.last < p.first + 20; });
  const std::size_t every = (s.periods.size() + kMostPeriods - 1) / kMostPeriods;
  for (std::size_t k = 0; every > 1 && k * every < s.periods.size(); ++k) s.periods[k] = s.periods[k * every];
  if (every > 1) s.periods.resize((s.periods.size() + every - 1) / every);
  for (const double u : s.u) s.strongest = std::max(s.strongest, std::abs(u));
  for (std::size_t i = 2; i + 2 < s.x.size(); ++i) s.fastest = std::max(s.fastest, std::abs(s.speed(i, 2)));
  return s;
}

void advance(const OneBodyLaw& law, double a, double dt, double& x, double& v) {
  const double held = law.dry + law.sticking;
  if (v == 0.0 && std::abs(a) <= held) return;
  const double dry =
      law.dry + (law.sticking == 0.0 ? 0.0 : law.sticking * std::exp(-std::abs(v) / law.fading));
  const auto after = [&](double speed, double sign, double time) {
    const double half = 0.5 * law.viscous * time;
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

namespace {

/// Means of x1 less the motion over a period, less their mean.
Eigen::VectorXd left_of(const Instants& s, const Instants::Period& p, const OneBodyLaw& law, double v) {
  Eigen::VectorXd left = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(p.means()));
  double x = s.x[p.first];
  for (std::size_t i = p.first; i < p.first + p.means() * p.mean(); ++i) {
    left(static_cast<Eigen::Index>((i - p.first) / p.mean())) += s.x[i] - x;
    advance(law, law.drive * s.u[i] + law.constant, s.dt, x, v);
  }
  left /= static_cast<double>(p.mean());
  return left.array() - left.mean();
}

/// What the law leaves of x1, in means less their mean over the period: where a period begins does not matter
/// to its motion. The numbers have no bounds and are of one size: drive, constant, viscous, dry and, where
/// friction fades with speed, dry + sticking, all over their scales, and the logarithm of the fading speed;
/// then the speed at the begin of each period. The sign of what cannot be negative is not looked at.
class OneBodyLeft : public Eigen::DenseFunctor<double> {
 public:
  OneBodyLeft(const Instants& s, const OneBodyLaw& start, bool fades)
      : DenseFunctor(static_cast<int>((fades ? 6 : 4) + s.periods.size()), static_cast<int>(s.means())),
        s_(s),
        drive_(start.drive),
        pushed_(start.drive * s.strongest),
        viscous_(std::max(start.viscous, 0.1)),
        fades_(fades) {}

  Eigen::VectorXd numbers(const OneBodyState& state) const {
    const OneBodyLaw& law = state.law;
    Eigen::VectorXd n(inputs());
    n.head(4) << law.drive / drive_, law.constant / pushed_, law.viscous / viscous_, law.dry / pushed_;
    if (fades_) n.segment(4, 2) << (law.dry + law.sticking) / pushed_, std::log(law.fading / s_.fastest);
    n.tail(state.speeds.size()) = state.speeds / s_.fastest;
    return n;
  }

  OneBodyState state(const Eigen::VectorXd& n) const {
    OneBodyLaw law{drive_ * n(0), pushed_ * n(1), viscous_ * std::abs(n(2)), pushed_ * std::abs(n(3))};
    if (fades_) law.sticking = pushed_ * std::abs(n(4)) - law.dry;
    if (fades_) law.fading = s_.fastest * std::exp(std::min(n(5), 0.0));
    return {law, s_.fastest * n.tail(std::ssize(s_.periods))};
  }

  int operator()(const Eigen::VectorXd& n, Eigen::VectorXd& left) const {
    const OneBodyState at = state(n);
    Eigen::Index row = 0;
    for (std::size_t p = 0; p < s_.periods.size(); ++p) {
      const auto means = static_cast<Eigen::Index>(s_.periods[p].means());
      left.segment(row, means) = left_of(s_, s_.periods[p], at.law, at.speeds(static_cast<Eigen::Index>(p)));
      row += means;
    }
    return 0;
  }

 private:
  const Instants& s_;
  double drive_, pushed_, viscous_;
  bool fades_;
};

}  // namespace

OneBodyState improved(const Instants& s, const OneBodyLaw& scales, const OneBodyState& state, bool fades) {
  const OneBodyLeft left(s, scales, fades);
  Eigen::NumericalDiff<OneBodyLeft> differences(left, kStep * kStep);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<OneBodyLeft>> search(differences);
  search.setFtol(kSettled);
  search.setXtol(kSettled * kSettled);
  search.setMaxfev(kRounds * (left.inputs() + 2));
  Eigen::VectorXd n = left.numbers(state);
  search.minimize(n);
  OneBodyState found = left.state(n);
  found.left = search.fnorm() / std::sqrt(static_cast<double>(left.values()));
  return found;
}

}  // namespace gapscope::internal::sliding_mode
