#include "diagnosis/loop_fitter.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "gapscope/base/statistics.h"
#include "gapscope/simulation/closed_loop.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kSmallError = 2e-3;   ///< below which an error weighs as a square [rad]
constexpr double kSettled = 2e-3;      ///< of the error, below which a step is the last
constexpr double kAlike = 1.0;         ///< time within which what is left is taken as alike [s]
constexpr int kTrials = 6;             ///< of a step that does not lessen the error
constexpr std::size_t kFirstRows = 5;  ///< over which the first speed is read
constexpr int kPhaseHalvings = 3;      ///< of what is between two of them
constexpr int kPhases = 8;             ///< of a turn of the firmware against the rows, which no log tells

/// The speed with which a recording begins: none, where it moves by no more than the encoder's steps.
DriveState<double> begin_of(const MotorTrace& trace) {
  const std::size_t last = std::min(kFirstRows, trace.size() - 1);
  const double way = trace.x1[last] - trace.x1[0];
  const double w = std::abs(way) > 3.0 * trace.quantum ? way / trace.elapsed(last) : 0.0;
  return {trace.x1[0], w, trace.x1[0], w};
}

}  // namespace

std::vector<double> positions_at(double phase, const Loop& loop, const MotorTrace& trace) {
  return positions_under_controller(plant_of(loop.model), loop.controller, trace, begin_of(trace), phase);
}

double mean_error(const MotorTrace& trace, const std::vector<double>& x) {
  if (x.empty()) return kLost;
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::abs(trace.x1[i] - x[i]);
  return sum / static_cast<double>(x.size());
}

double phase_of(const Loop& loop, const MotorTrace& trace) {
  if (loop.controller.rate == 0.0) return 0.0;
  double phase = 0.0, least = kInfinity;
  const auto look_at = [&](double tried) {
    tried -= std::floor(tried);
    if (const double error = mean_error(trace, positions_at(tried, loop, trace)); error < least)
      phase = tried, least = error;
  };
  double step = 1.0 / kPhases;
  for (int p = 0; p < kPhases; ++p) look_at(p * step);
  for (int halving = 0; halving < kPhaseHalvings; ++halving) {
    step *= 0.5;
    const double at = phase;
    look_at(at - step), look_at(at + step);
  }
  return phase;
}

void LoopFitter::find_phases(const Loop& loop) {
  parallel_for(traces_.size(), threads_, [&](std::size_t r) { phases_[r] = phase_of(loop, traces_[r]); });
}

double LoopFitter::error(const Loop& loop) const {
  std::vector<double> of(traces_.size());
  parallel_for(traces_.size(), threads_,
               [&](std::size_t r) { of[r] = mean_error(traces_[r], positions(loop, r)); });
  double sum = 0.0;
  for (const double e : of) sum += e;
  return sum / static_cast<double>(of.size());
}

double LoopFitter::refine(Loop& loop, const std::vector<LoopPlace>& free, int steps) const {
  double least = error(loop);
  double damping = 1e-2;
  for (int step = 0; step < steps && !free.empty() && least < kLost; ++step) {
    stop_point();
    const Normal normal = normal_at(loop, free);
    const double before = least;
    for (int trial = 0; trial < kTrials; ++trial, damping *= 5.0) {
      Eigen::MatrixXd damped = normal.square;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-12 * normal.square.diagonal().maxCoeff() + 1e-300;
      const Eigen::VectorXd move = damped.ldlt().solve(normal.slope);
      Loop next = loop;
      for (std::size_t k = 0; k < free.size(); ++k)
        free[k].move(next, std::clamp(move(static_cast<Eigen::Index>(k)), -1.0, 1.0));
      if (const double at = error(next); at < least) {
        loop = next, least = at, damping = std::max(1e-6, damping / 25.0);
        break;
      }
    }
    if (least > (1.0 - kSettled) * before) break;
  }
  return least;
}

Eigen::VectorXd LoopFitter::spread(const Loop& loop, const std::vector<LoopPlace>& free) const {
  const Normal normal = normal_at(loop, free);
  const auto n = normal.slope.size(), stretches = normal.slopes.cols();
  if (stretches <= n) return Eigen::VectorXd::Constant(n, kInfinity);
  const auto inverse = normal.square.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd moves = inverse * normal.slopes;
  const double freedom = static_cast<double>(stretches - n);
  const double few = static_cast<double>(stretches) / freedom;
  Eigen::ArrayXd half = student_975(freedom) * (few * moves.rowwise().squaredNorm().array()).sqrt();
  for (Eigen::Index k = 0; k < n; ++k) half(k) += free[static_cast<std::size_t>(k)].unseen(loop, turn(loop));
  return (normal.square.diagonal().array() > 0.0).select(half, kInfinity);  // what nothing depends on
}

double LoopFitter::turn(const Loop& loop) const {
  return loop.controller.rate > 0.0 ? 1.0 / loop.controller.rate : traces_.front().dt;
}

std::vector<double> LoopFitter::positions(const Loop& loop, std::size_t r) const {
  return positions_at(phases_[r], loop, traces_[r]);
}

LoopFitter::Normal LoopFitter::normal_at(const Loop& loop, const std::vector<LoopPlace>& free) const {
  const std::size_t n = free.size();
  std::vector<Loop> moved(n, loop);
  std::vector<double> by(n);
  for (std::size_t k = 0; k < n; ++k) free[k].move(moved[k], by[k] = free[k].trial(loop, turn(loop)));
  std::vector<Normal> of(traces_.size());
  parallel_for(traces_.size(), threads_, [&](std::size_t r) { of[r] = normal_of(loop, moved, by, r); });
  Normal sum = of.front();
  for (std::size_t r = 1; r < of.size(); ++r) {
    sum.square += of[r].square, sum.slope += of[r].slope;
    const Eigen::Index had = sum.slopes.cols();
    sum.slopes.conservativeResize(Eigen::NoChange, had + of[r].slopes.cols());
    sum.slopes.rightCols(of[r].slopes.cols()) = of[r].slopes;
  }
  return sum;
}

LoopFitter::Normal LoopFitter::normal_of(const Loop& loop, const std::vector<Loop>& moved,
                                         const std::vector<double>& by, std::size_t r) const {
  const MotorTrace& trace = traces_[r];
  const auto rows = static_cast<Eigen::Index>(trace.size()), n = static_cast<Eigen::Index>(moved.size());
  const auto stretches = std::max<Eigen::Index>(1, std::llround(trace.elapsed(trace.size() - 1) / kAlike));
  Normal normal{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, stretches)};
  const std::vector<double> x = positions(loop, r);
  if (x.empty()) return normal;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rows, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::vector<double> then = positions(moved[static_cast<std::size_t>(k)], r);
    for (Eigen::Index i = 0; i < rows && !then.empty(); ++i)
      slopes(i, k) = (then[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(i)]) /
                     by[static_cast<std::size_t>(k)];
  }
  Eigen::VectorXd left(rows), weight(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    left(i) = trace.x1[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(i)];
    weight(i) = 1.0 / (std::max(std::abs(left(i)), kSmallError) * static_cast<double>(rows));
  }
  normal.square = slopes.transpose() * weight.asDiagonal() * slopes;
  for (Eigen::Index i = 0; i < rows; ++i)
    normal.slopes.col(i * stretches / rows) += weight(i) * left(i) * slopes.row(i).transpose();
  normal.slope = normal.slopes.rowwise().sum();
  return normal;
}

}  // namespace gapscope::internal::diagnosis
