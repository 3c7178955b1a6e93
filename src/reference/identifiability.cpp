#include "reference/identifiability.h"

#include <algorithm>
#include <cmath>

#include "reference/words.h"

namespace gapscope::internal::reference {
namespace {

constexpr double kShareInCombination = 0.05;  ///< of the largest change, for a parameter to be named
constexpr double kLeastKnown = 10.0;          ///< relative errors this many times the least one are told
constexpr double kWorthAdvice = 0.05;         ///< relative error below which no advice could matter

/// The free numbers that the recordings see at all, and those among them that no null direction touches.
struct Directions {
  std::vector<Eigen::Index> seen;
  std::vector<bool> in_null;  ///< per free number
  Eigen::MatrixXd inverse;  ///< of the normal matrix within the determined directions (n × n), zero elsewhere
};

/// The standard error that a parameter would have if all others were known [its unit].
double error_alone(const FitProblem& problem, const FitPoint& at, const Information& info, std::size_t i) {
  const auto k = static_cast<Eigen::Index>(i);
  const double slope = problem.free_parameter(i).coordinate.slope(at.q[i]);
  return slope * std::sqrt(info.variance / std::max(info.normal(k, k), 1e-300));
}

double size_of(const FitProblem& problem, const FitPoint& at, std::size_t i) {
  const Parameter& p = problem.free_parameter(i);
  return std::max(p.typical, std::abs(p.coordinate.physical(at.q[i])));
}

/// Names the parameters of one null direction v (normalised columns) and marks them: those that change by a
/// share of the largest relative change among the well visible ones.
void mark_null(const FitProblem& problem, const FitPoint& at, const Eigen::VectorXd& v,
               const Eigen::VectorXd& norm, Directions& directions, Determination& determined) {
  std::vector<std::string> keys;
  std::vector<double> changes;  // relative
  double largest = 0.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (std::abs(v[i]) > kShareInCombination * v.cwiseAbs().maxCoeff())
      largest = std::max(largest, std::abs(v[i]) / norm[i]);
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const auto k = static_cast<std::size_t>(directions.seen[i]);
    if (std::abs(v[i]) / norm[i] < kShareInCombination * largest) continue;
    directions.in_null[k] = true;
    if (k >= problem.free_count()) continue;
    keys.push_back(problem.free_parameter(k).key);
    const Coordinate& c = problem.free_parameter(k).coordinate;
    changes.push_back(v[i] / norm[i] * c.slope(at.q[k]) / c.physical(at.q[k]));
  }
  if (keys.empty()) return;
  determined.warnings.push_back(keys.size() == 1 ? words::like_initial_state(keys[0])
                                                 : words::change_together(keys, changes));
}

Directions directions_of(const FitProblem& problem, const FitPoint& at, const Information& info,
                         Determination& determined) {
  Directions d;
  const Eigen::Index n = info.normal.rows();
  d.in_null.assign(static_cast<std::size_t>(n), false);
  d.inverse = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (static_cast<std::size_t>(k) >= problem.free_count() || determined.identifiable[k])
      d.seen.push_back(k);
  const auto m = static_cast<Eigen::Index>(d.seen.size());
  if (m == 0) return d;
  Eigen::MatrixXd scaled(m, m);
  Eigen::VectorXd norm(m);
  for (Eigen::Index i = 0; i < m; ++i) norm[i] = std::sqrt(info.normal(d.seen[size_t(i)], d.seen[size_t(i)]));
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j)
      scaled(i, j) = info.normal(d.seen[size_t(i)], d.seen[size_t(j)]) / (norm[i] * norm[j]);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const double least = eigen.eigenvalues()[m - 1] / problem.options.max_condition;
  for (Eigen::Index e = 0; e < m; ++e) {
    const Eigen::VectorXd v = eigen.eigenvectors().col(e);
    if (eigen.eigenvalues()[e] < least) {
      mark_null(problem, at, v, norm, d, determined);
      continue;
    }
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < m; ++j)
        d.inverse(d.seen[size_t(i)], d.seen[size_t(j)]) +=
            v[i] * v[j] / (norm[i] * norm[j] * eigen.eigenvalues()[e]);
  }
  return d;
}

