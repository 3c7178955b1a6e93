#include "signals/one_body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/local_motion.h"
#include "signals/strokes.h"

namespace gapscope::internal::signals {
namespace {

constexpr std::size_t kRows = 500;  ///< of the balance, per recording

/// Least-squares slope over uneven steps.
double slope_over_stamps(std::span<const double> t, std::span<const double> x) {
  const double centre = mean(t);
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    sum += (t[i] - centre) * x[i];
    weight += (t[i] - centre) * (t[i] - centre);
  }
  return sum / weight;
}

/// Least-squares slope of x1 over n samples from `first`.
double slope(const MotorTrace& r, std::size_t first, std::size_t n) {
  if (!r.even()) return slope_over_stamps(r.stamps.subspan(first, n), r.x1.subspan(first, n));
  const double centre = 0.5 * static_cast<double>(n - 1);
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) - centre;
    sum += t * r.x1[first + i];
    weight += t * t;
  }
  return sum / (weight * r.dt);
}

/// x1 without the straight line that it follows best [rad].
std::vector<double> beside_a_line(const MotorTrace& r) {
  const double speed = slope(r, 0, r.size());
  std::vector<double> beside(r.x1.begin(), r.x1.end());
  for (std::size_t i = 0; i < beside.size(); ++i) beside[i] -= speed * (r.time(i) - r.time(0));
  return beside;
}

/// Torques beside the four of one body, each at every sample of one recording.
template <int N>
using Beside = std::array<std::span<const double>, N - 4>;

/// Rows of the balance of one recording, with a constant of integration of its own; N: 4 and what is beside.
template <int N>
struct Balance {
  std::vector<std::array<double, N>> rows;  ///< w, x, ∫sign w, t, ∫ of what is beside
  std::vector<double> impulse;              ///< ∫u
};

/// Time from `stride` samples before a sample to it [s].
double time_before(const MotorTrace& r, std::size_t sample, std::size_t stride) {
  if (r.even()) return static_cast<double>(stride) * r.dt;
  return r.stamps[sample] - r.stamps[sample - stride];
}

template <int N>
Balance<N> balance_of(const MotorTrace& r, const Beside<N>& beside) {
  Balance<N> b;
  const std::size_t n = speed_window(r);
  const std::size_t stride = std::max<std::size_t>(1, (r.size() - n) / kRows);
  double impulse = 0.0, direction = 0.0;
  std::array<double, N - 4> momentum{};
  std::size_t done = 0;
  for (std::size_t first = 0; first + n <= r.size(); first += stride) {
    const double w = slope(r, first, n);
    const std::size_t centre = first + n / 2;
    for (; done < centre; ++done) {
      impulse += r.u[done] * r.step(done);
      for (std::size_t j = 0; j < beside.size(); ++j) momentum[j] += beside[j][done] * r.step(done);
    }
    if (first > 0) direction += (w > 0.0 ? 1.0 : w < 0.0 ? -1.0 : 0.0) * time_before(r, centre, stride);
    b.rows.push_back({w, r.x1[centre] - r.x1[0], direction, r.elapsed(centre)});
    std::copy(momentum.begin(), momentum.end(), b.rows.back().begin() + 4);
    b.impulse.push_back(impulse);
  }
  return b;
}

/// Means over one recording removed: its constant of integration.
template <int N>
void centre(Balance<N>& b) {
  std::array<double, N> sums{};
  double total = 0.0;
  const double count = static_cast<double>(b.rows.size());
  for (std::size_t i = 0; i < b.rows.size(); ++i) {
    for (std::size_t j = 0; j < N; ++j) sums[j] += b.rows[i][j] / count;
    total += b.impulse[i] / count;
  }
  for (std::size_t i = 0; i < b.rows.size(); ++i) {
    for (std::size_t j = 0; j < N; ++j) b.rows[i][j] -= sums[j];
    b.impulse[i] -= total;
  }
}

/// The balance of several recordings, solved.
template <int N>
struct Solved {
  OneBody body;
  Eigen::Matrix<double, N, 1> solution;  ///< one number for each column of the rows
  double left = 0.0;                     ///< Σ of the squares that no column explains
};

/// @param beside of each recording
template <int N>
Solved<N> balanced(std::span<const MotorTrace> recordings, std::span<const Beside<N>> beside) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  OneBody body;
  Matrix normal = Matrix::Zero();
  Vector right = Vector::Zero();
  double squares = 0.0, count = 0.0, brought = 0.0;
  std::vector<double> ways;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const MotorTrace& r = recordings[k];
    Balance<N> b = balance_of<N>(r, beside[k]);
    for (const auto& row : b.rows) {
      squares += row[0] * row[0];
      body.peak_speed = std::max(body.peak_speed, std::abs(row[0]));
    }
    count += static_cast<double>(b.rows.size());
    centre(b);
    for (std::size_t i = 0; i < b.rows.size(); ++i) {
      const Eigen::Map<const Vector> row(b.rows[i].data());
      normal += row * row.transpose();
      right += row * b.impulse[i];
      brought += b.impulse[i] * b.impulse[i];
    }
    const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
    body.travel = std::max(body.travel, *high - *low);
    std::ranges::copy(strokes(beside_a_line(r)), std::back_inserter(ways));
    for (const double u : r.u) body.peak_input = std::max(body.peak_input, std::abs(u));
  }
  body.stroke = ways.empty() ? body.travel : median(ways);
  body.speed = std::sqrt(squares / std::max(1.0, count));
  const Vector scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Matrix scaled = scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
  const auto solver = (scaled + 1e-9 * Matrix::Identity()).ldlt();
  const Vector solution = solver.solve(right.cwiseQuotient(scale)).cwiseQuotient(scale);
  const double alone = scale[0] * scale[0] / solver.solve(Vector::Unit(0))[0];  // Σ of w² beyond the others
  const double left = std::max(brought - solution.dot(right), 1e-18 * brought);
  if (left > 0.0) body.inertia_over_left = std::abs(solution[0]) * std::sqrt(alone / left);
  body.inertia = solution[0];
  body.damping = solution[1];
  body.friction = solution[2];
  return {body, solution, left};
}

}  // namespace

OneBody as_one_body(std::span<const MotorTrace> recordings) {
  return balanced<4>(recordings, std::vector<Beside<4>>(recordings.size())).body;
}

OneBody as_one_body(std::span<const MotorTrace> recordings, std::span<const std::vector<double>> known) {
  const std::vector<Beside<5>> beside = [&] {
    std::vector<Beside<5>> all;
    for (const std::vector<double>& one : known) all.push_back({one});
    return all;
  }();
  Solved<5> solved = balanced<5>(recordings, beside);
  solved.body.known = solved.solution[4];
  return solved.body;
}

HangingArm hanging_arm(const MotorTrace& recording) {
  std::vector<double> sines, cosines;
  for (const double x : recording.x1) sines.push_back(std::sin(x)), cosines.push_back(std::cos(x));
  const std::span<const MotorTrace> all(&recording, 1);
  const Beside<6> beside{sines, cosines};
  const Solved<6> with = balanced<6>(all, std::span(&beside, 1));
  const Solved<4> without = balanced<4>(all, std::vector<Beside<4>>(1));
  const double sine = with.solution[4], cosine = with.solution[5];
  return {std::atan2(-cosine, sine), std::hypot(sine, cosine), with.body.inertia, with.left / without.left};
}

}  // namespace gapscope::internal::signals
