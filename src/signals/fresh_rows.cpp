#include "signals/fresh_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::signals {
namespace {

/// Distances that have to tell before anything is told: rows that are read anew have 20 even ones in a row
/// once in a million times.
constexpr std::size_t kFewestDistances = 20;
constexpr double kNearlyAll = 0.95;   ///< of them: a lost row puts one of them off
constexpr double kAsByChance = 0.65;  ///< of them: half of any distances are even
/// Distances in a row, each with its size, that stand twice in a motion that repeats itself. By 3 of them 62
/// of 400 held sines would no longer be told, by 5 and by 10 none.
constexpr std::size_t kRepeated = 5;
constexpr std::size_t kLongestFilling = 1000;  ///< rows; longer ones are rests
constexpr double kFastQuanta = 3.0;            ///< a row at which no row of a smooth motion stands still
constexpr std::size_t kFastSteps = 8;          ///< over which the motion is fast
constexpr std::size_t kFewestFastSteps = 96;
/// Rows a reading in the mean of fast motion that noise makes, and that noise and lost rows make.
constexpr double kMostFresh = 1.2, kMostHeld = 1.4;

/// What is none of rounding to digits: of x, and of its second difference in quanta.
constexpr double kDigits = 2e-7;  ///< of the travel
constexpr double kLeastPart = 1e-3, kMostPart = 0.05;
constexpr double kRoundedBend = 1.5;  ///< of a line that is rounded to counts: one, on a tie two [quanta]

/// A row at which something new shows.
struct News {
  std::size_t row = 0;
  double size = 0.0;  ///< of the difference [rad]
};

double travel_of(std::span<const double> x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return *high - *low;
}

std::vector<News> steps_in(std::span<const double> x) {
  std::vector<News> news;
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] != x[i - 1]) news.push_back({i, std::abs(x[i] - x[i - 1])});
  return news;
}

std::vector<News> bends_in(std::span<const double> x, double quantum) {
  std::vector<News> news;
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    news.push_back({i, std::abs(x[i - 1] - 2.0 * x[i] + x[i + 1])});
    largest = std::max(largest, news.back().size);
  }
  const double digits = kDigits * travel_of(x);
  const double least = quantum > 0.0 ? std::clamp(digits, kLeastPart * quantum, kMostPart * quantum)
                                     : std::max(digits, 1e-4 * largest);
  std::erase_if(news, [&](const News& n) { return n.size <= least; });
  return news;
}

/// Bends that rounding to counts makes on no line, but for ties.
std::vector<News> beyond_rounding(std::vector<News> bends, double quantum) {
  std::erase_if(bends, [quantum](const News& n) { return n.size <= kRoundedBend * quantum; });
  return bends;
}

/// Rows from one news to the next, and the size of that.
struct Distance {
  std::size_t rows = 0;
  double size = 0.0;  // [rad]
};

/// Distances between news. One that repeats the last one by single quanta tells nothing: so does a steady
/// speed.
std::vector<Distance> telling_distances(const std::vector<News>& news, double quantum) {
  std::vector<Distance> telling;
  std::size_t last = 0;
  for (std::size_t i = 1; i < news.size(); ++i) {
    const std::size_t distance = news[i].row - news[i - 1].row;
    if (distance != last || news[i].size > 1.5 * quantum) telling.push_back({distance, news[i].size});
    last = distance;
  }
  return telling;
}

/// Without those that end what stood before: a motion that repeats itself to the count tells the same again.
std::vector<Distance> told_once(const std::vector<Distance>& all) {
  std::vector<Distance> once;
  std::set<std::array<double, 2 * kRepeated>> met;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::array<double, 2 * kRepeated> end{};
    for (std::size_t k = 0; k < std::min(i + 1, kRepeated); ++k)
      end[2 * k] = static_cast<double>(all[i - k].rows), end[2 * k + 1] = static_cast<float>(all[i - k].size);
    if (met.insert(end).second) once.push_back(all[i]);
  }
  return once;
}

/// What distances between news say of how many rows come to a reading.
struct Common {
  double rows = 0.0;  ///< the largest number that nearly all are multiples of; 0: none, or too few tell
  bool any = false;   ///< enough tell, and no number has more multiples among them than chance leaves
};

Common common_of(const std::vector<Distance>& distances) {
  Common common;
  if (distances.size() < kFewestDistances) return common;
  const double all = static_cast<double>(distances.size());
  common.any = true;
  const std::size_t longest = std::ranges::max(distances, {}, &Distance::rows).rows;
  for (std::size_t n = std::min(kLongestFilling, longest); n > 1; --n) {
    const auto multiples =
        std::ranges::count_if(distances, [n](const Distance& d) { return d.rows % n == 0; });
    const double share = static_cast<double>(multiples) / all;
    if (share >= kNearlyAll) return {static_cast<double>(n), false};
    common.any = common.any && share < kAsByChance;
  }
  return common;
}

/// A number has to stand out among what was told once, too.
Common common_distance(const std::vector<News>& news, double quantum) {
  const std::vector<Distance> telling = telling_distances(news, quantum);
  Common common = common_of(telling);
  if (common.rows > 0.0) common.rows = common_of(told_once(telling)).rows;
  return common;
}

/// Mean distance of steps in fast motion, in which rows that are read anew hardly ever stand still; 1 where
/// there is too little of it.
double rows_of_fast_motion(std::span<const double> x, const std::vector<News>& steps, double quantum) {
  double rows = 0.0;
  std::size_t count = 0;
  for (std::size_t i = kFastSteps; i < steps.size(); i += kFastSteps) {
    const std::size_t from = steps[i - kFastSteps].row, to = steps[i].row;
    const double taken = static_cast<double>(to - from);
    if (taken > kLongestFilling * kFastSteps || std::abs(x[to] - x[from]) < kFastQuanta * quantum * taken)
      continue;
    rows += taken, count += kFastSteps;
  }
  return count < kFewestFastSteps ? 1.0 : rows / static_cast<double>(count);
}

}  // namespace

FreshRows fresh_rows(std::span<const double> x, double quantum) {
  if (x.size() < 3) return {};
  const std::vector<News> steps = steps_in(x), bends = bends_in(x, quantum);
  const Common held = common_distance(steps, quantum);
  if (held.rows > 0.0) return {Filling::kHeld, held.rows};
  const double rows = rows_of_fast_motion(x, steps, quantum);
  if (rows > kMostHeld) return {Filling::kHeld, rows};
  const Common bent = common_distance(bends, quantum);
  if (bent.rows > 0.0) return {Filling::kInterpolated, bent.rows};
  // What is off the counts of an encoder was computed, and by what is not seen here.
  if (quantum <= 0.0 || !held.any || !bent.any || rows >= kMostFresh) return {};
  const Common far = common_distance(beyond_rounding(bends, quantum), quantum);
  if (far.rows > 0.0) return {Filling::kInterpolated, far.rows};
  return {far.any ? Filling::kNone : Filling::kCannotBeTold, 1.0};
}

}  // namespace gapscope::internal::signals
