#include "inspection/balance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::inspection {
namespace {

constexpr std::size_t kFewestWindows = 20;
constexpr std::size_t kMostWindows = 1000;  ///< of a long recording so many are enough
constexpr double kStands = 1.5;             ///< counts from row to row, below which x1 stands
constexpr double kSwing = 0.3;              ///< [rad] from which on gravity turns visibly

/// The bump s³(1−s)³ and its first two derivatives by s.
double bump(double s) { return std::pow(s * (1.0 - s), 3); }
double first_of_bump(double s) { return 3.0 * std::pow(s * (1.0 - s), 2) * (1.0 - 2.0 * s); }
double second_of_bump(double s) {
  const double a = s * (1.0 - s), b = 1.0 - 2.0 * s;
  return 6.0 * a * (b * b - a);
}

double sign_of(double x, double least) { return x > least ? 1.0 : x < -least ? -1.0 : 0.0; }

}  // namespace

Balance::Balance(const MotorTrace& r, std::size_t window) : window_(window) {
  const std::size_t margin = kMostMovedRows + 1;
  const double length = r.dt * static_cast<double>(window);
  if (r.size() < window + 2 * margin) return;
  const std::size_t room = r.size() - window - 2 * margin;
  const std::size_t stride = std::max({std::size_t{1}, window / 4, room / kMostWindows});
  for (std::size_t from = margin; from < margin + room; from += stride) starts_.push_back(from);
  std::vector<double> value(window), first(window), second(window);
  for (std::size_t i = 0; i < window; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(window);
    value[i] = bump(s), first[i] = first_of_bump(s) / length,
    second[i] = second_of_bump(s) / (length * length);
    between_.push_back(bump(s + 0.5 / static_cast<double>(window)));
  }
  const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
  const bool turns = *high - *low > kSwing;
  const double least = kStands * r.quantum;
  motion_.assign(turns ? 6 : 4, {});
  of_speed_.assign(4, {});
  for (const std::size_t from : starts_) {
    double m[6] = {}, v[4] = {};
    for (std::size_t i = 0; i < window; ++i) {
      const double x = r.x1[from + i], offset = x - r.x1[from];
      m[0] += second[i] * offset, m[1] -= first[i] * offset, m[3] += between_[i];
      m[2] += value[i] * sign_of(r.x1[from + i + 1] - r.x1[from + i - 1], least);
      if (turns) m[4] += between_[i] * std::sin(x), m[5] += between_[i] * std::cos(x);
      v[0] -= first[i] * offset, v[1] += value[i] * x, v[2] += value[i] * sign_of(x, least),
          v[3] += between_[i];
    }
    for (std::size_t j = 0; j < motion_.size(); ++j) motion_[j].push_back(m[j]);
    for (std::size_t j = 0; j < of_speed_.size(); ++j) of_speed_[j].push_back(v[j]);
  }
}

std::vector<double> Balance::bumped(std::span<const double> u, int rows) const {
  std::vector<double> out;
  for (const std::size_t from : starts_) {
    double sum = 0.0;
    for (std::size_t i = 0; i < window_; ++i)
      sum += between_[i] * u[from + i - static_cast<std::size_t>(rows)];
    out.push_back(sum);
  }
  return out;
}

namespace {

struct BestFit {
  double share_left = kNaN;
  Eigen::VectorXd fitted, factors;  ///< of each window; of each column over its norm
};

BestFit best_fit(const std::vector<std::vector<double>>& columns, const std::vector<double>& u) {
  if (u.size() < kFewestWindows) return {};
  const auto rows = static_cast<Eigen::Index>(u.size());
  Eigen::MatrixXd a(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Eigen::Map<const Eigen::VectorXd> column(columns[j].data(), rows);
    const double norm = column.norm();
    a.col(static_cast<Eigen::Index>(j)) =
        norm > 0.0 ? Eigen::VectorXd(column / norm) : Eigen::VectorXd(column);
  }
  const Eigen::Map<const Eigen::VectorXd> y(u.data(), rows);
  const double all = (y.array() - y.mean()).square().sum();
  const Eigen::VectorXd factors = a.colPivHouseholderQr().solve(y), fitted = a * factors;
  return {all > 0.0 ? (y - fitted).squaredNorm() / all : kNaN, fitted, factors};
}

/// u with its sign turned after each time that it falls near 0 and rises again; nothing for fewer than three.
std::vector<double> unfolded(std::span<const double> u) {
  constexpr double kHigh = 0.2, kLow = 0.08;  ///< of the peak
  constexpr int kFewest = 3;
  const double peak = std::max(*std::max_element(u.begin(), u.end()), -*std::min_element(u.begin(), u.end()));
  std::vector<double> out(u.begin(), u.end());
  std::size_t turn = 0;
  double sign = 1.0;
  int turns = 0;
  bool low = false, begun = false;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double size = std::abs(u[i]);
    if (size < kLow * peak && (!low || size < std::abs(u[turn]))) turn = i, low = low || begun;
    if (size > kHigh * peak) {
      if (low) {
        sign = -sign, ++turns;
        for (std::size_t j = turn; j < i; ++j) out[j] = sign * u[j];
      }
      low = false, begun = true;
    }
    out[i] = sign * u[i];
  }
  return turns < kFewest ? std::vector<double>() : out;
}

}  // namespace

