#include "reference/polish.h"

#include <algorithm>

#include "base/interrupt.h"
#include "base/random.h"
#include "reference/excerpt.h"
#include "reference/information.h"
#include "reference/starts.h"

namespace gapscope::internal::reference {
namespace {

constexpr Effort kFinal{1e-8, 2.0};  ///< far below what moves a value by its standard error
constexpr Effort kTrial{1e-4, 0.25};
constexpr int kShakes = 10;           ///< points nearby that are tried
constexpr double kBeginning = 0.125;  ///< of the recordings, where initial states are sought anew
constexpr double kClearly = 6.0;      ///< fall of the cost, in mean squares, that is no chance
constexpr double kSmallestShake = 1.0, kLargestShake = 100.0;  ///< in standard errors
constexpr double kOtherRing =
    2.0;                       ///< times and parts of the contact's stiffness that are tried beside it [-]
constexpr int kMostRings = 4;  ///< of the stiffness doubled or halved, one after the other

void keep(const Solution& next, FreeRunMinima& polished) {
  polished.simulations += next.simulations;
  if (!next.usable()) return;
  polished.others.push_back(next);
  if (leaves_less(next, polished.best)) polished.best = next;
}

Solution over_growing_parts(const FitProblem& problem, FitPoint at) {
  double spent = 0.0;
  for (const double share : kGrowingShares) {
    const Excerpt part(problem, share);
    const Solution next = solve(part.problem(), at, 0.0, kTrial);
    spent += part.of_whole(next.simulations);
    if (next.usable()) at = next;
  }
  Solution to = solve(problem, at, 0.0, kTrial);
  to.simulations += spent;
  return to;
}

/// A random point around a solution, as far off in every direction as the recordings leave it open.
FitPoint shaken(const FitProblem& problem, const FitPoint& at, const Eigen::MatrixXd& root, double size,
                std::mt19937_64& generator) {
  Eigen::VectorXd step(root.cols());
  for (double& v : step) v = size * normal(generator);
  step = root * step;
  const Cost cost(problem, at, 0.0);
  return cost.unpack((cost.pack(at) + step).cwiseMax(cost.low()).cwiseMin(cost.high()));
}

/// A square root of the covariance of all free numbers; empty where there is none.
Eigen::MatrixXd covariance_root(const Information& information) {
  if (!information.valid) return {};
  const Eigen::VectorXd scale = information.normal.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * information.normal *
                                                             scale.asDiagonal());
  const Eigen::VectorXd roots =
      (information.variance * eigen.eigenvalues().cwiseMax(1e-9).cwiseInverse()).cwiseSqrt();
  return scale.asDiagonal() * eigen.eigenvectors() * roots.asDiagonal();
}

void shake(const FitProblem& problem, FreeRunMinima& polished) {
  const Information information = information_at(problem, polished.best, 0.0);
  polished.simulations += information.simulations;
  const Eigen::MatrixXd root = covariance_root(information);
  if (root.size() == 0) return;
  auto generator = random_stream(problem.options.seed, "fit polish");
  for (int i = 0; i < kShakes; ++i) {
    stop_point();
    const double size = log_uniform(generator, kSmallestShake, kLargestShake);
    keep(solve(problem, shaken(problem, polished.best, root, size, generator), 0.0, kTrial), polished);
  }
}

/// A contact rings on after an impact, and a few rows each see where its ring is: another number of turns
/// from impact to impact fits nearly as well, so minima lie side by side in its stiffness. The next ones are
/// tried, and theirs, as long as they fit clearly better.
void look_along_stiffness(const FitProblem& problem, FreeRunMinima& polished) {
  for (std::size_t i = 0; i < problem.free_count(); ++i) {
    const Parameter& p = problem.free_parameter(i);
    if (p.id != drive_number(place::kContactStiffness)) continue;
    double samples = 0.0;
    for (const MotorTrace& r : problem.recordings) samples += static_cast<double>(r.size());
    for (int ring = 0; ring < kMostRings; ++ring) {
      const Solution from = polished.best;
      for (const double times : {1.0 / kOtherRing, kOtherRing}) {
        stop_point();
        FitPoint beside = from;
        const double stiffness = times * p.coordinate.physical(from.q[i]);
        beside.q[i] = p.coordinate.solver(std::clamp(stiffness, p.low, p.high));
        keep(solve(problem, beside, 0.0, kTrial), polished);
      }
      const double fall = from.mean_square_with_priors - polished.best.mean_square_with_priors;
      if (!(fall * samples > kClearly)) return;
    }
  }
}

/// The problem with all parameters held: only initial states are left to find.
FitProblem held_at(const FitProblem& problem, const FitPoint& at) {
  FitProblem held = problem;
  for (std::size_t i = 0; i < problem.free_count(); ++i) {
    Parameter& p = held.parameters[problem.free[i]];
    p.start = p.coordinate.physical(at.q[i]);
    p.estimated = false;
  }
  held.free.clear();
  return held;
}

/// An initial state that went astray leaves its mark at the beginning only. Each recording's is sought anew
/// there, from what its first samples show and every place of the load.
/// @returns where each begins, and whether any fits clearly better
Placement renewed_starts(const FitProblem& problem, const FitPoint& at) {
  const Excerpt part(problem, kBeginning);
  const FitProblem held = held_at(part.problem(), at);
  Placement renewed{at.starts, false, 0.0};
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    const double samples = static_cast<double>(held.recordings[r].size());
    const auto square_from = [&](const RecordingStart& start) {
      const Square square = recording_square(held, {}, r, start, 0.0);
      renewed.simulations += part.of_whole(square.simulations);
      return square.value;
    };
    double best = square_from(at.starts[r]);
    for (const InitialVariant& variant : initial_variants(held, at.starts[r])) {
      FitPoint from{{}, at.starts};
      from.starts[r].variant = variant;
      from.starts[r].q.fill(0.0);
      const Solution trial = solve(held, from, 0.0, kTrial);
      renewed.simulations += part.of_whole(trial.simulations);
      if (!trial.usable()) continue;
      const double square = square_from(trial.starts[r]);
      if (!(square < best - kClearly * std::max(1.0, best / samples))) continue;
      best = square;
      renewed.starts[r] = trial.starts[r];
      renewed.changed = true;
    }
  }
  return renewed;
}

}  // namespace

FreeRunMinima polish(const FitProblem& problem, const Solution& found) {
  FreeRunMinima polished{solve(problem, found, 0.0, kFinal), {}, 0.0};
  polished.simulations = polished.best.simulations;
  if (polished.best.usable()) {
    const Placement renewed = renewed_starts(problem, polished.best);
    polished.simulations += renewed.simulations;
    if (renewed.changed) keep(solve(problem, {polished.best.q, renewed.starts}, 0.0, kFinal), polished);
  }
  const bool settled = polished.best.mean_square_with_priors <= found.mean_square_with_priors;
  if (!settled) keep(over_growing_parts(problem, found), polished);
  if (!polished.best.usable()) return polished;
  look_along_stiffness(problem, polished);
  // An encoder on the load sees the motor in contact alone: minima of the free run lie side by side.
  if (!settled || problem.structure.reads_load()) shake(problem, polished);
  const Solution last = solve(problem, polished.best, 0.0, kFinal);
  polished.simulations += last.simulations;
  if (last.usable()) polished.best = last;
  return polished;
}

}  // namespace gapscope::internal::reference