/// The parameter that another one is confounded with most; empty below a correlation of 0.95.
std::string partner(const FitProblem& problem, const Eigen::MatrixXd& inverse, std::size_t i) {
  double strongest = 0.95;
  std::string key;
  for (std::size_t j = 0; j < problem.free_count(); ++j) {
    const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
    const double r = std::abs(inverse(a, b)) / std::sqrt(inverse(a, a) * inverse(b, b));
    if (j == i || !(r > strongest)) continue;
    strongest = r;
    key = problem.free_parameter(j).key;
  }
  return key;
}

void judge(const FitProblem& problem, const FitPoint& at, const Directions& d, std::size_t i, double std,
           Determination& determined) {
  const Parameter& p = problem.free_parameter(i);
  if (d.in_null[i]) {
    determined.identifiable[i] = false;
  } else if (!(std < size_of(problem, at, i))) {
    const std::string with = partner(problem, d.inverse, i);
    determined.identifiable[i] = false;
    determined.warnings.push_back(words::not_determined(p.key, std, p.unit, with));
  } else {
    determined.std[i] = std;
  }
}

/// The worse half of the parameters that are known at all, where that is much worse than the best.
void advise(const FitProblem& problem, const FitPoint& at, Determination& determined) {
  const auto relative = [&](std::size_t i) { return determined.std[i] / size_of(problem, at, i); };
  std::vector<double> all;
  for (std::size_t i = 0; i < determined.std.size(); ++i)
    if (determined.identifiable[i]) all.push_back(relative(i));
  const double least = quantile(all, 0.0), middle = median(all);
  for (std::size_t i = 0; i < determined.std.size(); ++i) {
    if (!determined.identifiable[i] || !(relative(i) > std::max({middle, kLeastKnown * least, kWorthAdvice})))
      continue;
    determined.advice.push_back(words::little_known(problem.free_parameter(i).key, 100.0 * relative(i)));
  }
}

}  // namespace

Determination determine(const FitProblem& problem, const FitPoint& at, const Information& info,
                        const std::vector<double>& shift) {
  const std::size_t n = problem.free_count();
  Determination determined;
  determined.std = determined.own = determined.linear = determined.timing = std::vector<double>(n, kNaN);
  determined.identifiable.assign(n, info.valid);
  if (!info.valid) {
    for (std::size_t i = 0; i < n; ++i)
      determined.warnings.push_back(words::no_information(problem.free_parameter(i).key));
    return determined;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (error_alone(problem, at, info, i) < size_of(problem, at, i)) continue;
    determined.identifiable[i] = false;
    determined.warnings.push_back(words::no_trace(problem.free_parameter(i).key));
  }
  const Directions d = directions_of(problem, at, info, determined);
  for (std::size_t i = 0; i < n; ++i) {
    if (!determined.identifiable[i]) continue;
    const double slope = problem.free_parameter(i).coordinate.slope(at.q[i]);
    const auto k = static_cast<Eigen::Index>(i);
    determined.own[i] = slope * std::sqrt(variance_along(info, d.inverse.col(k), d.inverse(k, k)));
    determined.linear[i] = slope * std::sqrt(d.inverse(k, k));
    determined.timing[i] =
        info.by_timing.size() == 0 ? 0.0 : std::abs(slope * info.by_timing[k]) * info.timing.open_rows();
    const double std = std::hypot(determined.own[i], shift.empty() ? 0.0 : shift[i], determined.timing[i]);
    judge(problem, at, d, i, std, determined);
  }
  advise(problem, at, determined);
  return determined;
}

}  // namespace gapscope::internal::reference
