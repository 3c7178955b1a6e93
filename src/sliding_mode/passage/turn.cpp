#include "sliding_mode/passage/turn.h"

#include <cmath>

#include "gapscope/base/statistics.h"
#include "signals/least_squares.h"
#include "signals/motion_law.h"
#include "sliding_mode/kink_fit.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Bounds the work where x1 has no turn to be found. Half of it, and no bound, read the same of 5210021 30
/// gap sine wide rubs.
constexpr int kMostSteps = 20;

/// Of the way behind a turn: on which the dry friction may change its sign (signals/motion_law.h); the first
/// that x1 tells apart is taken.
constexpr double kBends[] = {0.0, 0.01, 0.04};
constexpr double kBendShows = 10.0;  ///< in χ²

/// A friction that bends steps as late as if the turn were a sample or two later: 1 is at its edge then.
constexpr double kTurnDoubt = 3.0, kFinestTurn = 0.02;  ///< samples
constexpr std::size_t kMostRowsOfTurn = 400;

/// The sample in one direction from which on x1 is that far from its extremum, or the last one there is.
std::size_t away(const MotorTrace& trace, std::size_t from, int step, double way) {
  std::size_t i = from;
  while ((step > 0 ? i + 1 < trace.size() : i > 0) && std::abs(trace.x1[i] - trace.x1[from]) < way)
    i = step > 0 ? i + 1 : i - 1;
  return i;
}

}  // namespace

double turn_time(const MotorTrace& trace, std::size_t first, std::size_t last, double way) {
  const double middle = 0.5 * (static_cast<double>(first) + static_cast<double>(last));
  const std::size_t begin = away(trace, first, -1, way), end = away(trace, last, 1, way);
  const auto rows = static_cast<Eigen::Index>(end - begin + 1);
  Eigen::MatrixXd A(rows, 5);
  if (end - begin < signals::MotionLaw::kFewestRows) return middle;
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(&trace.x1[begin], rows);
  const double half = 0.5 * static_cast<double>(end - begin);  // columns of like size
  double turn = middle;
  double before = kInfinity;
  for (int k = 0; k < kMostSteps; ++k) {
    for (Eigen::Index r = 0; r < rows; ++r) {
      const double t = (static_cast<double>(begin) + static_cast<double>(r) - turn) / half;
      A.row(r) << 1.0, t, t * t, t * std::abs(t), t * t * t;
    }
    const Eigen::VectorXd c = signals::least_squares_of(A, x);
    const double step = -c(1) / (2.0 * c(2)) * half;
    if (!(std::abs(step) < before)) break;  // as near as the numbers tell, or nowhere
    before = std::abs(step);
    turn += step;
    if (!(turn >= static_cast<double>(begin) && turn <= static_cast<double>(end))) return middle;
  }
  const double stay = static_cast<double>(last - first) + 1.0;
  return std::abs(turn - middle) <= stay ? turn : middle;
}

Turn turn_by_law(const MotorTrace& trace, std::size_t from, std::size_t last, double guess, int direction,
                 double noise) {
  struct Trial {
    double turn, sse;
  };
  const std::size_t stride = (last - from) / kMostRowsOfTurn + 1;
  const double way = std::abs(trace.x1[last] - trace.x1[static_cast<std::size_t>(std::lround(guess))]);
  Turn best{guess};
  double least = kInfinity;
  const double rows = static_cast<double>((last - from) / stride + 1);
  for (const double share : kBends) {
    if (least < rows * noise * noise) break;  // noise alone leaves as much
    const auto trial = [&](double turn) {
      const signals::LawColumns law(trace, {from, last, turn, direction, share * way});
      const Eigen::MatrixXd A = law.rows(from, last, stride);
      const Eigen::VectorXd y = law.positions(from, last, stride);
      return Trial{turn, (A * signals::least_squares_of(A, y) - y).squaredNorm()};
    };
    const double asked = share > 0.0 ? kBendShows : 1.0;
    const Trial at_guess = trial(guess), found = least_sse(trial, guess - kTurnDoubt, guess + kTurnDoubt,
                                                           kTurnDoubt / 3.0, kFinestTurn);
    const Trial& to = at_guess.sse - found.sse > noise * noise ? found : at_guess;
    if (!(to.sse < least - asked * noise * noise)) continue;
    least = to.sse, best = {to.turn, share * way};
  }
  return best;
}

std::size_t farthest(const MotorTrace& trace, std::size_t first, std::size_t last, int side) {
  std::size_t found = first;
  for (std::size_t k = first; k <= last; ++k)
    if (side * trace.x1[k] >= side * trace.x1[found]) found = k;
  return found;
}

double turn_within(const MotorTrace& trace, std::size_t first, std::size_t latest, std::size_t last) {
  if (latest == first || latest == last) return static_cast<double>(latest);
  std::size_t earliest = latest;
  while (earliest > first && !(std::abs(trace.x1[earliest - 1] - trace.x1[latest]) > 0.0)) --earliest;
  return turn_time(trace, earliest, latest, kTurnWay * std::abs(trace.x1[last] - trace.x1[latest]));
}

}  // namespace gapscope::internal::sliding_mode
