#include "sliding_mode/pooled_flights.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kZero = 1e-3, kTurned = 0.15;  ///< of the largest |u|
constexpr double kFrom = 0.1, kTo = 1.2;        ///< of the gap that is tried
constexpr double kRest = 0.12;                  ///< of the flight, to either side of the zero of the torque
constexpr double kWide = 0.08;                  ///< … that x1 is averaged over where it turns round
constexpr std::size_t kMostRows = 3000;

using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 5, 5>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 5, 1>;

struct ConstrainedFit {
  SmallVector solution;
  double left = kInfinity;  ///< squared error [rad²]
};

/// Least squares with every coefficient behind the first at most zero: friction and the impact slow down.
ConstrainedFit solve_passive(const SmallMatrix& A, const SmallVector& y) {
  ConstrainedFit best;
  const Eigen::Index bounded = A.cols() - 1;
  for (unsigned dropped = 0; dropped < 1u << bounded; ++dropped) {
    SmallMatrix some = A;
    for (Eigen::Index k = 0; k < bounded; ++k)
      if (dropped >> k & 1u) some.col(k + 1).setZero();
    const SmallVector solution = some.colPivHouseholderQr().solve(y);
    const bool passive = (solution.tail(bounded).array() <= 0.0).all();
    const double left = (some * solution - y).squaredNorm();
    if (passive && left < best.left) best = {solution, left};
    if (passive && dropped == 0) break;
  }
  return best;
}

}  // namespace

std::vector<TorqueTurn> torque_turns(const MotorTrace& trace) {
  double most = 0.0;
  for (const double u : trace.u) most = std::max(most, std::abs(u));
  std::vector<TorqueTurn> turns;
  int side = 0;
  std::size_t quiet = 0, zero = 0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const double u = trace.u[i];
    if (side == 0 || side * u <= kZero * most) {
      if (std::abs(u) <= kZero * most || (i > 0 && u * trace.u[i - 1] <= 0.0)) {
        if (zero + 1 != i) quiet = i;
        zero = i;
      }
    }
    const int now = u > kTurned * most ? 1 : u < -kTurned * most ? -1 : side;
    if (now == side) continue;
    if (!turns.empty()) turns.back().next = zero;
    if (side != 0) turns.push_back({quiet, zero, trace.size() - 1, now});
    side = now;
  }
  return turns;
}

PooledFlights::PooledFlights(const MotorTrace& trace, const std::vector<TorqueTurn>& turns, double noise,
                             double gap)
    : trace_(trace), noise_(noise) {
  sums_.assign(trace.size() + 1, 0.0);
  for (std::size_t i = 0; i < trace.size(); ++i) sums_[i + 1] = sums_[i] + trace.x1[i] - trace.x1[0];
  for (int pass = 0; pass < 2; ++pass) {  // the second one knows how long a passage takes
    stretches_.clear();
    std::vector<double> lengths, speeds;
    for (const TorqueTurn& turn : turns)
      if (prepare(turn, gap)) {
        const PooledStretch& s = stretches_.back();
        const double end = crossing(s, gap);
        lengths.push_back(end - static_cast<double>(turn.zero));
        const double before = crossing(s, 0.8 * gap);
        speeds.push_back(0.2 * gap / std::max(end - before, 1.0));
        stretches_.back().speed = speeds.back();
      }
    if (lengths.empty()) return;
    duration_ = median(std::move(lengths));
    const double typical = median(std::move(speeds));
    for (PooledStretch& s : stretches_) s.speed /= typical;
    half_ = std::max<std::size_t>(1, static_cast<std::size_t>(duration_ / 40.0));
  }
  lay_tracks();
  lay_columns();
}

double PooledFlights::smooth(std::size_t i, std::size_t half) const {
  const std::size_t h = std::min({half, i, trace_.size() - 1 - i});
  return trace_.x1[0] + (sums_[i + h + 1] - sums_[i - h]) / static_cast<double>(2 * h + 1);
}

double PooledFlights::crossing(const PooledStretch& s, double distance) const {
  double before = 0.0;
  for (std::size_t i = s.turn.zero; i < s.turn.next; ++i) {
    const double at = s.turn.direction * (smooth(i, half_) - s.rest);
    if (at >= distance)
      return i == s.turn.zero ? static_cast<double>(i)
                              : static_cast<double>(i) - (at - distance) / std::max(at - before, 1e-300);
    before = at;
  }
  return kNaN;
}

