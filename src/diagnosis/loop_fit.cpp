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
constexpr double kSmallError = 2e-3;   ///< below which an error weighs as a square [rad]
constexpr double kLost = 10.0;         ///< error of a motion that diverges [rad]
constexpr double kSettled = 2e-3;      ///< of the error, below which a step is the last
constexpr int kFirstSteps = 8, kTrySteps = 4, kLastSteps = 20;
constexpr int kRounds = 2;  ///< a limit that was not reached is looked for once more when all else is there
constexpr std::size_t kTriedOn = 4;      ///< beginnings of additions that come nearest after one step
constexpr double kAlike = 1.0;           ///< time within which what is left is taken as alike [s]
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

  /// Half of each number's interval, in units of its move.
  Eigen::VectorXd spread(const Loop& loop, const std::vector<LoopPlace>& free) const {
    const Normal normal = normal_at(loop, free);
    const auto n = normal.slope.size(), stretches = normal.slopes.cols();
    if (stretches <= n) return Eigen::VectorXd::Constant(n, kInfinity);
    const auto inverse = normal.square.completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::MatrixXd moves = inverse * normal.slopes;
    const double freedom = static_cast<double>(stretches - n);
    const double few = static_cast<double>(stretches) / freedom;
    Eigen::ArrayXd half = student_975(freedom) * (few * moves.rowwise().squaredNorm().array()).sqrt();
    for (Eigen::Index k = 0; k < n; ++k)
      half(k) += free[static_cast<std::size_t>(k)].unseen(loop, turn(loop));
    return (normal.square.diagonal().array() > 0.0).select(half, kInfinity);  // what nothing depends on
  }

 private:
  struct Normal {
    Eigen::MatrixXd square;
    Eigen::VectorXd slope;
    Eigen::MatrixXd slopes;  ///< the same of each stretch, [numbers × stretches]
  };

  /// Of the firmware [s].
  double turn(const Loop& loop) const {
    return loop.controller.rate > 0.0 ? 1.0 / loop.controller.rate : traces_.front().dt;
  }

  std::vector<double> positions(const Loop& loop, std::size_t r) const {
    return positions_under_controller(plant_of(loop.model), loop.controller, traces_[r],
                                      begin_of(traces_[r]));
  }

  Normal normal_at(const Loop& loop, const std::vector<LoopPlace>& free) const {
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

  Normal normal_of(const Loop& loop, const std::vector<Loop>& moved, const std::vector<double>& by,
                   std::size_t r) const {
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

  std::span<const MotorTrace> traces_;
  int threads_;
};

/// What the recordings ask for, one after the other.
class LoopBuilder {
 public:
  LoopBuilder(std::span<const MotorTrace> all, const DriveController& declared, const LoopFitOptions& options)
      : all_(all),
        few_(few_of(all)),
        search_(few_, options.threads),
        declared_(declared),
        options_(options) {}

  /// At the rows, or between them.
  void settle_rate(Loop& loop) const {
    if (!options_.rate_is_sought) return;
    Loop other = loop;
    other.controller.rate = loop.controller.rate > 0.0 ? 0.0 : kBetweenRows;
    const double least = refine(loop, kTrySteps);
    if (refine(other, kTrySteps) < (1.0 - kWorthHaving) * least) loop = other;
  }

  /// Adds what helps most, until nothing does.
  void add_to(Loop& loop, std::vector<LoopPart>& parts) const {
    std::vector<Loop> from{loop};
    double least = refine(loop, kFirstSteps);
    from.push_back(loop);
    if (std::optional<Loop> held = held_at_rest(loop, few_)) {
      from.push_back(*held);
      const double error = refine(*held, kFirstSteps);
      if (error * (1.0 - kWorthHaving) < least) loop = *held, least = error;
    }
    while (least > all_.front().quantum) {
      const std::vector<LoopAddition> left = additions_to(loop, few_);
      options_.progress(
          fmt::format("fitting the closed loop: {} added, {} to try", parts.size(), left.size()));
      const Try best = best_of(left, from);
      if (!(best.error < (1.0 - kWorthHaving) * least)) return;
      loop = best.loop, least = best.error, from = {loop};
      const std::vector<LoopPart>& added = left[best.which].parts;
      parts.insert(parts.end(), added.begin(), added.end());
    }
  }

  /// What came first may be what a later part is: each is left out once, and stays out where nothing is lost.
  void thin_out(Loop& loop, std::vector<LoopPart>& parts) const {
    double least = refine(loop, kFirstSteps);
    for (auto part = parts.begin(); part != parts.end();) {
      Loop without = loop;
      part->take_out(without);
      const double error = refine(without, kFirstSteps);
      const bool is_needed = least < (1.0 - kWorthHaving) * error;
      if (!is_needed) loop = without, least = error;
      part = is_needed ? part + 1 : parts.erase(part);
    }
  }

  /// What makes the loop act later, in place of what was found first to do so.
  void exchange(Loop& loop, std::vector<LoopPart>& parts) const {
    double least = refine(loop, kFirstSteps);
    for (LoopPart& part : parts) {
      if (!part.is_late) continue;
      Loop without = loop;
      part.take_out(without);
      std::vector<LoopAddition> others = additions_to(without, few_);
      std::erase_if(others, [](const LoopAddition& a) { return !a.parts.front().is_late; });
      const Try best = best_of(others, {without});
      if (!(best.error < (1.0 - kWorthHaving) * least)) continue;
      loop = best.loop, least = best.error, part = others[best.which].parts.front();
    }
  }

  /// Share of the error that its law leaves, over the law that was declared.
  double left_by_law(const Loop& loop, const std::vector<LoopPart>& parts) const {
    Loop declared = loop;
    for (const LoopPart& part : parts)
      if (part.of_law) part.take_out(declared);
    return search_.error(loop) / refine(declared, kFirstSteps);
  }

 private:
  struct Try {
    Loop loop;
    std::size_t which = 0;  ///< of the additions
    double error = kLost;
  };

  double refine(Loop& loop, int steps) const {
    return search_.refine(loop, places_of(loop, declared_, options_), steps);
  }

  /// Every one gets a step, and those that come nearest the others.
  Try best_of(const std::vector<LoopAddition>& additions, const std::vector<Loop>& from) const {
    std::vector<Try> tries;
    for (std::size_t a = 0; a < additions.size(); ++a)
      for (const double start : additions[a].starts)
        for (const Loop& loop : from) {
          Try t{loop, a};
          additions[a].put(t.loop, start);
          t.error = refine(t.loop, 1);
          tries.push_back(std::move(t));
        }
    const auto nearer = [](const Try& a, const Try& b) { return a.error < b.error; };
    std::ranges::stable_sort(tries, nearer);
    tries.resize(std::min(tries.size(), kTriedOn));
    for (Try& t : tries) t.error = refine(t.loop, kTrySteps);
    return tries.empty() ? Try() : *std::ranges::min_element(tries, nearer);
  }

  std::span<const MotorTrace> all_;
  std::vector<MotorTrace> few_;
  LoopSearch search_;
  const DriveController& declared_;
  const LoopFitOptions& options_;
};

}  // namespace
}  // namespace internal::diagnosis

