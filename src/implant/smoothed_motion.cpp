#include "implant/smoothed_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/require.h"

namespace gapscope::internal::implant {
namespace {

using State = Eigen::Vector3d;  ///< position, speed, acceleration; in noises and mean steps
using Cov = Eigen::Matrix3d;

constexpr double kLeastJerk = 1e-24, kMostJerk = 1e6;  ///< intensity over the noise's variance and step⁵ [-]
constexpr int kSearchSteps = 40;                       ///< of the golden section: 70 decades to 1e-7 of one
constexpr double kStandsWithin = 3.0;                  ///< standard deviations of the speed
constexpr double kDiffuse = 1e10;                      ///< variance of what nothing is known of

Cov moved(double h) {
  Cov f;
  f << 1.0, h, 0.5 * h * h, 0.0, 1.0, h, 0.0, 0.0, 1.0;
  return f;
}

/// Covariance that white jerk of intensity q brings in a step.
Cov jerked(double h, double q) {
  const double h2 = h * h, h3 = h2 * h, h4 = h3 * h, h5 = h4 * h;
  Cov c;
  c << h5 / 20.0, h4 / 8.0, h3 / 6.0, h4 / 8.0, h3 / 3.0, h2 / 2.0, h3 / 6.0, h2 / 2.0, h;
  return q * c;
}

/// Readings in noises, steps in mean steps.
struct Readings {
  std::vector<double> x, step;
};

/// One pass of the Kalman filter. @param keep called with the prediction and the filtered state of a sample
/// @return −2 log of the likelihood, the noise's variance concentrated out
template <class Keep>
double filter(const Readings& r, double q, const Keep& keep) {
  State s(r.x[0], (r.x[1] - r.x[0]) / r.step[0], 0.0);
  Cov p = Cov::Zero();
  p.diagonal() << 1.0, kDiffuse, kDiffuse;
  double square = 0.0, log_sum = 0.0;
  keep(0, s, p, s, p);
  for (std::size_t i = 1; i < r.x.size(); ++i) {
    const Cov f = moved(r.step[i - 1]);
    const State ahead = f * s;
    const Cov ahead_p = f * p * f.transpose() + jerked(r.step[i - 1], q);
    const double variance = ahead_p(0, 0) + 1.0, error = r.x[i] - ahead[0];
    const State gain = ahead_p.col(0) / variance;
    s = ahead + gain * error;
    Cov open = Cov::Identity();
    open.col(0) -= gain;
    p = open * ahead_p * open.transpose() + gain * gain.transpose();  // Joseph's form stays positive
    if (i > 2) square += error * error / variance, log_sum += std::log(variance);
    keep(i, ahead, ahead_p, s, p);
  }
  const double n = static_cast<double>(r.x.size()) - 3.0;
  return n * std::log(std::max(square, 1e-300) / n) + log_sum;
}

/// The intensity of the jerk under which the readings are most likely.
double likeliest_jerk(const Readings& r) {
  const auto cost = [&](double log_q) { return filter(r, std::exp(log_q), [](auto&&...) {}); };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = std::log(kLeastJerk), high = std::log(kMostJerk);
  double a = high - golden * (high - low), b = low + golden * (high - low), fa = cost(a), fb = cost(b);
  for (int i = 0; i < kSearchSteps; ++i) {
    if (fa < fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = cost(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = cost(b);
    }
  }
  return std::exp(0.5 * (low + high));
}

struct Kept {
  std::vector<State> ahead, here;
  std::vector<Cov> ahead_p, here_p;
};

}  // namespace

SmoothedMotion::SmoothedMotion(const MotorTrace& trace) : mean_step_(trace.dt) {
  const std::size_t n = trace.size();
  GAPSCOPE_REQUIRE(n >= 3 && trace.dt > 0.0);
  double unit = 0.0;  // mean size of the moves: any length will do
  for (std::size_t i = 1; i < n; ++i) unit += std::abs(trace.x1[i] - trace.x1[i - 1]);
  unit = unit > 0.0 ? unit / static_cast<double>(n) : 1.0;
  Readings r;
  for (std::size_t i = 0; i < n; ++i) {
    r.x.push_back((trace.x1[i] - trace.x1[0]) / unit);
    r.step.push_back(trace.step(i) / trace.dt);
  }
  const double q = likeliest_jerk(r);
  Kept k;
  for (auto* states : {&k.ahead, &k.here}) states->resize(n);
  for (auto* covs : {&k.ahead_p, &k.here_p}) covs->resize(n);
  double square = 0.0;
  filter(r, q, [&](std::size_t i, const State& ahead, const Cov& ahead_p, const State& here, const Cov& p) {
    k.ahead[i] = ahead, k.ahead_p[i] = ahead_p, k.here[i] = here, k.here_p[i] = p;
    if (i > 2) square += std::pow(r.x[i] - ahead[0], 2) / (ahead_p(0, 0) + 1.0);
  });
  const double noise = std::sqrt(square / std::max(1.0, static_cast<double>(n) - 3.0));
  for (std::size_t i = n - 1; i-- > 0;) {
    const Cov back = k.here_p[i] * moved(r.step[i]).transpose() * k.ahead_p[i + 1].inverse();
    k.here[i] += back * (k.here[i + 1] - k.ahead[i + 1]);
    k.here_p[i] += back * (k.here_p[i + 1] - k.ahead_p[i + 1]) * back.transpose();
  }
  for (std::size_t i = 0; i < n; ++i) {
    const State& s = k.here[i];
    points_.push_back({trace.elapsed(i), trace.x1[0] + unit * s[0], unit * s[1] / trace.dt,
                       unit * s[2] / (trace.dt * trace.dt)});
    speed_std_.push_back(noise * unit * std::sqrt(std::max(0.0, k.here_p[i](1, 1))) / trace.dt);
  }
}

double SmoothedMotion::step(std::size_t i) const {
  return i + 1 < points_.size() ? points_[i + 1].t - points_[i].t : mean_step_;
}

MotionPoint SmoothedMotion::between(std::size_t i, double share) const {
  const MotionPoint& p = points_[i];
  const double h = step(i), s = share * h;
  MotionPoint m{p.t + s, p.x + s * (p.w + 0.5 * s * p.a), p.w + s * p.a, p.a};
  if (i + 1 >= points_.size()) return m;
  // What the end lacks of constant acceleration: d0 in position, d1 in speed, d2 in acceleration.
  const MotionPoint& e = points_[i + 1];
  const double d0 = e.x - p.x - h * (p.w + 0.5 * h * p.a), d1 = h * (e.w - p.w - h * p.a),
               d2 = 0.5 * h * h * (e.a - p.a);
  const double c3 = 10.0 * d0 - 4.0 * d1 + d2, c4 = -15.0 * d0 + 7.0 * d1 - 2.0 * d2,
               c5 = 6.0 * d0 - 3.0 * d1 + d2;
  const double z = share, z2 = z * z;
  m.x += z2 * z * (c3 + z * (c4 + z * c5));
  m.w += z2 * (3.0 * c3 + z * (4.0 * c4 + 5.0 * z * c5)) / h;
  m.a += z * (6.0 * c3 + z * (12.0 * c4 + 20.0 * z * c5)) / (h * h);
  return m;
}

int SmoothedMotion::direction(std::size_t i, const MotionPoint& at) const {
  if (std::abs(at.w) <= kStandsWithin * speed_std_[i]) return 0;
  return at.w > 0.0 ? 1 : -1;
}

}  // namespace gapscope::internal::implant