bool PooledFlights::prepare(const TorqueTurn& turn, double gap) {
  PooledStretch s;
  s.turn = turn;
  const double length = duration_ > 0.0 ? duration_ : 0.3 * static_cast<double>(turn.next - turn.zero);
  const auto reach = std::max<std::size_t>(1, static_cast<std::size_t>(kRest * length));
  if (turn.zero < 3 * reach || turn.zero + reach + 1 >= trace_.size()) return false;
  s.rest = trace_.x1[0] +
           (sums_[turn.zero + reach + 1] - sums_[turn.zero - reach]) / static_cast<double>(2 * reach + 1);
  const double first = crossing(s, kFrom * gap), last = crossing(s, kTo * gap);
  if (std::isnan(first) || std::isnan(last) || last < first + 12.0) return false;
  const auto wide = std::max<std::size_t>(1, static_cast<std::size_t>(kWide * length));
  const std::size_t before = turn.zero - std::min({2 * reach, turn.zero});
  s.slid = 0.0;
  for (std::size_t i = std::min(turn.quiet, before); i < turn.zero; ++i)
    s.slid = std::max(s.slid, turn.direction * (smooth(i, wide) - s.rest) - 0.5 * noise_);
  for (std::size_t i = turn.quiet; i < static_cast<std::size_t>(first); ++i)
    s.beyond = std::max(s.beyond, -turn.direction * (smooth(i, wide) - s.rest) - 0.5 * noise_);
  s.first = static_cast<std::size_t>(first), s.last = static_cast<std::size_t>(last);
  stretches_.push_back(s);
  return true;
}

void PooledFlights::project(Eigen::VectorXd& column) const {
  for (std::size_t p = 0; p + 1 < begins_.size(); ++p) {
    const Eigen::Index from = begins_[p], n = begins_[p + 1] - from;
    for (int c = 0; c < 2; ++c) {
      const auto q = local_.col(c).segment(from, n);
      column.segment(from, n) -= q * q.dot(column.segment(from, n));
    }
  }
}

/// 1 and t of each passage for itself; ∬u, ∫x1 and ∬direction for all.
void PooledFlights::lay_columns() {
  std::size_t all = 0;
  for (const PooledStretch& s : stretches_) all += s.last - s.first + 1;
  const std::size_t stride = (all + kMostRows - 1) / kMostRows;
  for (std::size_t p = 0; p < stretches_.size(); ++p) {
    begins_.push_back(static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t i = stretches_[p].first; i <= stretches_[p].last; i += stride) rows_.push_back({p, i});
  }
  const auto n = static_cast<Eigen::Index>(rows_.size());
  begins_.push_back(n);
  local_.resize(n, 2);
  residual_.resize(n);
  std::vector<Eigen::VectorXd> shared(3, Eigen::VectorXd(n));
  for (std::size_t p = 0; p < stretches_.size(); ++p) {
    const PooledStretch& s = stretches_[p];
    const Eigen::Index from = begins_[p], count = begins_[p + 1] - from;
    double u1 = 0.0, u2 = 0.0, x = 0.0;
    std::size_t at = s.first;
    for (Eigen::Index r = from; r < from + count; ++r) {
      const std::size_t i = rows_[static_cast<std::size_t>(r)].sample;
      for (; at < i; ++at) {
        u2 += u1 + 0.5 * trace_.u[at], u1 += trace_.u[at];
        x += 0.5 * (trace_.x1[at] + trace_.x1[at + 1]) - s.rest;
      }
      const auto t = static_cast<double>(i - s.first);
      local_(r, 0) = 1.0, local_(r, 1) = t;
      shared[0](r) = u2, shared[1](r) = x, shared[2](r) = s.turn.direction * t * t;
      residual_(r) = trace_.x1[i] - s.rest;
    }
    auto one = local_.col(0).segment(from, count);
    one.normalize();
    auto time = local_.col(1).segment(from, count);
    time -= one * one.dot(time);
    if (time.norm() > 0.0) time.normalize();
  }
  project(residual_);
  basis_ = Eigen::MatrixXd::Zero(n, 3);
  triangle_.setZero();
  along_.setZero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    Eigen::VectorXd& column = shared[static_cast<std::size_t>(k)];
    const double whole = column.norm();
    project(column);
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index c = 0; c < k; ++c) {
        const double part = basis_.col(c).dot(column);
        column -= basis_.col(c) * part;
        triangle_(c, k) += part;
      }
    triangle_(k, k) = column.norm();
    if (column.norm() > 1e-9 * whole) basis_.col(k) = column.normalized();
  }
  for (Eigen::Index c = 0; c < 3; ++c) {
    along_(c) = basis_.col(c).dot(residual_);
    residual_ -= basis_.col(c) * along_(c);
  }
  smooth_sse_ = residual_.squaredNorm();
}

