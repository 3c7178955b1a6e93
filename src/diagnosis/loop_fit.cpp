#include "gapscope/diagnosis/loop_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/require.h"
#include "diagnosis/few_recordings.h"
#include "diagnosis/loop_numbers.h"
#include "gapscope/simulation/closed_loop.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

constexpr double kWorthHaving = 0.02;  ///< of the error, that an addition takes
constexpr double kStep = 0.01;         ///< of a number, by which its derivative is taken
constexpr double kSmallError = 2e-3;   ///< below which an error weighs as a square [rad]
constexpr double kLost = 10.0;         ///< error of a motion that diverges [rad]
constexpr double kSettled = 2e-3;      ///< of the error, below which a step is the last
constexpr int kFirstSteps = 8, kTrySteps = 4, kLastSteps = 10;
constexpr int kTrials = 6;               ///< of a step that does not lessen the error
constexpr double kBetweenRows = 1000.0;  ///< rate of a firmware's own loop [Hz]
constexpr std::size_t kFirstRows = 5;    ///< over which the first speed is read

/// The speed with which a recording begins: none, where it moves by no more than the encoder's steps.
DriveState<double> begin_of(const MotorTrace& trace) {
  const std::size_t last = std::min(kFirstRows, trace.size() - 1);
  const double way = trace.x1[last] - trace.x1[0];
  const double w = std::abs(way) > 3.0 * trace.quantum ? way / trace.elapsed(last) : 0.0;
  return {trace.x1[0], w, trace.x1[0], w};
}

double mean_error(const MotorTrace& trace, const std::vector<double>& x) {
  if (x.empty()) return kLost;
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::abs(trace.x1[i] - x[i]);
  return sum / static_cast<double>(x.size());
}

class LoopSearch {
 public:
  LoopSearch(std::span<const MotorTrace> traces, int threads) : traces_(traces), threads_(threads) {}

  double error(const Loop& loop) const {
    std::vector<double> of(traces_.size());
    parallel_for(traces_.size(), threads_,
                 [&](std::size_t r) { of[r] = mean_error(traces_[r], positions(loop, r)); });
    double sum = 0.0;
    for (const double e : of) sum += e;
    return sum / static_cast<double>(of.size());
  }

  /// Down to where no step lessens the error by much. @returns the error there
  double refine(Loop& loop, const std::vector<LoopPlace>& free, int steps) const {
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

 private:
  struct Normal {
    Eigen::MatrixXd square;
    Eigen::VectorXd slope;
  };

  std::vector<double> positions(const Loop& loop, std::size_t r) const {
    return positions_under_controller(plant_of(loop.model), loop.controller, traces_[r],
                                      begin_of(traces_[r]));
  }

  Normal normal_at(const Loop& loop, const std::vector<LoopPlace>& free) const {
    const std::size_t n = free.size();
    std::vector<Loop> moved(n, loop);
    for (std::size_t k = 0; k < n; ++k) free[k].move(moved[k], kStep);
    std::vector<Normal> of(traces_.size());
    parallel_for(traces_.size(), threads_, [&](std::size_t r) { of[r] = normal_of(loop, moved, r); });
    Normal sum = of.front();
    for (std::size_t r = 1; r < of.size(); ++r) sum.square += of[r].square, sum.slope += of[r].slope;
    return sum;
  }

  Normal normal_of(const Loop& loop, const std::vector<Loop>& moved, std::size_t r) const {
    const MotorTrace& trace = traces_[r];
    const auto rows = static_cast<Eigen::Index>(trace.size()), n = static_cast<Eigen::Index>(moved.size());
    Normal normal{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    const std::vector<double> x = positions(loop, r);
    if (x.empty()) return normal;
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rows, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const std::vector<double> then = positions(moved[static_cast<std::size_t>(k)], r);
      for (Eigen::Index i = 0; i < rows && !then.empty(); ++i)
        slopes(i, k) = (then[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(i)]) / kStep;
    }
    Eigen::VectorXd left(rows), weight(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      left(i) = trace.x1[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(i)];
      weight(i) = 1.0 / (std::max(std::abs(left(i)), kSmallError) * static_cast<double>(rows));
    }
    normal.square = slopes.transpose() * weight.asDiagonal() * slopes;
    normal.slope = slopes.transpose() * weight.cwiseProduct(left);
    return normal;
  }

  std::span<const MotorTrace> traces_;
  int threads_;
};

/// At the rows, or between them.
void settle_rate(const LoopSearch& search, Loop& loop) {
  Loop other = loop;
  other.controller.rate = loop.controller.rate > 0.0 ? 0.0 : kBetweenRows;
  if (search.error(other) < (1.0 - kWorthHaving) * search.error(loop)) loop = other;
}

}  // namespace
}  // namespace internal::diagnosis

