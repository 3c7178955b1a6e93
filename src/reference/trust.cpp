#include "reference/trust.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "gapscope/base/statistics.h"
#include "reference/observer.h"
#include "reference/starts.h"
#include "reference/words.h"

namespace gapscope::internal::reference {
namespace {

constexpr Effort kClosed{1e-4, 0.5};      ///< of the search with the gap closed
constexpr std::size_t kClosedStarts = 2;  ///< ends of the search that it begins at
constexpr double kUnexplained = 0.3;      ///< see unexplained_share()
constexpr double kTakesMost = 2.0;  ///< ratio of errors: closed, the gap takes three quarters of the square

/// Squared prediction errors of an observer whose motor coasts between samples, and their number.
void add_coasting(const MotorTrace& r, double hz, double& sum, double& count) {
  const ObserverGains gains(hz, r);
  double x = r.x1[0], w = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double e = r.x1[i] - x;
    sum += e * e, count += 1.0;
    const ObserverGain gain = gains.at(i);
    x += gain.position * e, w += gain.speed * e;
    x += r.step(i) * w;
  }
}

double coasting_rmse(const FitProblem& problem) {
  double sum = 0.0, count = 0.0;
  for (const MotorTrace& r : problem.recordings) add_coasting(r, problem.options.observer_hz, sum, count);
  return std::sqrt(sum / count);
}

/// The place of the gap among the free numbers; that of none: their count.
std::size_t free_gap(const FitProblem& problem) {
  std::size_t i = 0;
  while (i < problem.free_count() && problem.free_parameter(i).id != drive_number(place::kGap)) ++i;
  return i;
}

FitProblem with_closed_gap(const FitProblem& problem, std::size_t gap) {
  FitProblem closed = problem;
  Parameter& p = closed.parameters[problem.free[gap]];
  p.start = 0.0, p.estimated = false;
  closed.free.erase(closed.free.begin() + static_cast<std::ptrdiff_t>(gap));
  return closed;
}

/// The least that a model without a gap leaves [floor²].
Square closed_square(const FitProblem& problem, const SearchResult& found, std::size_t gap) {
  const FitProblem closed = with_closed_gap(problem, gap);
  Square least;
  for (std::size_t k = 0; k < std::min(found.ends.size(), kClosedStarts); ++k) {
    FitPoint from = found.ends[k];
    from.q.erase(from.q.begin() + static_cast<std::ptrdiff_t>(gap));
    const Placement placed = choose_variants(closed, from, problem.options.observer_hz);
    from.starts = placed.starts;
    const Solution to = solve(closed, from, problem.options.observer_hz, kClosed);
    least.value = std::min(least.value, to.mean_square_with_priors);
    least.simulations += placed.simulations + to.simulations;
  }
  return least;
}

}  // namespace

TrustFacts trust_facts(const FitProblem& problem, const SearchResult& found) {
  TrustFacts facts;
  facts.coasting_rmse = coasting_rmse(problem);
  const std::size_t gap = free_gap(problem);
  if (gap == problem.free_count()) return facts;
  const Square closed = closed_square(problem, found, gap);
  facts.without_gap_ratio = std::sqrt(closed.value / found.best().mean_square_with_priors);
  facts.simulations = closed.simulations;
  return facts;
}

double fit_percent(const FitProblem& problem, const std::vector<FitTrace>& traces) {
  double worst = kInfinity;
  for (std::size_t r = 0; r < traces.size(); ++r) {
    const std::span<const double> x = problem.recordings[r].x1;
    const std::vector<double>& run = traces[r].position();
    if (run.size() != x.size()) return kNaN;
    const double center = mean(x);
    double missed = 0.0, moved = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      missed += std::pow(x[i] - run[i], 2), moved += std::pow(x[i] - center, 2);
    worst = std::min(worst, 100.0 * (1.0 - std::sqrt(missed / moved)));
  }
  return std::isfinite(worst) ? worst : kNaN;
}

double unexplained_share(const FitSummary& f) {
  const auto beyond = [&](double error) {
    return std::sqrt(std::max(0.0, error * error - f.floor * f.floor));
  };
  return beyond(f.innovation_rmse) / std::max(beyond(f.coasting_rmse), 1e-300);
}

