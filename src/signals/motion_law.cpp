#include "signals/motion_law.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "signals/least_squares.h"

namespace gapscope::internal::signals {

LawColumns::LawColumns(const MotorTrace& trace, const LawStretch& stretch, const PlaceTerms& place)
    : trace_(&trace), stretch_(stretch), place_(place) {
  const auto n = static_cast<Eigen::Index>(stretch.last - stretch.first + 1);
  once_ = twice_ = Rows::Zero(n, kOfMotor + place.powers);
  const double dt = trace.dt, origin = trace.x1[stretch.first];
  for (Eigen::Index k = 1; k < n; ++k) {
    const std::size_t i = stretch.first + static_cast<std::size_t>(k);
    const Row held = now(i - 1);
    twice_.row(k) = twice_.row(k - 1) + (once_.row(k - 1) + 0.5 * dt * held) * dt;
    once_.row(k) = once_.row(k - 1) + held * dt;
    // The speed is no sample: ẋ1 is x1 once, and its trapezoid twice.
    once_(k, 1) = trace.x1[i] - origin;
    twice_(k, 1) = twice_(k - 1, 1) + 0.5 * (once_(k - 1, 1) + once_(k, 1)) * dt;
  }
}

/// Of the motion from sample i to the next, in the mean.
double LawColumns::sign_from(std::size_t i) const {
  const double behind = std::clamp(2.0 * (static_cast<double>(i) + 1.0 - stretch_.turn) - 1.0, -1.0, 1.0);
  if (!(stretch_.bend > 0.0) || behind < 0.0 || stretch_.turn <= static_cast<double>(stretch_.first))
    return stretch_.direction * behind;
  const auto turn = static_cast<std::size_t>(std::lround(stretch_.turn));
  const auto& x = trace_->x1;
  const double way = std::abs(0.5 * (x[i] + x[std::min(i + 1, x.size() - 1)]) - x[turn]);
  return stretch_.direction * (1.0 - 2.0 * std::exp(-way / stretch_.bend));
}

/// What accelerates between sample i and the next: u, (the speed), the sign, powers of the place.
LawColumns::Row LawColumns::now(std::size_t i) const {
  Row held(kOfMotor + place_.powers);
  held.head(kOfMotor) << trace_->u[i], 0.0, sign_from(i);
  const double x = 0.5 * (trace_->x1[i] + trace_->x1[std::min(i + 1, trace_->size() - 1)]);
  double power = 1.0;
  for (int k = 0; k < place_.powers; ++k, power *= (x - place_.centre) / place_.half)
    held(kOfMotor + k) = power;
  return held;
}

Eigen::MatrixXd LawColumns::rows(std::size_t first, std::size_t last, std::size_t stride) const {
  Eigen::MatrixXd A(static_cast<Eigen::Index>((last - first) / stride + 1), count());
  for (Eigen::Index r = 0; r < A.rows(); ++r) {
    const auto k = static_cast<Eigen::Index>(first - stretch_.first) + r * static_cast<Eigen::Index>(stride);
    A(r, kPlace) = 1.0, A(r, kSpeed) = static_cast<double>(k) * trace_->dt;
    A.row(r).tail(twice_.cols()) = twice_.row(k);
  }
  return A;
}

Eigen::VectorXd LawColumns::positions(std::size_t first, std::size_t last, std::size_t stride) const {
  Eigen::VectorXd y(static_cast<Eigen::Index>((last - first) / stride + 1));
  for (Eigen::Index r = 0; r < y.size(); ++r)
    y(r) = trace_->x1[first + static_cast<std::size_t>(r) * stride] - trace_->x1[stretch_.first];
  return y;
}

MotorState LawColumns::state(const Eigen::VectorXd& numbers, double time) const {
  const auto nearest = static_cast<std::size_t>(std::lround(std::max(time, 0.0)));
  const std::size_t i = std::clamp(nearest, stretch_.first, stretch_.last);
  const auto k = static_cast<Eigen::Index>(i - stretch_.first);
  const auto shared = numbers.segment(kOwn, once_.cols());
  const double t = static_cast<double>(k) * trace_->dt;
  const double late = (time - static_cast<double>(i)) * trace_->dt;
  MotorState s;
  const double moved = numbers(kPlace) + numbers(kSpeed) * t + twice_.row(k).dot(shared);
  s.speed = numbers(kSpeed) + once_.row(k).dot(shared) + numbers(kViscous) * (moved - once_(k, 1));
  s.acceleration = now(i).dot(shared) + numbers(kViscous) * s.speed;
  s.position = trace_->x1[stretch_.first] + moved + (s.speed + 0.5 * s.acceleration * late) * late;
  s.speed += s.acceleration * late;
  return s;
}

MotionLaw::MotionLaw(const MotorTrace& trace, std::vector<LawStretch> stretches, Friction friction,
                     const PlaceTerms& place)
    : trace_(&trace), friction_(friction), place_(place), stretches_(std::move(stretches)) {
  GAPSCOPE_REQUIRE(!stretches_.empty());
  for (const LawStretch& s : stretches_) {
    GAPSCOPE_REQUIRE(s.last + 1 >= s.first + kFewestRows);
    const LawColumns columns(trace, s, place);
    Eigen::MatrixXd A(static_cast<Eigen::Index>(s.last - s.first + 1), columns.count() + 1);
    A << columns.rows(s.first, s.last), columns.positions(s.first, s.last);
    reduced_.push_back(triangle_of(A));
  }
  solve(std::vector<bool>(stretches_.size(), true));
}

MotionLaw MotionLaw::without(std::size_t group, std::size_t groups) const {
  std::vector<bool> used(stretches_.size(), true);
  for (std::size_t k = group; k < used.size(); k += groups) used[k] = false;
  MotionLaw rest = *this;
  rest.solve(used);
  return rest;
}

void MotionLaw::solve(const std::vector<bool>& used) {
  constexpr Eigen::Index kOwn = LawColumns::kOwn;
  const Eigen::Index rows = reduced_.front().rows() - kOwn, shared = rows - 1;
  const auto count = std::count(used.begin(), used.end(), true);
  GAPSCOPE_REQUIRE(count > 0);
  Eigen::MatrixXd A(rows * count, shared);
  Eigen::VectorXd y(A.rows());
  Eigen::Index at = 0;
  freedom_ = -static_cast<double>(shared);
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (!used[k]) continue;
    A.middleRows(at, rows) = reduced_[k].block(kOwn, kOwn, rows, shared);
    y.segment(at, rows) = reduced_[k].block(kOwn, kOwn + shared, rows, 1);
    at += rows;
    freedom_ += static_cast<double>(stretches_[k].last - stretches_[k].first + 1 - kOwn);
  }
  shared_ = friction_ == Friction::kPassive ? least_squares_at_most_zero(A, y, 1, 2) : least_squares_of(A, y);
  squares_ = (A * shared_ - y).squaredNorm();
}

