#include "sliding_mode/shared_law.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/require.h"
#include "gapscope/base/statistics.h"
#include "sliding_mode/least_squares.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Least squares of A·x = y with only the columns that `used` names (bit c: column c), the others at zero.
Eigen::Vector3d solve_columns(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, unsigned used) {
  Eigen::MatrixXd some = A;
  for (int c = 0; c < 3; ++c)
    if (!(used >> c & 1u)) some.col(c).setZero();
  return least_squares_of(some, y);
}

/// Of the motion from sample i to the next, in the mean.
double sign_from(const LawStretch& s, std::size_t i) {
  return s.direction * std::clamp(2.0 * (static_cast<double>(i) + 1.0 - s.reversal) - 1.0, -1.0, 1.0);
}

}  // namespace

SharedLaw::SharedLaw(const MotorTrace& trace, std::vector<LawStretch> stretches, Friction friction)
    : trace_(&trace), friction_(friction), stretches_(std::move(stretches)) {
  GAPSCOPE_REQUIRE(!stretches_.empty());
  for (const LawStretch& s : stretches_) reduced_.push_back(reduce(s));
  solve(std::vector<bool>(stretches_.size(), true));
}

SharedLaw SharedLaw::without(std::size_t group, std::size_t groups) const {
  std::vector<bool> used(stretches_.size(), true);
  for (std::size_t k = group; k < used.size(); k += groups) used[k] = false;
  SharedLaw rest = *this;
  rest.solve(used);
  return rest;
}

/// From sample i to the next.
void SharedLaw::advance(const LawStretch& s, std::size_t i, Integrals& at) const {
  const double dt = trace_->dt, u = trace_->u[i], sign = sign_from(s, i);
  at.u2 += (at.u1 + 0.5 * u * dt) * dt, at.u1 += u * dt;
  at.s2 += (at.s1 + 0.5 * sign * dt) * dt, at.s1 += sign * dt;
  at.x += (0.5 * (trace_->x1[i] + trace_->x1[i + 1]) - trace_->x1[s.first]) * dt;
}

SharedLaw::Reduced SharedLaw::reduce(const LawStretch& s) const {
  const std::size_t n = s.last - s.first + 1;
  GAPSCOPE_REQUIRE(n >= kFewestRows);
  Eigen::MatrixXd A(static_cast<Eigen::Index>(n), kAll);
  Integrals at;
  for (std::size_t i = s.first; i <= s.last; ++i) {
    const auto r = static_cast<Eigen::Index>(i - s.first);
    A.row(r) << 1.0, static_cast<double>(r) * trace_->dt, at.u2, at.x, at.s2,
        trace_->x1[i] - trace_->x1[s.first];
    if (i < s.last) advance(s, i, at);
  }
  return triangle_of(A);
}

void SharedLaw::solve(const std::vector<bool>& used) {
  constexpr int kRows = kAll - kLocal;
  const auto count = std::count(used.begin(), used.end(), true);
  GAPSCOPE_REQUIRE(count > 0);
  Eigen::MatrixXd A(kRows * count, kShared);
  Eigen::VectorXd y(A.rows());
  Eigen::Index at = 0;
  double freedom = -kShared;
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (!used[k]) continue;
    A.middleRows(at, kRows) = reduced_[k].template block<kRows, kShared>(kLocal, kLocal);
    y.segment(at, kRows) = reduced_[k].template block<kRows, 1>(kLocal, kAll - 1);
    at += kRows;
    freedom += static_cast<double>(stretches_[k].last - stretches_[k].first + 1) - kLocal;
  }
  const Eigen::Vector3d scale = A.colwise().norm().transpose().cwiseMax(1e-300);
  A = A * scale.cwiseInverse().asDiagonal();
  Eigen::Vector3d scaled = solve_columns(A, y, 0b111);
  if (friction_ == Friction::kPassive && !(scaled(1) <= 0.0 && scaled(2) <= 0.0)) {
    double least = kInfinity;
    for (const unsigned columns : {0b101u, 0b011u, 0b001u}) {
      const Eigen::Vector3d some = solve_columns(A, y, columns);
      const double left = (A * some - y).norm();
      if (some(1) <= 0.0 && some(2) <= 0.0 && left < least) least = left, scaled = some;
    }
  }
  rms_ = (A * scaled - y).norm() / std::sqrt(freedom);
  shared_ = scaled.cwiseQuotient(scale);
}

double SharedLaw::own_rms(std::size_t stretch) const {
  const LawStretch& s = stretches_[stretch];
  const double freedom = static_cast<double>(s.last - s.first + 1) - kLocal - kShared;
  return std::abs(reduced_[stretch](kAll - 1, kAll - 1)) / std::sqrt(freedom);
}

SharedLaw::State SharedLaw::state(std::size_t stretch, double time) const {
  const LawStretch& s = stretches_[stretch];
  const Reduced& R = reduced_[stretch];
  const Eigen::Vector2d left = R.topRightCorner<kLocal, 1>() - R.block<kLocal, kShared>(0, kLocal) * shared_;
  const double speed = left(1) / R(1, 1), place = (left(0) - R(0, 1) * speed) / R(0, 0);
  const auto nearest = static_cast<std::size_t>(std::lround(std::max(time, 0.0)));
  const std::size_t end = std::clamp(nearest, s.first, s.last);
  Integrals at;
  for (std::size_t i = s.first; i < end; ++i) advance(s, i, at);
  const double dt = trace_->dt, since = static_cast<double>(end - s.first) * dt;
  State state;
  const double moved = place + speed * since + shared_.dot(Eigen::Vector3d(at.u2, at.x, at.s2));
  state.speed = speed + shared_.dot(Eigen::Vector3d(at.u1, moved, at.s1));
  const double late = (time - static_cast<double>(end)) * dt;
  const double acceleration = shared_.dot(Eigen::Vector3d(trace_->u[end], state.speed, sign_from(s, end)));
  state.position = trace_->x1[s.first] + moved + (state.speed + 0.5 * acceleration * late) * late;
  state.speed += acceleration * late;
  return state;
}

}  // namespace gapscope::internal::sliding_mode
