#include "reference/search.h"

#include <algorithm>

#include "gapscope/base/interrupt.h"
#include "reference/excerpt.h"
#include "reference/information.h"
#include "reference/starts.h"

namespace gapscope::internal::reference {
namespace {

constexpr double kShares[] = {0.125, 0.25, 0.5};  ///< of the recordings, one after the other
constexpr Effort kPart{1e-3, 0.25};               ///< on a part of the recordings
constexpr Effort kSearch{1e-4, 0.5};              ///< enough to tell minima apart
constexpr double kSameMinimum = 1.01;             ///< costs within this ratio: found again
constexpr int kMeetings = 3;  ///< of the best minimum that settle a model that is not the drive
constexpr std::size_t kContendersPerStart = 4;
constexpr double kGains[] = {1.0, 0.4, 2.5};  ///< of the observer on parts, by turns: their minima differ

bool better(const Solution& a, const Solution& b) { return a.mean_square < b.mean_square; }

/// The better of a point and a local search from it, on some recordings.
void improve(const FitProblem& problem, double hz, const Effort& effort, Solution& at) {
  const Solution next = solve(problem, at, hz, effort);
  if (!next.usable()) return;
  at = next;
  choose_variants(problem, at, hz);
}

Solution whole_search(const FitProblem& problem, const Solution& point) {
  const double hz = problem.options.observer_hz;
  Solution found = solve(problem, point, hz, kSearch);
  if (!found.usable() || !choose_variants(problem, found, hz)) return found;
  const Solution again = solve(problem, found, hz, kSearch);
  return again.mean_square < found.mean_square ? again : found;
}

/// Whether further starts can be spared: nothing but the encoder is left in the innovations; or the best
/// minimum was met often and the model is not the drive anyway.
bool settled(const FitProblem& problem, const Solution& found, const SearchResult& result) {
  const FitOptions& o = problem.options;
  const double best = result.best().mean_square;
  const auto met = std::count_if(result.ends.begin(), result.ends.end(),
                                 [&](const Solution& end) { return end.mean_square < kSameMinimum * best; });
  if (best > o.rejected_ratio * o.rejected_ratio) return met >= kMeetings;
  return found.mean_square < kAtFloor * kAtFloor &&
         correlation_at(problem, found, o.observer_hz).excess() < kWhite;
}

/// @returns whether that settles the search
bool take(const FitProblem& problem, const Solution& point, SearchResult& result) {
  stop_point();
  const Solution found = whole_search(problem, point);
  if (!found.usable()) return false;
  result.ends.insert(std::upper_bound(result.ends.begin(), result.ends.end(), found, better), found);
  return settled(problem, found, result);
}

struct Contender {
  Solution at;
  double observer_hz = 0.0;
};

/// Points that compete on growing parts of the recordings; from one part to the next half of them drop out,
/// until `survivors` are left.
std::vector<Solution> compete(const FitProblem& problem, const std::vector<Solution>& points,
                              std::size_t survivors) {
  std::vector<Contender> field;
  for (std::size_t i = 0; i < points.size(); ++i)
    field.push_back({points[i], kGains[i % std::size(kGains)] * problem.options.observer_hz});
  for (const double share : kShares) {
    const Excerpt part(problem, share);
    for (Contender& c : field) {
      stop_point();
      improve(part.problem(), c.observer_hz, kPart, c.at);
      c.at.mean_square = mean_square(part.problem(), c.at, problem.options.observer_hz);
    }
    std::stable_sort(field.begin(), field.end(), [](const Contender& a, const Contender& b) {
      return a.at.mean_square < b.at.mean_square;
    });
    field.erase(field.begin() + std::min(field.size(), std::max(survivors, field.size() / 2)), field.end());
  }
  std::vector<Solution> left;
  for (const Contender& c : field)
    if (c.at.usable() && left.size() < survivors) left.push_back(c.at);
  return left;
}

}  // namespace

std::vector<double> SearchResult::costs() const {
  std::vector<double> costs;
  for (const Solution& end : ends) costs.push_back(end.mean_square);
  return costs;
}

SearchResult find_minima(const FitProblem& problem) {
  SearchResult result;
  auto starts = static_cast<std::size_t>(std::max(1, problem.options.starts));
  std::vector<Solution> points = {given_point(problem)};
  if (values_are_given(problem)) {  // what the user believes goes first; derived values have no such rank
    for (const Solution& point : compete(problem, points, 1))
      if (take(problem, point, result)) return result;
    points.clear();
    --starts;
  }
  if (starts > 0 && problem.free_count() > 0)
    for (Solution& point : drawn_points(problem, kContendersPerStart * starts))
      points.push_back(std::move(point));
  for (const Solution& point : compete(problem, points, starts))
    if (take(problem, point, result)) break;
  return result;
}

}  // namespace gapscope::internal::reference
