#include "changes/two_groups.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "changes/chance.h"

namespace gapscope::internal::changes {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kDetermined = 1e-12;  ///< eigenvalue over the largest, of columns scaled to one

/// A quadratic cost about a group's own values.
struct Square {
  double at_values = 0.0, samples = 0.0;
  Vector slope;
  Matrix normal;

  explicit Square(Index n) : slope(Vector::Zero(n)), normal(Matrix::Zero(n, n)) {}

  void add(const FitPiece& p) {
    at_values += p.square, samples += p.samples;
    for (Index i = 0, k = 0; i < slope.size(); ++i) {
      slope[i] += p.slope[i];
      for (Index j = 0; j <= i; ++j, ++k) {
        normal(i, j) += p.normal[k];
        if (i != j) normal(j, i) += p.normal[k];
      }
    }
  }
  double at(const Vector& d) const { return at_values + 2.0 * slope.dot(d) + d.dot(normal * d); }
};

/// Of a symmetric matrix, over the directions that it determines.
Matrix inverse_of(const Matrix& m) {
  const Vector scale = m.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scale.asDiagonal() * m * scale.asDiagonal());
  const double least = kDetermined * eigen.eigenvalues().maxCoeff();
  const Vector inverse = eigen.eigenvalues().unaryExpr([&](double e) { return e > least ? 1.0 / e : 0.0; });
  const Matrix v = scale.asDiagonal() * eigen.eigenvectors();
  return v * inverse.asDiagonal() * v.transpose();
}

/// A piece by some of its numbers, in another order.
FitPiece taken(const FitPiece& p, const std::vector<std::size_t>& places) {
  FitPiece t{p.recording, p.samples, p.square, {}, {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    t.slope.push_back(p.slope[places[i]]);
    for (std::size_t j = 0; j <= i; ++j) {
      const auto [least, most] = std::minmax(places[i], places[j]);
      t.normal.push_back(p.normal[most * (most + 1) / 2 + least]);
    }
  }
  return t;
}

/// What a bound holds is no number of the group; what is not compared is free in it.
Group group_of(const FitSummary& fit, const std::vector<std::string>& compared) {
  Group g{&fit, compared, {}, misfit(fit)};
  std::vector<std::string> estimated;
  for (const FittedParameter& p : fit.parameters) {
    if (!p.estimated) continue;
    estimated.push_back(p.key);
    if (!p.at_bound && std::ranges::find(compared, p.key) == compared.end()) g.keys.push_back(p.key);
  }
  std::vector<std::size_t> places;
  for (const std::string& key : g.keys)
    places.push_back(static_cast<std::size_t>(std::ranges::find(estimated, key) - estimated.begin()));
  for (const FitPiece& p : fit.pieces)
    if (p.slope.size() == estimated.size()) g.pieces.push_back(taken(p, places));
  return g;
}

/// @param side  +1: the errors above the values, −1: those below
Matrix covariance_of(const Group& g, Index compared, const Vector& side) {
  Square all(std::ssize(g.keys));
  for (const FitPiece& p : g.pieces) all.add(p);
  const Matrix c = inverse_of(all.normal).topLeftCorner(compared, compared);
  Vector times(compared);
  for (Index i = 0; i < compared; ++i) {
    const FittedParameter& p = *g.fit->find(g.keys[i]);
    const double half = side[i] > 0.0 ? p.ci95.high - p.value : p.value - p.ci95.low;
    times[i] = g.misfit * half / kNormal95 / std::sqrt(std::max(c(i, i), 1e-300));
  }
  return times.asDiagonal() * c * times.asDiagonal();
}

/// Where the numbers of both groups stand among the unknowns of a joint fit: those that may differ twice.
struct Unknowns {
  std::vector<Index> first, now;
  Index count = 0;

  Unknowns(const Group& a, const Group& b, const TwoGroups::Differ& differ) {
    for (std::size_t i = 0; i < a.keys.size(); ++i) first.push_back(count++);
    for (std::size_t i = 0; i < b.keys.size(); ++i)
      now.push_back(i < differ.size() && !differ[i] ? first[i] : count++);
  }
};

/// All pieces of a group, or all but those of a fold.
Square square_of(const Group& g, std::size_t folds, std::size_t fold, bool left_out) {
  Square s(std::ssize(g.keys));
  for (std::size_t i = 0; i < g.pieces.size(); ++i)
    if ((i % folds == fold) == left_out) s.add(g.pieces[i]);
  return s;
}

/// Adds a group's cost, its own values `ahead` of those that the unknowns begin at.
void add_to(const Square& s, double weight, const std::vector<Index>& places, const Vector& ahead,
            Matrix& normal, Vector& slope) {
  const Vector moved = s.slope - s.normal * ahead;
  for (Index i = 0; i < moved.size(); ++i) {
    slope[places[i]] += weight * moved[i];
    for (Index j = 0; j < moved.size(); ++j) normal(places[i], places[j]) += weight * s.normal(i, j);
  }
}

}  // namespace