namespace id = internal::diagnosis;

std::optional<LoopFit> fit_in_loop(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                                   const DriveController& controller, const LoopFitOptions& options) {
  GAPSCOPE_REQUIRE(!recordings.empty());
  const id::LoopSearch search(recordings, options.threads);
  id::Loop loop{model, controller};
  LoopFit fit;
  fit.mae_before = search.error(loop);
  if (!(fit.mae_before < id::kLost)) return {};
  std::vector<id::LoopPlace> free = id::places_of(loop, options);
  options.progress("fitting the closed loop");
  if (options.rate_is_sought) id::settle_rate(search, loop);
  const std::vector<MotorTrace> few = id::few_of(recordings);
  const id::LoopSearch quick(few, options.threads);
  double least = quick.refine(loop, free, id::kFirstSteps);
  std::vector<id::LoopAddition> left = id::additions_to(loop, recordings, options);
  for (bool helps = true; helps && !left.empty() && least > recordings.front().quantum;) {
    options.progress(
        fmt::format("fitting the closed loop: {} added, {} to try", fit.added.size(), left.size()));
    helps = false;
    id::Loop best;
    std::size_t which = 0;
    double best_error = (1.0 - id::kWorthHaving) * least;
    for (std::size_t a = 0; a < left.size(); ++a)
      for (const double start : left[a].starts) {
        id::Loop next = loop;
        left[a].put(next, start);
        const double error = quick.refine(next, id::places_of(next, options), id::kTrySteps);
        if (error < best_error) best = next, best_error = error, which = a, helps = true;
      }
    if (!helps) break;
    if (left[which].of_law) fit.left_by_law *= best_error / least;
    loop = best, least = best_error;
    fit.added.push_back(left[which].key);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(which));
  }
  if (options.rate_is_sought) id::settle_rate(search, loop);
  free = id::places_of(loop, options);
  fit.mae_after = search.refine(loop, free, id::kLastSteps);
  for (const id::LoopPlace& place : free) fit.numbers.push_back(place.told(loop));
  fit.model = loop.model, fit.controller = loop.controller;
  for (const MotorTrace& trace : recordings)
    fit.fitted_runs.push_back(run_in_loop(trace, fit.model, fit.controller));
  return fit;
}

HeldOutRun run_in_loop(const MotorTrace& recording, const ReferenceModel& model,
                       const DriveController& controller) {
  HeldOutRun run;
  run.file = recording.file, run.closed = true;
  run.from = recording.time(0), run.to = recording.time(recording.size() - 1);
  const std::vector<double> x =
      positions_under_controller(id::plant_of(model), controller, recording, id::begin_of(recording));
  if (x.empty()) return run;
  const double centre = mean(recording.x1);
  double square = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    square += std::pow(recording.x1[i] - x[i], 2);
    moved += std::pow(recording.x1[i] - centre, 2);
  }
  run.rmse = std::sqrt(square / static_cast<double>(x.size()));
  run.mae = id::mean_error(recording, x);
  if (moved > 0.0) run.fit = 100.0 * (1.0 - std::sqrt(square / moved));
  return run;
}

}  // namespace gapscope
