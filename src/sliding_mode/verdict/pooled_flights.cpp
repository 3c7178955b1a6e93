#include "sliding_mode/verdict/pooled_flights.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "signals/least_squares.h"
#include "signals/motion_law.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kFrom = 0.1, kTo = 1.2;  ///< of the gap that is tried
constexpr double kRest = 0.12;            ///< of the flight, to either side of the zero of the torque
constexpr double kWide = 0.08;            ///< … that x1 is averaged over where it turns round
constexpr std::size_t kMostRows = 3000;
constexpr double kImitated = 1e-5;  ///< of a column that the others make up: it says nothing

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns * scale.cwiseInverse().asDiagonal());
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

}  // namespace

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

/// Takes out of columns what each passage has of its own.
void PooledFlights::take_own(Eigen::Ref<Eigen::MatrixXd> columns) const {
  for (std::size_t p = 0; p + 1 < begins_.size(); ++p) {
    const Eigen::Index n = begins_[p + 1] - begins_[p];
    const auto own = own_.middleRows(begins_[p], n);
    columns.middleRows(begins_[p], n) -= own * (own.transpose() * columns.middleRows(begins_[p], n));
  }
}

/// 1 and t of each passage for itself; what the numbers of the law multiply for all.
void PooledFlights::lay_columns() {
  constexpr int kOwn = signals::LawColumns::kOwn, kShared = signals::LawColumns::kOfMotor;
  std::size_t all = 0;
  for (const PooledStretch& s : stretches_) all += s.last - s.first + 1;
  stride_ = std::max<std::size_t>(1, (all + kMostRows - 1) / kMostRows);
  begins_.push_back(0);
  for (const PooledStretch& s : stretches_)
    begins_.push_back(begins_.back() + static_cast<Eigen::Index>((s.last - s.first) / stride_ + 1));
  own_.resize(begins_.back(), kOwn);
  residual_.resize(begins_.back());
  Eigen::MatrixXd shared(begins_.back(), kShared);
  for (std::size_t p = 0; p < stretches_.size(); ++p) {
    const PooledStretch& s = stretches_[p];
    const Eigen::Index n = begins_[p + 1] - begins_[p];
    const signals::LawColumns law(trace_, {s.first, s.last, static_cast<double>(s.first), s.turn.direction});
    const Eigen::MatrixXd rows = law.rows(s.first, s.last, stride_);
    own_.middleRows(begins_[p], n) = orthonormal(rows.leftCols(kOwn));
    shared.middleRows(begins_[p], n) = rows.rightCols(kShared);
    residual_.segment(begins_[p], n) = law.positions(s.first, s.last, stride_);
  }
  take_own(shared);
  take_own(residual_);
  basis_ = orthonormal(shared);
  made_ = basis_.transpose() * shared;
  along_ = basis_.transpose() * residual_;
  residual_ -= basis_ * along_;
  smooth_sse_ = residual_.squaredNorm();
}

double PooledFlights::freedom() const {
  return static_cast<double>(residual_.size()) - 2.0 * static_cast<double>(stretches_.size()) - 5.0;
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
    const PooledStretch& s = stretches_[p];
    const auto stride = static_cast<double>(stride_);
    const double since = (times[p] - static_cast<double>(s.first)) / stride;  // rows
    if (!(since < static_cast<double>(begins_[p + 1] - begins_[p]))) continue;
    const double begin = std::max(std::ceil(since), 0.0);
    ShapeWalk walk(shape, (begin - since) * stride, stride);
    for (Eigen::Index r = begins_[p] + static_cast<Eigen::Index>(begin); r < begins_[p + 1]; ++r)
      column(r) = s.turn.direction * s.speed * walk.next();
  }
  take_own(column);
  return column;
}

PooledKink PooledFlights::trial(const KinkShape& shape, Onset onset, double gap) const {
  const std::vector<double> times = crossings(gap);
  const Eigen::Index kinks = onset == Onset::kBraked ? 2 : 1, law = made_.cols(), basis = basis_.cols();
  Eigen::MatrixXd columns(residual_.size(), kinks + 1);
  columns.col(0) = kink_column(shape, times);
  if (kinks > 1) columns.col(1) = kink_column({2}, times);
  columns.col(kinks) = residual_;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(basis + kinks, law + kinks);
  Eigen::VectorXd y(A.rows());
  A.topLeftCorner(basis, law) = made_;
  A.topRightCorner(basis, kinks) = basis_.transpose() * columns.leftCols(kinks);
  const Eigen::VectorXd whole = columns.leftCols(kinks).colwise().norm();
  columns.leftCols(kinks) -= basis_ * A.topRightCorner(basis, kinks);
  const Eigen::MatrixXd R = signals::triangle_of(columns);
  A.bottomRightCorner(kinks, kinks) = R.topLeftCorner(kinks, kinks);
  for (Eigen::Index k = 0; k < kinks; ++k)
    if (!(R.col(k).head(kinks).norm() > kImitated * whole(k)))
      A.bottomRightCorner(kinks, kinks).col(k).setZero();
  y << along_, R.col(kinks).head(kinks);
  const Eigen::VectorXd numbers = onset == Onset::kAny
                                      ? signals::least_squares_of(A, y)
                                      : signals::least_squares_at_most_zero(A, y, 1, law - 1 + kinks);
  const double left = (A * numbers - y).squaredNorm() + R(kinks, kinks) * R(kinks, kinks);
  return {shape, onset == Onset::kBraked, gap, numbers(law), left};
}

PooledKink PooledFlights::best(const KinkShape& shape, Onset onset, double low, double high,
                               double step) const {
  return least_sse([&](double gap) { return trial(shape, onset, gap); }, low, high, step, 0.1 * step);
}

}  // namespace gapscope::internal::sliding_mode
