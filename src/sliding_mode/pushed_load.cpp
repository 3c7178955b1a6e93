#include "sliding_mode/pushed_load.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sliding_mode/least_squares.h"
#include "sliding_mode/turn.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// How well the law must hold, and how badly one without g(x). Eight own rigs (docs/science.md, section 6)
/// read the same with half and double of either, but that half of the first takes two pushed passages of
/// eleven of one of them for right ones (21.15 instead of 21.11 mrad, both within the interval).
constexpr double kLeavesOver = 2.0;  ///< over the noise
constexpr double kFarBetter = 3.0;   ///< over what the law leaves over

// What a regression needs, not tuned: where bounces have faded is asked in turn, and the least that leaves
// the law of seven shared numbers samples and strokes to be contradicted by.
constexpr double kSkippedForBounces[] = {0.15, 0.3, 0.45, 0.6};  ///< of a stroke, at its beginning
constexpr double kBeforeTurn = 0.02;                             ///< of a stroke, left out at its end
constexpr std::size_t kFewestOfStroke = 24;                      ///< samples
constexpr std::size_t kFewestStrokes = 4;
constexpr std::size_t kLeftOut = 4;  ///< groups of strokes, in turn: the rest must say the same

constexpr int kStrokeOwn = 2;      ///< numbers of each stroke: place and speed
constexpr int kSteadyNumbers = 4;  ///< b', −a', −f', g(centre)
constexpr int kOfPlace = 3;        ///< orders of g
constexpr int kStrokeShared = kSteadyNumbers + kOfPlace, kStrokeColumns = kStrokeOwn + kStrokeShared + 1;

/// Of both bodies in contact, up to the turn from which a passage begins.
struct EngagedStroke {
  Transition* passage;
  std::size_t first, last, turn;
};

using ReducedStroke = Eigen::Matrix<double, kStrokeColumns - kStrokeOwn, kStrokeColumns - kStrokeOwn>;

std::vector<EngagedStroke> engaged_strokes(const MotorTrace& trace, std::vector<Transition>& passages,
                                           double skipped) {
  std::vector<EngagedStroke> found;
  const auto sample = [&](double time) { return (time - trace.start) / trace.dt; };
  for (std::size_t i = 1; i < passages.size(); ++i) {
    const double begin = sample(passages[i - 1].event.t2), end = sample(passages[i].event.t2);
    if (!(begin > 0.0) || !(end > begin) || passages[i].event.direction == passages[i - 1].event.direction)
      continue;
    const std::size_t turn = farthest(trace, static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
                                      -passages[i].event.direction);
    const double length = static_cast<double>(turn) - begin;
    const auto first = static_cast<std::size_t>(begin + skipped * length);
    const auto last = static_cast<std::size_t>(static_cast<double>(turn) - kBeforeTurn * length);
    if (last > first + kFewestOfStroke) found.push_back({&passages[i], first, last, turn});
  }
  return found;
}

/// p: of half the travel, from its centre.
double place(const signals::SignalFacts& facts, double x1) { return (x1 - facts.centre) / facts.amplitude; }

/// The regression of one stroke, without what is its own: upper triangle.
ReducedStroke reduce_stroke(const MotorTrace& trace, const signals::SignalFacts& facts,
                            const EngagedStroke& s) {
  const auto rows = static_cast<Eigen::Index>(s.last - s.first + 1);
  Eigen::MatrixXd A(rows, kStrokeColumns);
  const double dt = trace.dt, way = -s.passage->event.direction;
  Eigen::Matrix<double, kStrokeShared, 1> once = Eigen::Matrix<double, kStrokeShared, 1>::Zero(),
                                          twice = once;
  for (Eigen::Index r = 0; r < rows; ++r) {
    const std::size_t i = s.first + static_cast<std::size_t>(r);
    A.row(r) << 1.0, static_cast<double>(r) * dt, twice.transpose(), trace.x1[i] - trace.x1[s.first];
    const double u = trace.u[i], p = place(facts, trace.x1[i]);
    Eigen::Matrix<double, kStrokeShared, 1> now;
    now << u, 0.0, way, 1.0, p, p * p, p * p * p;
    twice += (once + 0.5 * dt * now) * dt;
    once += now * dt;
    twice(1) += (0.5 * (trace.x1[i] + trace.x1[std::min(i + 1, trace.size() - 1)]) - trace.x1[s.first]) * dt;
  }
  return triangle_of(A).bottomRightCorner<kStrokeColumns - kStrokeOwn, kStrokeColumns - kStrokeOwn>();
}