double PooledFlights::freedom() const {
  return static_cast<double>(rows_.size()) - 2.0 * static_cast<double>(stretches_.size()) - 5.0;
}

void PooledFlights::lay_tracks() {
  for (const PooledStretch& s : stretches_) {
    Track track;
    double farthest = -kInfinity;
    for (std::size_t i = s.turn.zero; i < s.turn.next && i <= s.last; ++i) {
      track.way.push_back(s.turn.direction * (smooth(i, half_) - s.rest));
      track.farthest.push_back(farthest = std::max(farthest, track.way.back()));
    }
    tracks_.push_back(std::move(track));
  }
}

std::vector<double> PooledFlights::crossings(double distance) const {
  std::vector<double> times;
  for (std::size_t p = 0; p < stretches_.size(); ++p) {
    const auto& [way, farthest] = tracks_[p];
    const auto i = static_cast<std::size_t>(std::ranges::lower_bound(farthest, distance) - farthest.begin());
    const auto at = static_cast<double>(stretches_[p].turn.zero + i);
    times.push_back(i == way.size() ? kNaN
                    : i == 0        ? at
                                    : at - (way[i] - distance) / std::max(way[i] - way[i - 1], 1e-300));
  }
  return times;
}

/// What a kink of unit strength adds to x1, without what each passage has of its own.
Eigen::VectorXd PooledFlights::kink_column(const KinkShape& shape, const std::vector<double>& times) const {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(residual_.size());
  for (std::size_t p = 0; p < stretches_.size(); ++p) {
    if (std::isnan(times[p])) continue;
    for (Eigen::Index r = begins_[p]; r < begins_[p + 1]; ++r) {
      const double since = static_cast<double>(rows_[static_cast<std::size_t>(r)].sample) - times[p];
      if (since > 0.0) column(r) = stretches_[p].turn.direction * stretches_[p].speed * shape(since);
    }
  }
  project(column);
  return column;
}

PooledKink PooledFlights::trial(const KinkShape& shape, double gap) const {
  Eigen::VectorXd column = kink_column(shape, crossings(gap));
  const double whole = column.squaredNorm();
  for (Eigen::Index c = 0; c < basis_.cols(); ++c) column -= basis_.col(c) * basis_.col(c).dot(column);
  const double left = column.squaredNorm();
  if (!(left > 1e-9 * whole)) return {shape, false, gap, 0.0, smooth_sse_};
  const double with = column.dot(residual_);
  return {shape, false, gap, with / left, std::max(smooth_sse_ - with * with / left, 0.0)};
}

PooledKink PooledFlights::best(const KinkShape& shape, double low, double high, double step) const {
  return least_sse([&](double gap) { return trial(shape, gap); }, low, high, step, 0.1 * step);
}

PooledKink PooledFlights::trial_impact(const KinkShape& shape, bool brakes, double gap) const {
  const std::vector<double> times = crossings(gap);
  std::vector<Eigen::VectorXd> columns{kink_column(shape, times)};
  if (brakes) columns.push_back(kink_column({2}, times));
  const Eigen::Index all = 3 + std::ssize(columns);
  SmallMatrix A = SmallMatrix::Zero(all, all);
  SmallVector y = SmallVector::Zero(all);
  A.topLeftCorner(3, 3) = triangle_;
  y.head(3) = along_;
  double left = smooth_sse_;
  for (Eigen::Index k = 3; k < all; ++k) {  // made orthogonal to those before it
    Eigen::VectorXd& column = columns[static_cast<std::size_t>(k - 3)];
    const double scale = std::max(column.norm(), 1e-300);
    column /= scale;
    const auto leave_out = [&](Eigen::Index c, const auto& before) {
      A(c, k) = before.dot(column);
      column -= before * A(c, k);
    };
    for (Eigen::Index c = 0; c < 3; ++c) leave_out(c, basis_.col(c));
    for (Eigen::Index c = 3; c < k; ++c) leave_out(c, columns[static_cast<std::size_t>(c - 3)]);
    A(k, k) = column.norm();
    column *= A(k, k) > 1e-5 ? 1.0 / A(k, k) : 0.0;  // what the others imitate says nothing
    y(k) = column.dot(residual_);
    left -= y(k) * y(k);
    A.col(k) *= scale;
  }
  const ConstrainedFit fit = solve_passive(A, y);
  return {shape, brakes, gap, fit.solution(3), std::max(left, 0.0) + fit.left};
}

PooledKink PooledFlights::best_impact(const KinkShape& shape, bool brakes, double low, double high,
                                      double step) const {
  return least_sse([&](double gap) { return trial_impact(shape, brakes, gap); }, low, high, step, 0.1 * step);
}

}  // namespace gapscope::internal::sliding_mode