double Balance::left(std::span<const double> u, int rows) const {
  return best_fit(motion_, bumped(u, rows)).share_left;
}

double Balance::left_of_speed(std::span<const double> u) const {
  constexpr std::size_t kPassive = 3;  // inertia, damping and friction are above 0 where a body has them
  const std::vector<double> bumps = bumped(u, 0);
  std::vector<std::vector<double>> columns = of_speed_;
  for (;;) {
    const BestFit fit = best_fit(columns, bumps);
    bool passive = true;
    for (std::size_t j = 0; j < kPassive && fit.factors.size() > 0; ++j) {
      if (!(fit.factors(static_cast<Eigen::Index>(j)) < 0.0)) continue;
      columns[j].assign(columns[j].size(), 0.0), passive = false;
    }
    if (passive) return fit.share_left;
  }
}

double Balance::left_with_signs(std::span<const double> u) const {
  constexpr int kRounds = 10;  // signs that change what is fitted settle in a few
  const std::vector<double> size = bumped(u, 0);
  double least = kInfinity;
  for (const std::size_t column : {0u, 1u}) {  // what drives a mass, and what drives a damper
    std::vector<double> with_sign = size;
    for (std::size_t i = 0; i < size.size(); ++i) with_sign[i] = std::copysign(size[i], motion_[column][i]);
    for (int round = 0; round < kRounds; ++round) {
      const BestFit fit = best_fit(motion_, with_sign);
      if (fit.share_left < least) least = fit.share_left;
      for (std::size_t i = 0; i < size.size() && fit.fitted.size() > 0; ++i)
        with_sign[i] = std::copysign(size[i], fit.fitted(static_cast<Eigen::Index>(i)));
    }
  }
  return least;
}

std::vector<std::size_t> balance_windows(const MotorTrace& r, double half_period) {
  constexpr double kOfHalfPeriod = 0.5;
  std::vector<std::size_t> windows = {8};
  const double longest = half_period > 0.0 ? kOfHalfPeriod * half_period / r.dt : 8.0;
  for (const std::size_t window : {12u, 16u, 24u, 32u, 48u, 64u, 96u})
    if (static_cast<double>(window) <= longest) windows.push_back(window);
  return windows;
}

InputRows best_input_rows(const MotorTrace& r, double half_period) {
  constexpr double kLeftAnyway = 1e-7;  ///< of rounding
  constexpr double kTells = 0.5;        ///< most over least that is left: a window that tells the rows apart
  InputRows told;
  double tells = kTells;
  bool alike = true;  // all windows that tell move u to one side
  int side = 0;
  for (const std::size_t window : balance_windows(r, half_period)) {
    const Balance balance(r, window);
    double least = kInfinity, most = 0.0, as_it_is = kNaN;
    int best = 0;
    for (int rows = -kMostMovedRows; rows <= kMostMovedRows; ++rows) {
      const double left = balance.left(r.u, rows);
      if (rows == 0) as_it_is = left;
      if (left < least) least = left, best = rows;
      most = std::max(most, left);
    }
    const double contrast = (most - least) / (least + kLeftAnyway);
    const int to = (best > 0) - (best < 0);
    if (contrast > kTells && side == 0) side = to;
    if (contrast > kTells) alike = alike && to == side;
    if (contrast > tells) tells = contrast, told = {best, (as_it_is + kLeftAnyway) / (least + kLeftAnyway)};
  }
  return alike ? told : InputRows{};
}

double gain_of_signs(const MotorTrace& r, double half_period) {
  const std::vector<double> turned = unfolded(r.u);
  double most = 1.0;
  for (const std::size_t window : balance_windows(r, half_period)) {
    const Balance balance(r, window);
    double left = balance.left_with_signs(r.u);
    if (!turned.empty()) left = std::min(left, balance.left(turned));
    if (left > 0.0) most = std::max(most, balance.left(r.u) / left);
  }
  return most;
}

}  // namespace gapscope::internal::inspection
