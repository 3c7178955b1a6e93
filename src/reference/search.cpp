#include "reference/search.h"

#include <algorithm>
#include <iterator>

#include "base/interrupt.h"
#include "reference/excerpt.h"
#include "reference/information.h"
#include "reference/starts.h"

namespace gapscope::internal::reference {
namespace {

constexpr Effort kPart{1e-3, 0.25};    ///< on a part of the recordings
constexpr Effort kSearch{1e-4, 0.5};   ///< enough to tell minima apart
constexpr double kSameMinimum = 1.01;  ///< costs within this ratio: found again
constexpr int kMeetings = 3;           ///< of the best minimum that settle a model that is not the drive
constexpr std::size_t kContendersPerStart = 4;
constexpr double kGains[] = {1.0, 0.4, 2.5};  ///< of the observer on parts, by turns: their minima differ

/// The better of a point and a local search from it, on some recordings.
Solution improved(const FitProblem& problem, const Solution& at, double hz, const Effort& effort) {
  Solution next = solve(problem, at, hz, effort);
  if (!next.usable()) {
    Solution same = at;
    same.simulations = next.simulations;
    return same;
  }
  const Placement placed = choose_variants(problem, next, hz);
  next.starts = placed.starts;
  next.simulations += placed.simulations;
  return next;
}

Solution whole_search(const FitProblem& problem, const FitPoint& point) {
  const double hz = problem.options.observer_hz;
  Solution found = solve(problem, point, hz, kSearch);
  if (!found.usable()) return found;
  const Placement placed = choose_variants(problem, found, hz);
  found.starts = placed.starts;
  found.simulations += placed.simulations;
  if (!placed.changed) return found;
  Solution again = solve(problem, found, hz, kSearch);
  again.simulations = found.simulations += again.simulations;
  return leaves_less(again, found) ? again : found;
}

/// Whether further starts can be spared: nothing but the encoder is left in the innovations; or the best
/// minimum was met often and the model is not the drive anyway.
bool settled(const FitProblem& problem, const Solution& found, SearchResult& result) {
  const FitOptions& o = problem.options;
  const double best = result.best().mean_square_with_priors;
  const auto met = std::count_if(result.ends.begin(), result.ends.end(), [&](const Solution& end) {
    return end.mean_square_with_priors < kSameMinimum * best;
  });
  if (best > o.rejected_ratio * o.rejected_ratio) return met >= kMeetings;
  if (!(found.mean_square_with_priors < kAtFloor * kAtFloor)) return false;
  const Correlation left = correlation_at(problem, found, o.observer_hz);
  result.simulations += left.simulations;
  return left.excess() < kWhite;
}

/// @returns whether that settles the search
bool take(const FitProblem& problem, const FitPoint& point, SearchResult& result) {
  stop_point();
  const Solution found = whole_search(problem, point);
  result.simulations += found.simulations;
  if (!found.usable()) return false;
  result.ends.insert(std::upper_bound(result.ends.begin(), result.ends.end(), found, leaves_less), found);
  return settled(problem, found, result);
}

struct Contender {
  Solution at;
  double observer_hz = 0.0;
};

/// Points that compete on growing parts of the recordings; from one part to the next half of them drop out,
/// until `survivors` are left.
StartPoints compete(const FitProblem& problem, const std::vector<Solution>& points, std::size_t survivors) {
  std::vector<Contender> field;
  for (std::size_t i = 0; i < points.size(); ++i)
    field.push_back({points[i], kGains[i % std::size(kGains)] * problem.options.observer_hz});
  StartPoints left;
  for (const double share : kGrowingShares) {
    const Excerpt part(problem, share);
    for (Contender& c : field) {
      stop_point();
      c.at = improved(part.problem(), c.at, c.observer_hz, kPart);
      const Square square = mean_square_with_priors(part.problem(), c.at, problem.options.observer_hz);
      c.at.mean_square_with_priors = square.value;
      left.simulations += part.of_whole(c.at.simulations + square.simulations);
    }
    std::stable_sort(field.begin(), field.end(),
                     [](const Contender& a, const Contender& b) { return leaves_less(a.at, b.at); });
    field.erase(field.begin() + std::min(field.size(), std::max(survivors, field.size() / 2)), field.end());
  }
  for (const Contender& c : field)
    if (c.at.usable() && left.points.size() < survivors) left.points.push_back(c.at);
  return left;
}

SearchResult search(const FitProblem& problem) {
  SearchResult result;
  auto starts = static_cast<std::size_t>(std::max(1, problem.options.starts));
  std::vector<Solution> points(1, Solution{given_point(problem)});
  /// @returns whether one of the points settles the search
  const auto follow_best = [&](std::size_t count) {
    const StartPoints left = compete(problem, points, count);
    result.simulations += left.simulations;
    return std::any_of(left.points.begin(), left.points.end(),
                       [&](const Solution& point) { return take(problem, point, result); });
  };
  if (values_are_given(problem)) {  // what the user believes goes first; derived values have no such rank
    if (follow_best(1)) return result;
    points.clear();
    --starts;
  }
  if (starts > 0 && problem.free_count() > 0) {
    StartPoints draws = drawn_points(problem, kContendersPerStart * starts);
    result.simulations += draws.simulations;
    std::move(draws.points.begin(), draws.points.end(), std::back_inserter(points));
  }
  follow_best(starts);
  return result;
}

/// Whether the impacts of a gap may have hidden the drive from a search without starts: each of them makes
/// minima.
bool may_have_missed(const FitProblem& problem, const SearchResult& result) {
  const double ratio = problem.options.rejected_ratio;
  const bool sought =
      problem.options.search_halves && problem.structure.has_load && !problem.locked() &&
      !values_are_given(problem) &&
      std::any_of(problem.parameters.begin(), problem.parameters.end(),
                  [](const Parameter& p) { return p.id == drive_number(place::kGap) && p.estimated; });
  return sought && result.best().mean_square_with_priors > ratio * ratio;
}

/// Where a half of the first recording alone leads.
/// @returns whether that settles the search
bool search_from_half(const FitProblem& problem, std::size_t first, std::size_t last, SearchResult& result) {
  const Excerpt half(problem, 0, first, last);
  const SearchResult found = search(half.problem());
  result.simulations += half.of_whole(found.simulations);
  if (!found.best().usable()) return false;
  FitPoint point = start_point(problem, found.best().q);
  const Placement placed = choose_variants(problem, point, problem.options.observer_hz);
  point.starts = placed.starts;
  result.simulations += placed.simulations;
  return take(problem, point, result);
}

}  // namespace

std::vector<double> SearchResult::costs() const {
  std::vector<double> costs;
  for (const Solution& end : ends) costs.push_back(end.mean_square_with_priors);
  return costs;
}

SearchResult find_minima(const FitProblem& problem) {
  SearchResult result = search(problem);
  if (!may_have_missed(problem, result)) return result;
  const std::size_t all = problem.recordings.front().size(), middle = all / 2;
  if (!search_from_half(problem, 0, middle, result)) search_from_half(problem, middle, all, result);
  return result;
}

}  // namespace gapscope::internal::reference
