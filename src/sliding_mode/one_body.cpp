#include "sliding_mode/one_body.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kInstants = 400.0;       ///< that a period is followed at
constexpr double kMeans = 80.0;           ///< over which what is left is averaged, of a period
constexpr std::size_t kMostPeriods = 12;  ///< followed
constexpr int kRounds = 30;               ///< of linear steps, from each begin
constexpr double kSettled = 1e-3;         ///< of the squared error
constexpr double kStep = 1e-4;            ///< of a parameter's scale, for its derivative
constexpr double kSlow = 0.1;  ///< of the largest speed: the sign of slower motion is not believed at first
constexpr double kFadings[] = {0.02, 0.2};  ///< of the rms speed: begins of friction that fades
constexpr double kLeastFading = 0.003;      ///< of the largest speed

using Numbers = Eigen::Matrix<double, 8, 1>;  ///< of the law, then place and speed of one period
constexpr Eigen::Index kOfOneBody = 6;

/// The recording at the instants at which it is followed.
struct Instants {
  double dt = 0.0;
  std::vector<double> u, x;
  struct Period {
    std::size_t first = 0, last = 0;
  };
  std::vector<Period> periods;
  double fastest = 0.0, strongest = 0.0, width = 0.0;  ///< [rad/s], of u, peak to peak [rad]

  double speed(std::size_t i, std::size_t reach) const {
    const std::size_t from = i - std::min(i, reach), to = std::min(i + reach, x.size() - 1);
    return (x[to] - x[from]) / (dt * static_cast<double>(to - from));
  }
};

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
  if (!s.x.empty()) s.width = *std::ranges::max_element(s.x) - *std::ranges::min_element(s.x);
  return s;
}

/// One instant further: torque a and friction are constant meanwhile, but for the friction's sign.
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

OneBodyLaw law_of(const Numbers& n) { return {n(0), n(1), n(2), n(3), n(4), n(5)}; }

/// x1 less the motion, at every instant of a period.
Eigen::VectorXd left_of(const Instants& s, const Instants::Period& p, const Numbers& n) {
  Eigen::VectorXd left(static_cast<Eigen::Index>(p.last - p.first + 1));
  const OneBodyLaw law = law_of(n);
  double x = n(kOfOneBody), v = n(kOfOneBody + 1);
  for (std::size_t i = p.first; i <= p.last; ++i) {
    left(static_cast<Eigen::Index>(i - p.first)) = s.x[i] - x;
    advance(law, law.drive * s.u[i] + law.constant, s.dt, x, v);
  }
  return left;
}

/// Law and begins; the law is that of every period.
struct OneBodyState {
  std::vector<Numbers> periods;
  double squares = kInfinity;
};

class OneBodySearch {
 public:
  OneBodySearch(const Instants& s, const OneBodyLaw& start) : s_(s) {
    const double pushed = std::abs(start.drive) * s.strongest;
    scales_ << start.drive, pushed, std::max(start.viscous, 0.1), pushed, pushed, 0.0, s.width, s.fastest;
  }

  /// From `state` downhill.  @param fades  whether the friction may fade with speed
  OneBodyState improve(OneBodyState state, bool fades) {
    scales_(5) = fades ? state.periods.front()(5) : 0.0;
    fades_ = fades;
    state.squares = squares(state);
    double damping = 1e-3;
    for (int i = 0; i < kRounds; ++i) {
      linearise(state);
      const double before = state.squares;
      for (; damping < 1e4; damping *= 6.0)
        if (OneBodyState next = stepped(state, damping); next.squares < state.squares) {
          state = std::move(next);
          damping *= 0.1;
          break;
        }
      if (!(state.squares < (1.0 - kSettled) * before)) break;
    }
    return state;
  }