double misfit(const FitSummary& fit) {
  const double floors = fit.innovation_rmse / fit.floor;
  return std::isfinite(floors) ? std::max(1.0, floors) : 1.0;
}

TwoGroups::TwoGroups(const FitSummary& first, const FitSummary& now, const std::vector<std::string>& compared)
    : first_(group_of(first, compared)), now_(group_of(now, compared)), compared_(std::ssize(compared)) {
  difference_.resize(compared_);
  for (Index i = 0; i < compared_; ++i) {
    const std::string& key = compared[i];
    difference_[i] = now.find(key)->value - first.find(key)->value;
  }
  if (first_.pieces.empty() || now_.pieces.empty()) return;
  covariance_ = covariance_of(first_, compared_, difference_) + covariance_of(now_, compared_, -difference_);
}

double TwoGroups::p_if_only(const Differ& differ) const {
  if (covariance_.size() == 0) return kNaN;
  const Matrix inverse = inverse_of(covariance_);
  std::vector<Index> free;
  for (Index i = 0; i < compared_; ++i)
    if (differ[i]) free.push_back(i);
  const Vector pulled = inverse * difference_;
  double sum = difference_.dot(pulled);
  if (!free.empty()) {
    const Vector of_free = pulled(free);
    sum -= of_free.dot(Matrix(inverse(free, free)).ldlt().solve(of_free));
  }
  return squares_beyond(std::max(sum, 0.0), static_cast<double>(compared_ - std::ssize(free)));
}

double TwoGroups::held_out(const Differ& differ) const {
  const std::size_t folds = std::min(first_.pieces.size(), now_.pieces.size());
  if (folds < 2) return kNaN;
  const Unknowns at(first_, now_, differ);
  const Vector none = Vector::Zero(std::ssize(first_.keys));
  Vector ahead = Vector::Zero(std::ssize(now_.keys));
  for (Index i = 0; i < compared_; ++i)
    if (!differ[i]) ahead[i] = difference_[i];
  const double a = 1.0 / (first_.misfit * first_.misfit), b = 1.0 / (now_.misfit * now_.misfit);
  double sum = 0.0, samples = 0.0;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    Matrix normal = Matrix::Zero(at.count, at.count);
    Vector slope = Vector::Zero(at.count);
    add_to(square_of(first_, folds, fold, false), a, at.first, none, normal, slope);
    add_to(square_of(now_, folds, fold, false), b, at.now, ahead, normal, slope);
    const Vector to = -inverse_of(normal) * slope;
    const Square out_first = square_of(first_, folds, fold, true),
                 out_now = square_of(now_, folds, fold, true);
    sum += a * out_first.at(to(at.first)) + b * out_now.at(Vector(to(at.now)) - ahead);
    samples += out_first.samples + out_now.samples;
  }
  return std::sqrt(sum / samples);
}

}  // namespace gapscope::internal::changes
