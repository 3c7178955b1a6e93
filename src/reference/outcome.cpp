#include "reference/outcome.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "reference/excerpt.h"
#include "reference/polish.h"
#include "reference/starts.h"
#include "reference/words.h"

namespace gapscope::internal::reference {
namespace {

constexpr Effort kRejected{1e-6, 1.0};      ///< of a model that is not the drive
constexpr Effort kOther{1e-4, 0.5};         ///< of the change to another gain or part
constexpr double kSlowObserver = 0.2;       ///< of the search's gain, where a free run goes astray
constexpr double kSecondGain = 1.0 / 3.0;   ///< of rejected_hz
constexpr std::size_t kShortestPart = 200;  ///< samples
constexpr int kBlocks = 40;                 ///< in which the level of the input is looked at
constexpr int kFewestBlocks = 4;            ///< of a part
constexpr double kOtherLevel = 4.0;         ///< ratio of input powers that makes a level of its own
constexpr double kOtherGap = 0.25;          ///< relative difference of gaps that can be told

std::vector<double> values_of(const FitProblem& problem, const FitPoint& s) {
  std::vector<double> values;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    values.push_back(problem.free_parameter(i).coordinate.physical(s.q[i]));
  return values;
}

void take(const FitProblem& problem, const Solution& solution, double hz, FitOutcome& outcome) {
  outcome.solution = solution;
  outcome.objective_hz = hz;
  outcome.information = information_at(problem, solution, hz);
  outcome.simulations += outcome.information.simulations;
}

/// Minima side by side are all possible, each with the likelihood of its cost.
void spread_over_minima(const FitProblem& problem, const std::vector<Solution>& others, FitOutcome& outcome) {
  double samples = 0.0, weights = 1.0;
  for (const MotorTrace& r : problem.recordings) samples += static_cast<double>(r.size());
  const double unit = 2.0 * outcome.information.variance * outcome.information.inflation / samples;
  const std::vector<double> best = values_of(problem, outcome.solution);
  outcome.spread.assign(best.size(), 0.0);
  for (const Solution& other : others) {
    const double weight = std::exp(
        -std::max(0.0, other.mean_square_with_priors - outcome.solution.mean_square_with_priors) / unit);
    const std::vector<double> values = values_of(problem, other);
    for (std::size_t i = 0; i < best.size(); ++i)
      outcome.spread[i] += weight * std::pow(values[i] - best[i], 2);
    weights += weight;
  }
  for (double& s : outcome.spread) s = std::sqrt(s / weights);
}

/// Values at one gain, their change to another one as an error.
void take_two_gains(const FitProblem& problem, const Solution& from, double hz, double other_hz,
                    FitOutcome& outcome) {
  const Solution found = solve(problem, from, hz, kRejected);
  outcome.simulations += found.simulations;
  take(problem, found.usable() ? found : from, found.usable() ? hz : problem.options.observer_hz, outcome);
  const Solution other = solve(problem, outcome.solution, other_hz, kOther);
  outcome.simulations += other.simulations;
  if (!other.usable()) return;
  outcome.changes.push_back({words::between_gains(outcome.objective_hz, other_hz),
                             values_of(problem, outcome.solution), values_of(problem, other), 1.0, false});
}

/// Where the level of the input changes most; the middle if it hardly does.
std::size_t change_of_level(const MotorTrace& r) {
  double powers[kBlocks + 1] = {};  // sums up to each block
  const std::size_t length = r.size() / kBlocks;
  for (int b = 0; b < kBlocks; ++b) {
    powers[b + 1] = powers[b];
    for (std::size_t i = 0; i < length; ++i)
      powers[b + 1] += std::pow(r.u[static_cast<std::size_t>(b) * length + i], 2);
  }
  double largest = kOtherLevel;
  int split = kBlocks / 2;
  for (int b = kFewestBlocks; b <= kBlocks - kFewestBlocks; ++b) {
    const double before = powers[b] / b, after = (powers[kBlocks] - powers[b]) / (kBlocks - b);
    const double ratio = std::max(before, after) / std::max(std::min(before, after), 1e-300);
    if (ratio <= largest) continue;
    largest = ratio;
    split = b;
  }
  return static_cast<std::size_t>(split) * length;
}

/// The end that predicts best at a gain. Unmodelled torque hides physics from a slow observer: what is best
/// there need not be.
/// @returns it with the simulations that all took
Solution best_at(const FitProblem& problem, const std::vector<Solution>& ends, double hz) {
  Solution best;
  double spent = 0.0;
  for (const Solution& end : ends) {
    const Solution there = solve(problem, end, hz, kOther);
    spent += there.simulations;
    if (leaves_less(there, best)) best = there;
  }
  best.simulations = spent;
  return best;
}

/// Free parameters on one part alone, sought anew: from the values of the whole a part that shows nothing of
/// a parameter would only return them.
Solution best_on(const Excerpt& part, const Solution& from, double hz) {
  SearchResult found = find_minima(part.problem());
  FitPoint start = start_point(part.problem(), from.q);
  const Placement placed = choose_variants(part.problem(), start, hz);
  start.starts = placed.starts;
  found.ends.push_back({start});
  Solution best = best_at(part.problem(), found.ends, hz);
  best.simulations = part.of_whole(best.simulations + found.simulations + placed.simulations);
  return best;
}

/// The first two recordings, or the two parts of the only one, each by itself.
void compare_parts(const FitProblem& problem, FitOutcome& outcome) {
  const bool several = problem.recordings.size() > 1;
  const MotorTrace& first = problem.recordings[0];
  const std::size_t split = change_of_level(first);
  if (!several && std::min(split, first.size() - split) < kShortestPart) return;
  const Excerpt a(problem, 0, 0, several ? first.size() : split);
  const Excerpt b(problem, several ? 1 : 0, several ? 0 : split,
                  several ? problem.recordings[1].size() : first.size());
  const Solution from = best_on(a, outcome.solution, outcome.objective_hz);
  const Solution to = best_on(b, outcome.solution, outcome.objective_hz);
  outcome.simulations += from.simulations + to.simulations;
  if (!from.usable() || !to.usable()) return;
  const Remark where = several ? words::between_recordings(first.file, problem.recordings[1].file)
                               : words::between_parts(first.time(split));
  outcome.changes.push_back({where, values_of(a.problem(), from), values_of(b.problem(), to), 0.5, true});
}

void take_rejected(const FitProblem& problem, const SearchResult& found, FitOutcome& outcome) {
  const FitOptions& o = problem.options;
  outcome.warnings.push_back(
      words::not_explained(std::sqrt(found.best().mean_square_with_priors), o.rejected_hz));
  const Solution best = best_at(problem, found.ends, o.rejected_hz);
  outcome.simulations += best.simulations;
  take_two_gains(problem, best.usable() ? best : found.best(), o.rejected_hz, kSecondGain * o.rejected_hz,
                 outcome);
  if (o.compare_parts) compare_parts(problem, outcome);
}

void warn_of_pattern(FitOutcome& outcome) {
  const auto& [correlation, timing] = std::tie(outcome.information.correlation, outcome.information.timing);
  if (correlation.excess() > kWhite)
    outcome.warnings.push_back(words::not_random(correlation.lag1, correlation.quantiser));
  if (timing.is_off()) outcome.warnings.push_back(words::input_timing(timing));
}

}  // namespace

std::vector<double> FitOutcome::shift() const {
  std::vector<double> sum = spread;
  for (const ValueChange& c : changes) {
    sum.resize(c.from.size(), 0.0);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] = std::hypot(sum[i], c.weight * (c.to[i] - c.from[i]));
  }
  return sum;
}