namespace {

using Judge = std::optional<Remark> (*)(const FitOutcome&, const FitSummary&);

std::optional<Remark> unexplained(const FitOutcome&, const FitSummary& f) {
  const double share = unexplained_share(f);
  if (share < kUnexplained) return {};
  return words::leaves_unexplained(share, f.innovation_rmse / f.floor);
}

/// By how much closing the gap may raise the prediction error by chance.
double chance_ratio(const FitOutcome& o, const FitSummary& f) {
  double samples = 0.0;
  for (const FitTrace& t : f.traces) samples += static_cast<double>(t.x1.size());
  return std::sqrt(1.0 + kBeyondChance * o.information.inflation / std::max(samples, 1.0));
}

std::optional<Remark> no_gap_needed(const FitOutcome& o, const FitSummary& f) {
  if (!(f.without_gap_ratio < std::min(chance_ratio(o, f), kTakesMost))) return {};
  return words::as_well_without_gap(f.without_gap_ratio);
}

/// Above the encoder's floor, where what is missing may look like a gap, the gap has to take most of it.
std::optional<Remark> little_of_a_gap(const FitOutcome&, const FitSummary& f) {
  if (!(f.innovation_rmse > kAtFloor * f.floor) || !(f.without_gap_ratio < kTakesMost)) return {};
  return words::gap_bears_little(f.without_gap_ratio, f.innovation_rmse / f.floor);
}

/// A coupling that no drive has takes the place of what is missing.
std::optional<Remark> odd_coupling(const FitOutcome&, const FitSummary& f) {
  if (f.innovation_rmse < kAtFloor * f.floor) return {};
  for (const char* key : {"mass_ratio", "contact_stiffness"})
    if (const FittedParameter* p = f.find(key); p != nullptr && p->estimated && p->at_bound)
      return words::odd_coupling(key, p->value, p->unit);
  return {};
}

bool warned(const FitSummary& f, const char* code) {
  return std::any_of(f.warnings.begin(), f.warnings.end(), [&](const Remark& w) { return w.code() == code; });
}

std::optional<Remark> other_gap(const FitOutcome&, const FitSummary& f) {
  if (!warned(f, "another_gap")) return {};
  return words::gap_differs();
}

std::optional<Remark> unfinished(const FitOutcome&, const FitSummary& f) {
  if (f.converged()) return {};
  return words::not_settled();
}

std::optional<Remark> gap_open(const FitOutcome&, const FitSummary& f) {
  const FittedParameter* gap = f.find("gap");
  if (gap == nullptr || !gap->estimated) return {};
  if (gap->at_bound) return words::gap_at_bound();
  if (!gap->identifiable) return words::gap_not_determined();
  return {};
}

std::optional<Remark> above_floor(const FitOutcome& o, const FitSummary& f) {
  if (o.objective_hz == 0.0 && f.rmse < kAtFloor * f.floor) return {};
  return words::above_floor(f.fit_percent, f.innovation_rmse / f.floor, 100.0 * unexplained_share(f));
}

std::optional<Remark> moving(const FitOutcome&, const FitSummary& f) {
  if (!warned(f, "values_move")) return {};
  return words::parts_disagree();
}

std::optional<Remark> patterned(const FitOutcome& o, const FitSummary&) {
  if (o.information.correlation.excess() <= kWhite) return {};
  return words::residual_patterned();
}

std::optional<Remark> mistimed(const FitOutcome& o, const FitSummary&) {
  if (!o.information.timing.is_off()) return {};
  return words::input_mistimed(o.information.timing);
}

std::optional<Remark> pressed_by_bound(const FitOutcome& o, const FitSummary&) {
  if (o.pressed.empty()) return {};
  return words::pressed_by_bound(o.pressed);
}

std::optional<Remark> other_law(const FitOutcome& o, const FitSummary&) {
  const auto best =
      std::max_element(o.rivals.begin(), o.rivals.end(),
                       [](const RivalFit& a, const RivalFit& b) { return a.advantage < b.advantage; });
  if (best == o.rivals.end() || !best->explains_better()) return {};
  return words::other_law(best->law);
}

constexpr std::pair<FitTrust, Judge> kJudges[] = {
    {FitTrust::kRejected, unexplained},   {FitTrust::kRejected, other_gap},
    {FitTrust::kRejected, no_gap_needed}, {FitTrust::kRejected, little_of_a_gap},
    {FitTrust::kRejected, odd_coupling},  {FitTrust::kLimited, unfinished},
    {FitTrust::kLimited, gap_open},       {FitTrust::kLimited, mistimed},
    {FitTrust::kLimited, above_floor},    {FitTrust::kLimited, moving},
    {FitTrust::kLimited, patterned},      {FitTrust::kLimited, pressed_by_bound},
    {FitTrust::kLimited, other_law}};

/// A model that is usable is not one that does not explain its recordings, however far the encoder's floor.
/// Of one that is rejected the warning tells the error that the reason tells.
void reword_warning(const FitOptions& options, FitSummary& summary) {
  for (Remark& w : summary.warnings) {
    if (w.code() != words::not_explained(0.0, 0.0).code()) continue;
    const double hz = options.rejected_hz;
    w = summary.rejected() ? words::not_explained(summary.innovation_rmse / summary.floor, hz)
                           : words::leaves_some(100.0 * unexplained_share(summary), hz);
  }
}

}  // namespace

void judge_trust(const FitProblem& problem, const FitOutcome& outcome, const TrustFacts& facts,
                 FitSummary& summary) {
  summary.coasting_rmse = facts.coasting_rmse;
  summary.without_gap_ratio = facts.without_gap_ratio;
  summary.trust = FitTrust::kGood;
  summary.why = words::at_the_floor(summary.fit_percent);
  for (const auto& [trust, judge] : kJudges) {
    const std::optional<Remark> why = judge(outcome, summary);
    if (!why) continue;
    summary.trust = trust, summary.why = *why;
    break;
  }
  reword_warning(problem.options, summary);
}

}  // namespace gapscope::internal::reference