double MotionLaw::force(double x1) const {
  double sum = 0.0;
  for (int k = place_.powers; k-- > 0;)
    sum = sum * (x1 - place_.centre) / place_.half + shared_(LawColumns::kOfMotor + k);
  return sum;
}

double MotionLaw::rms() const { return std::sqrt(squares_ / freedom_); }

double MotionLaw::own_rms(std::size_t stretch) const {
  const LawStretch& s = stretches_[stretch];
  const Eigen::MatrixXd& R = reduced_[stretch];
  const double freedom = static_cast<double>(s.last - s.first + 1) - static_cast<double>(R.cols() - 1);
  return std::abs(R(R.cols() - 1, R.cols() - 1)) / std::sqrt(freedom);
}

MotorState MotionLaw::state(std::size_t stretch, double time) const {
  const Eigen::MatrixXd& R = reduced_[stretch];
  Eigen::VectorXd numbers(LawColumns::kOwn + shared_.size());
  numbers.tail(shared_.size()) = shared_;
  const Eigen::Vector2d own = R.topRightCorner(2, 1) - R.block(0, 2, 2, shared_.size()) * shared_;
  numbers(LawColumns::kSpeed) = own(1) / R(1, 1);
  numbers(LawColumns::kPlace) = (own(0) - R(0, 1) * numbers(LawColumns::kSpeed)) / R(0, 0);
  return LawColumns(*trace_, stretches_[stretch], place_).state(numbers, time);
}

}  // namespace gapscope::internal::signals