/// ẍ = b'·u − a'·ẋ − f'·sign(ẋ) + g(x), of both bodies.
struct PlaceLaw {
  Eigen::Matrix<double, kStrokeShared, 1> numbers = Eigen::Matrix<double, kStrokeShared, 1>::Zero();
  double squares = 0.0;  ///< left over [rad²]

  double dry() const { return -numbers(2); }  ///< f' [rad/s²]
  /// @param p  place, of half the travel from its centre   @returns g [rad/s²]
  double force(double p) const { return numbers(3) + p * (numbers(4) + p * (numbers(5) + p * numbers(6))); }
  bool is_of_a_drive() const { return numbers(0) > 0.0 && numbers(1) <= 0.0; }
};

/// Least squares with the first so many columns.  @param left_out  group; kLeftOut: none
PlaceLaw solve_strokes(const std::vector<ReducedStroke>& reduced, int columns, std::size_t left_out) {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(reduced.size()) * ReducedStroke::RowsAtCompileTime, columns);
  Eigen::VectorXd y(A.rows());
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < reduced.size(); ++k) {
    if (k % kLeftOut == left_out) continue;
    A.middleRows(at, ReducedStroke::RowsAtCompileTime) = reduced[k].leftCols(columns);
    y.segment(at, ReducedStroke::RowsAtCompileTime) = reduced[k].col(kStrokeShared);
    at += ReducedStroke::RowsAtCompileTime;
  }
  A.conservativeResize(at, Eigen::NoChange);
  y.conservativeResize(at);
  const Eigen::VectorXd scale = A.colwise().norm().transpose().cwiseMax(1e-300);
  A = A * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd scaled = least_squares_of(A, y);
  PlaceLaw law;
  law.squares = (A * scaled - y).squaredNorm();
  law.numbers.head(columns) = scaled.cwiseQuotient(scale);
  return law;
}

/// What tells that a force exceeds the friction: the law of all strokes, and those without some of them.
struct PushedStrokes {
  std::vector<EngagedStroke> strokes;
  std::vector<PlaceLaw> laws;

  bool pushes(const signals::SignalFacts& facts, const MotorTrace& trace, const EngagedStroke& s) const {
    const double p = place(facts, trace.x1[s.turn]);
    return std::ranges::all_of(laws, [&](const PlaceLaw& law) {
      return law.is_of_a_drive() && s.passage->event.direction * law.force(p) > std::abs(law.dry());
    });
  }
};

/// Of strokes that a law with g(x) follows, and none without; nothing where there is none.
std::optional<PushedStrokes> fit_strokes(const MotorTrace& trace, const signals::SignalFacts& facts,
                                         std::vector<Transition>& passages, double skipped) {
  PushedStrokes fit{engaged_strokes(trace, passages, skipped), {}};
  if (fit.strokes.size() < kFewestStrokes) return {};
  std::vector<ReducedStroke> reduced;
  double freedom = -kStrokeShared;
  for (const EngagedStroke& s : fit.strokes) {
    reduced.push_back(reduce_stroke(trace, facts, s));
    freedom += static_cast<double>(s.last - s.first + 1) - kStrokeOwn;
  }
  const PlaceLaw with = solve_strokes(reduced, kStrokeShared, kLeftOut);
  const PlaceLaw without = solve_strokes(reduced, kSteadyNumbers, kLeftOut);
  const double most = kLeavesOver * facts.noise;
  if (with.squares > most * most * freedom || without.squares < kFarBetter * kFarBetter * with.squares)
    return {};
  fit.laws.push_back(with);
  for (std::size_t g = 0; g < kLeftOut; ++g) fit.laws.push_back(solve_strokes(reduced, kStrokeShared, g));
  return fit;
}

}  // namespace

void refuse_pushed_loads(const MotorTrace& trace, const signals::SignalFacts& facts,
                         std::vector<Transition>& passages) {
  for (const double skipped : kSkippedForBounces) {
    const auto fit = fit_strokes(trace, facts, passages, skipped);
    if (!fit) continue;
    for (const EngagedStroke& s : fit->strokes)
      if (s.passage->refusal == Refusal::kNone && fit->pushes(facts, trace, s))
        s.passage->refusal = Refusal::kPushed;
    return;
  }
}

}  // namespace gapscope::internal::sliding_mode