 private:
  double squares(const OneBodyState& state) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < s_.periods.size(); ++p)
      sum += left_of(s_, s_.periods[p], state.periods[p]).squaredNorm();
    return sum;
  }

  bool is_free(Eigen::Index k) const { return fades_ || (k != 4 && k != 5); }
  static Eigen::Index place(Eigen::Index k, std::size_t period) {
    return k < kOfOneBody ? k : k + 2 * static_cast<Eigen::Index>(period);
  }

  void linearise(const OneBodyState& state) {
    const Eigen::Index all = kOfOneBody + 2 * std::ssize(s_.periods);
    normal_ = Eigen::MatrixXd::Zero(all, all);
    down_ = Eigen::VectorXd::Zero(all);
    for (std::size_t p = 0; p < s_.periods.size(); ++p) {
      const Eigen::VectorXd left = left_of(s_, s_.periods[p], state.periods[p]);
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(left.size(), scales_.size());
      for (Eigen::Index k = 0; k < scales_.size(); ++k) {
        if (!is_free(k)) continue;
        Numbers near = state.periods[p];
        near(k) += kStep * scales_(k);
        J.col(k) = (left - left_of(s_, s_.periods[p], near)) / kStep;
      }
      const Eigen::MatrixXd square = J.transpose() * J;
      const Eigen::VectorXd along = J.transpose() * left;
      for (Eigen::Index a = 0; a < scales_.size(); ++a) {
        down_(place(a, p)) += along(a);
        for (Eigen::Index b = 0; b < scales_.size(); ++b) normal_(place(a, p), place(b, p)) += square(a, b);
      }
    }
  }

  /// Friction never drives.
  OneBodyState stepped(const OneBodyState& state, double damping) const {
    Eigen::MatrixXd A = normal_;
    A.diagonal() += damping * normal_.diagonal() + Eigen::VectorXd::Constant(A.rows(), 1e-300);
    const Eigen::VectorXd step = A.ldlt().solve(down_);
    OneBodyState next = state;
    if (!step.allFinite()) return {state.periods, kInfinity};
    for (std::size_t p = 0; p < next.periods.size(); ++p) {
      Numbers& n = next.periods[p];
      for (Eigen::Index k = 0; k < n.size(); ++k) n(k) += scales_(k) * step(place(k, p));
      n(2) = std::max(n(2), 0.0), n(3) = std::max(n(3), 0.0), n(4) = std::max(n(4), -n(3));
      n(5) = std::clamp(n(5), kLeastFading * s_.fastest, s_.fastest);
    }
    next.squares = squares(next);
    return next;
  }

  const Instants& s_;
  Numbers scales_;
  bool fades_ = false;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd down_;
};

/// Second differences of x1 over a thirtieth of a period, by the mean u that they had.
OneBodyLaw first_law(const Instants& s) {
  const auto m = static_cast<std::size_t>(kInstants / 60.0);
  const double span = 2.0 * static_cast<double>(m) * s.dt;
  const auto rows = static_cast<Eigen::Index>(s.x.size() / m);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, 4);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const std::size_t i = m * static_cast<std::size_t>(r);
    if (i < 2 * m || i + 2 * m >= s.x.size()) continue;
    const double v = s.speed(i, m);
    if (std::abs(v) < kSlow * s.fastest) continue;
    double u = 0.0, weights = 0.0;
    for (std::size_t k = i - 2 * m; k < i + 2 * m; ++k) {
      const double weight =
          2.0 * static_cast<double>(m) - std::abs(static_cast<double>(k) + 0.5 - static_cast<double>(i));
      u += weight * s.u[k], weights += weight;
    }
    A.row(r) << u / weights, 1.0, -v, -std::copysign(1.0, v);
    y(r) = (s.x[i + 2 * m] - 2.0 * s.x[i] + s.x[i - 2 * m]) / (span * span);
  }
  const Eigen::Vector4d found = A.colPivHouseholderQr().solve(y);
  return {found(0), found(1), std::max(found(2), 0.0), std::max(found(3), 0.0), 0.0, s.fastest};
}

OneBodyState begun(const Instants& s, const OneBodyLaw& law) {
  OneBodyState state;
  for (const Instants::Period& p : s.periods) {
    Numbers n;
    n << law.drive, law.constant, law.viscous, law.dry, law.sticking, law.fading, s.x[p.first],
        s.speed(p.first, std::max<std::size_t>(2, (p.last - p.first) / 100));
    state.periods.push_back(n);
  }
  return state;
}

double rms_of_means(const Instants& s, const OneBodyState& state) {
  double sum = 0.0;
  Eigen::Index means = 0;
  for (std::size_t p = 0; p < s.periods.size(); ++p) {
    const Eigen::VectorXd left = left_of(s, s.periods[p], state.periods[p]);
    const auto m =
        std::max<Eigen::Index>(1, static_cast<Eigen::Index>(static_cast<double>(left.size()) / kMeans));
    for (Eigen::Index i = 0; i + m <= left.size(); i += m, ++means)
      sum += std::pow(left.segment(i, m).mean(), 2);
  }
  return std::sqrt(sum / static_cast<double>(means));
}

}  // namespace

OneBodyFit fit_one_body(const MotorTrace& trace, const signals::SignalFacts& facts) {
  if (trace.u.size() != trace.size() || !facts.defect.empty()) return {};
  const Instants s = instants_of(trace, facts);
  if (s.periods.empty() || !(s.fastest > 0.0) || !(s.strongest > 0.0)) return {};
  const OneBodyLaw start = first_law(s);
  if (!(start.drive > 0.0)) return {};
  OneBodySearch search(s, start);
  OneBodyState best = search.improve(begun(s, start), false);
  for (const double fading : kFadings) {
    OneBodyState other = best;
    for (Numbers& n : other.periods) {
      n(4) = 0.3 * std::max(n(3), 0.02 * start.drive * s.strongest);
      n(5) = std::max(fading * facts.speed_rms, kLeastFading * s.fastest);
    }
    if (other = search.improve(std::move(other), true); other.squares < best.squares) best = std::move(other);
  }
  return {law_of(best.periods.front()), rms_of_means(s, best)};
}

}  // namespace gapscope::internal::sliding_mode