bool is_rejected(const FitProblem& problem, const Solution& found) {
  return !(std::sqrt(found.mean_square_with_priors) <= problem.options.rejected_ratio);
}

FitOutcome outcome_of(const FitProblem& problem, const SearchResult& ends) {
  if (!is_rejected(problem, ends.best())) return outcome_near_floor(problem, ends.best());
  FitOutcome outcome;
  take_rejected(problem, ends, outcome);
  return outcome;
}

FitOutcome outcome_near_floor(const FitProblem& problem, const Solution& found) {
  const FitOptions& o = problem.options;
  FitOutcome outcome;
  const FreeRunMinima polished = polish(problem, found);
  outcome.simulations += polished.simulations;
  if (!is_rejected(problem, polished.best)) {
    take(problem, polished.best, 0.0, outcome);
    spread_over_minima(problem, polished.others, outcome);
    warn_of_pattern(outcome);
    return outcome;
  }
  outcome.warnings.push_back(words::free_run_departs(kSlowObserver * o.observer_hz));
  take_two_gains(problem, found, kSlowObserver * o.observer_hz, o.observer_hz, outcome);
  return outcome;
}

void judge_changes(const FitProblem& problem, const FitOutcome& outcome, Determination& determined) {
  for (const ValueChange& c : outcome.changes) {
    std::vector<words::ValueShift> moved;
    for (std::size_t i = 0; i < c.from.size(); ++i) {
      const double difference = std::abs(c.to[i] - c.from[i]);
      // An interval of each side: the own one, on half of the recordings.
      const double interval = determined.quantile * determined.own[i] * (c.parts ? 2.0 : 1.0);
      if (!(difference > interval)) continue;
      const Parameter& p = problem.free_parameter(i);
      moved.push_back({p.key, c.from[i], c.to[i], p.unit});
      const bool other_gap = difference > kOtherGap * std::max(c.from[i], c.to[i]);
      if (!c.parts || p.id != drive_number(place::kGap) || !other_gap) continue;
      determined.identifiable[i] = false;
      determined.std[i] = kNaN;
      determined.warnings.push_back(words::another_gap(c.from[i], c.to[i]));
    }
    if (!moved.empty()) determined.warnings.push_back(words::values_move(c.where, moved));
  }
}

}  // namespace gapscope::internal::reference
