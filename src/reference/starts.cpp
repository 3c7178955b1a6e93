#include "reference/starts.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "reference/excerpt.h"
#include "signals/local_motion.h"

namespace gapscope::internal::reference {
namespace {

constexpr std::size_t kDrawsPerPoint = 3;    ///< looked at by plain runs
constexpr std::size_t kDrawsOfImpacts = 10;  ///< the same of a free load, each of whose impacts makes minima
constexpr double kLooked = 0.25;             ///< share of the recordings that is looked at
constexpr double kNearFactor = 3.0;          ///< draws around a given value
constexpr double kFarFactor = 8.0;           ///< draws around a derived one
/// Draws of an effect of which nothing is known, from so much of what is usual on: a motor may have next to
/// no dry friction. Draws about what is usual find 18 of 24 drives without any (`study_reference 590001 24
/// unknown 5`), these 20, as many as a model without it does.
constexpr double kNearlyAbsent = 0.01;
/// Times the derived stiffness about which that of a contact is drawn: teeth wind up by a smaller part of
/// their gap. With 1 a rig of 3000 N m/rad behind 8 mrad is rejected at 102 floors, with 6 it reads 7.998
/// mrad; of `study_reference 590001 24 rubs 5` and `unknown 5` 42 gaps of 48 are in their intervals, with 1
/// it is 40.
constexpr double kStiffer = 6.0;

/// A later variant must lower the cost to this share. A load that slides to rest within the gap leaves only
/// the place where it stops, so a start in motion there is not to be preferred for a trifle.
constexpr double kClearlyBetter = 0.98;

/// A load "at the edge" starts this far inside [scales]: exactly at the edge and at rest, the contact closes
/// at no definite time, and derivatives with it.
constexpr double kInside = 0.02;

/// A gap, as a share of the travel; of a typical swing where a drive turns on so many times farther as it
/// swings. Of twelve drives of the tests' plant that travel 10 to 24 swings 11 are found for 8 (two of them
/// are RubbingMotor.AGapIsFoundInATravelOfManySwings). With the swing everywhere the draws of a drive that
/// swings about one place change, too, and one of the tests ends beside its minimum.
constexpr Interval kGapOfWay = {0.003, 0.8};
constexpr double kTurnsOn = 2.0;

/// What moves divides between motor and load: a motor's share of it, and how well their sum is known.
constexpr Interval kMotorShare = {0.1, 0.95};
constexpr double kSumFactor = 1.4;

/// What a gap is small or large beside [rad].
double way_of(const signals::OneBody& rough) {
  return rough.travel > kTurnsOn * rough.stroke ? rough.stroke : rough.travel;
}

/// @param seeded  about another estimate of the gap, where there is one
Interval draw_range(const FitProblem& problem, const Parameter& p, bool seeded) {
  const double read = seeded ? problem.options.gap_seed.value_or(0.0) : 0.0;
  if (p.id == drive_number(place::kGap) && !p.given && read > 0.0)
    return {read / kNearFactor, read * kNearFactor};
  if (p.id == drive_number(place::kGap) && !p.given)
    return {kGapOfWay.low * way_of(problem.rough), kGapOfWay.high * way_of(problem.rough)};
  if (p.id == drive_number(place::kMotorInertia) && !p.given && problem.inertia > 0.0)
    return {kMotorShare.low * problem.inertia, kMotorShare.high * problem.inertia};
  if (p.amount && !p.given) return {kNearlyAbsent * p.start, p.start};
  const double factor = p.given ? kNearFactor : kFarFactor;
  return {p.start / factor, p.start * factor};
}

/// Where a number of the drive starts, which is its value if it is not searched.
double drive_start(const FitProblem& problem, int number) {
  const auto p = std::ranges::find(problem.parameters, drive_number(number), &Parameter::id);
  return p->start;
}

/// A derived stiffness goes with the gap that was drawn: the wind-up of a contact is a part of its gap, of
/// whatever travel.
std::vector<double> drawn(const FitProblem& problem, bool seeded, std::mt19937_64& generator) {
  std::vector<double> q;
  double narrower = 1.0;  // the drawn gap than the derived one, which goes before
  double motor = drive_start(problem, place::kMotorInertia);
  for (std::size_t i = 0; i < problem.free_count(); ++i) {
    const Parameter& p = problem.free_parameter(i);
    const Interval range = draw_range(problem, p, seeded);
    double value = range.low > 0.0 ? log_uniform(generator, range.low, range.high) : p.start;
    if (p.id == drive_number(place::kMotorInertia)) motor = value;
    if (p.id == drive_number(place::kMassRatio) && !p.given && problem.inertia > 0.0)
      value = std::max(problem.inertia / motor - 1.0, 1.0 / kFarFactor) *
              log_uniform(generator, 1.0 / kSumFactor, kSumFactor);
    if (p.id == drive_number(place::kGap) && !p.given) narrower = p.start / value;
    if (p.id == drive_number(place::kContactStiffness) && !p.given) value *= narrower * kStiffer;
    q.push_back(p.coordinate.solver(std::clamp(value, p.low, p.high)));
  }
  return q;
}

std::vector<double> given_values(const FitProblem& problem) {
  std::vector<double> q;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    q.push_back(problem.free_parameter(i).coordinate.solver(problem.free_parameter(i).start));
  return q;
}

/// A motor behind a resting load need not rest: without friction of its own its speed is open.
std::vector<InitialVariant> variants_of_motor(const FitProblem& problem) {
  std::vector<InitialVariant> variants{{0, true}, {-1, true}, {1, true}};
  if (problem.motor_may_stick) variants.push_back({0, false});
  return variants;
}

/// What a controller that acts later had sent before the first row is not known. Its impulse until the first
/// output acts is a change of the initial speed, which is looked for then, even of a drive that stands.
bool pushed_by_what_came_before(const FitProblem& problem, const MotorTrace& recording) {
  return problem.delays || !recording.sent.empty();
}

}  // namespace

std::vector<InitialVariant> initial_variants(const FitProblem& problem, const RecordingStart& start) {
  if (!problem.structure.has_load) return {{0, false}};
  if (problem.structure.reads_load()) return variants_of_motor(problem);
  if (problem.locked() || !start.moves) return {{0, false}, {-1, false}, {1, false}};
  return {{0, false}, {0, true}, {-1, true}, {1, true}};
}

FitPoint start_point(const FitProblem& problem, std::vector<double> q) {
  FitPoint point;
  point.q = std::move(q);
  const ModelNumbers<double> numbers = problem.numbers(point.q.data());
  const double gap = numbers.drive(place::kGap);
  const double length = std::max(gap, 1e-3 * problem.rough.travel);
  for (std::size_t r = 0; r < problem.recordings.size(); ++r) {
    const double floor = problem.floors[r];
    const signals::LocalMotion motion = signals::local_motion(problem.recordings[r], floor);
    RecordingStart start;
    start.x1 = motion.x;
    start.moves = std::abs(motion.w) > std::max(4.0 * motion.w_std, 1e-3 * problem.rough.speed) ||
                  pushed_by_what_came_before(problem, problem.recordings[r]);
    start.w1 = start.moves ? motion.w : 0.0;
    const double speed = std::max({problem.rough.speed, std::abs(motion.w), motion.w_std});
    start.scale = {10.0 * floor, std::max(3.0 * motion.w_std, 0.02 * speed), 0.1 * length, 0.2 * speed};
    start.variant = initial_variants(problem, start).front();
    point.starts.push_back(start);
  }
  return point;
}

Placement choose_variants(const FitProblem& problem, const FitPoint& at, double observer_hz) {
  Placement placed{at.starts, false, 0.0};
  if (!problem.structure.has_load && observer_hz > 0.0) return placed;  // the only body is where it is read
  const auto square_from = [&](std::size_t r, const RecordingStart& start) {
    const Square square = recording_square(problem, at.q, r, start, observer_hz);
    placed.simulations += square.simulations;
    return square.value;
  };
  for (std::size_t r = 0; r < at.starts.size(); ++r) {
    double best = square_from(r, at.starts[r]);
    for (const InitialVariant& variant : initial_variants(problem, at.starts[r])) {
      RecordingStart start = placed.starts[r];
      start.variant = variant;
      start.q.fill(0.0);
      start.q[2] = -kInside * variant.side;
      const double cost = square_from(r, start);
      if (!(cost < kClearlyBetter * best)) continue;
      best = cost;
      placed.starts[r] = start;
      placed.changed = true;
    }
  }
  return placed;
}

bool values_are_given(const FitProblem& problem) {
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    if (!problem.free_parameter(i).given) return false;
  return true;
}

FitPoint given_point(const FitProblem& problem) { return start_point(problem, given_values(problem)); }

StartPoints drawn_points(const FitProblem& problem, std::size_t count) {
  auto generator = random_stream(problem.options.seed, "fit starts");
  StartPoints found;
  const Excerpt part(problem, kLooked);
  const double hz = problem.options.observer_hz;
  const bool impacts = problem.structure.has_load && !problem.locked() && !values_are_given(problem);
  const std::size_t looked = impacts ? kDrawsOfImpacts : kDrawsPerPoint;
  for (std::size_t i = 0; i < looked * count; ++i) {
    Solution p{start_point(problem, drawn(problem, i % 2 == 0, generator))};
    const Placement placed = choose_variants(part.problem(), p, hz);
    p.starts = placed.starts;
    const Square square = mean_square_with_priors(part.problem(), p, hz);
    p.mean_square_with_priors = square.value;
    found.simulations += part.of_whole(placed.simulations + square.simulations);
    if (p.usable()) found.points.push_back(std::move(p));
  }
  std::stable_sort(found.points.begin(), found.points.end(), leaves_less);
  found.points.resize(std::min(found.points.size(), count));
  return found;
}

}  // namespace gapscope::internal::reference