namespace id = internal::diagnosis;

std::optional<LoopFit> fit_in_loop(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                                   const DriveController& controller, const LoopFitOptions& options) {
  GAPSCOPE_REQUIRE(!recordings.empty());
  const id::LoopSearch search(recordings, options.threads);
  id::Loop loop{id::bounded(model), controller};
  LoopFit fit;
  fit.mae_before = search.error(loop);
  if (options.rate_is_sought) loop.controller.rate = id::kBetweenRows;
  if (!(fit.mae_before < id::kLost)) return {};
  options.progress("fitting the closed loop");
  const id::LoopBuilder builder(recordings, controller, options);
  builder.settle_rate(loop);
  std::vector<id::LoopPart> parts;
  for (int round = 0; round < id::kRounds; ++round) {
    builder.add_to(loop, parts);
    builder.settle_rate(loop);
    builder.thin_out(loop, parts);
    builder.exchange(loop, parts);
  }
  fit.left_by_law = builder.left_by_law(loop, parts);
  for (const id::LoopPart& part : parts) fit.added.push_back(part.key);
  id::free_timing(loop, controller, recordings.front().dt);
  const std::vector<id::LoopPlace> free = id::places_of(loop, controller, options);
  fit.mae_after = search.refine(loop, free, id::kLastSteps);
  const Eigen::VectorXd spread = search.spread(loop, free);
  for (std::size_t k = 0; k < free.size(); ++k)
    fit.numbers.push_back(free[k].told(loop, spread(static_cast<Eigen::Index>(k))));
  fit.model = loop.model, fit.controller = loop.controller;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    fit.model.parameters[i].low = model.parameters[i].low;
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
