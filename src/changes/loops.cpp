#include "changes/loops.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "signals/torque_cycles.h"

namespace gapscope::internal::changes {
namespace {

constexpr double kReach = 0.95;      ///< of the amplitude that a branch is followed over
constexpr double kSameRamps = 1.15;  ///< amplitudes of one level
constexpr std::size_t kSteps = 190;  ///< of a branch: a hundredth of the amplitude each
constexpr std::size_t kLoaded = 35;  ///< of them at its end: the flank, from 0.6 of the amplitude on
constexpr std::size_t kDrawn = 5;    ///< one step of so many is drawn
constexpr double kFree = 0.5;        ///< share of the lost motion over which x1 runs free: mostly

double variance_of_mean(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - centre) * (v - centre);
  const auto n = static_cast<double>(values.size());
  return sum / (n - 1.0) / n;
}

/// What the branches of one level say, one number each.
struct Branches {
  std::vector<double> rising, falling;  ///< ∫ x1 du along u from −A to A [rad · unit of u]
  std::vector<double> travel;           ///< [rad]
  std::vector<double> stiffness;        ///< [unit of u per rad]
  std::vector<double> up = std::vector<double>(kSteps + 1), down = up;  ///< sums of x1 along u [rad]

  void add(const std::vector<double>& along, double amplitude, bool rises) {
    const double step = 2.0 * amplitude / static_cast<double>(kSteps);
    double sum = 0.0;
    for (std::size_t k = 1; k < along.size(); ++k) sum += 0.5 * (along[k] + along[k - 1]) * step;
    // Of a falling branch both are counted the other way round: x1 there is −along.
    (rises ? rising : falling).push_back(rises ? sum : -sum);
    for (std::size_t k = 0; k <= kSteps; ++k)
      (rises ? up[k] : down[kSteps - k]) += rises ? along[k] : -along[k];
    travel.push_back(along.back() - along.front());
    const double flank = along.back() - along[along.size() - 1 - kLoaded];
    if (flank > 0.0) stiffness.push_back(step * static_cast<double>(kLoaded) / flank);
  }
  bool enough() const { return rising.size() > 1 && falling.size() > 1 && mean(travel) > 0.0; }
};

LoopMean mean_of(const std::vector<double>& values) {
  if (values.size() < 3) return {};
  return {mean(values),
          student_975(static_cast<double>(values.size()) - 1.0) * std::sqrt(variance_of_mean(values))};
}

/// The area of the loop over twice the travel.
LoopMean friction_of(const Branches& b) {
  const double per = 1.0 / (2.0 * mean(b.travel));
  const double freedom = static_cast<double>(b.rising.size() + b.falling.size()) - 2.0;
  const double error = std::sqrt(variance_of_mean(b.rising) + variance_of_mean(b.falling));
  return {(mean(b.falling) - mean(b.rising)) * per, student_975(freedom) * error * per};
}

/// Up and down again.
void draw(const Branches& b, double reach, LoopFacts& f) {
  const auto place = [&](std::size_t k) { return reach * (2.0 * double(k) / double(kSteps) - 1.0); };
  for (std::size_t k = 0; k <= kSteps; k += kDrawn)
    f.u.push_back(place(k)), f.x1.push_back(b.up[k] / double(b.rising.size()));
  for (std::size_t k = 0; k <= kSteps; k += kDrawn)
    f.u.push_back(place(kSteps - k)), f.x1.push_back(b.down[kSteps - k] / double(b.falling.size()));
  f.u.push_back(f.u.front()), f.x1.push_back(f.x1.front());
  const auto [low, high] = std::ranges::minmax(f.x1);
  const double middle = 0.5 * (low + high);
  for (double& x : f.x1) x -= middle;
}

void add_branches(const MotorTrace& trace, double level, Branches& all) {
  const signals::TorqueCycles cycles = signals::torque_cycles(trace);
  for (std::size_t k = 0; k < cycles.crossings.size(); ++k) {
    const signals::ZeroCrossing& c = cycles.crossings[k];
    const double least = std::min(c.before, c.after), most = std::max(c.before, c.after);
    if (least < level / kSameRamps || most > level * kSameRamps) continue;
    const double reach = kReach * std::min(least, level);
    const auto along = signals::branch_positions(trace, cycles, k, reach, kSteps);
    if (!along.empty()) all.add(along, reach, c.rising);
  }
}

}  // namespace

std::vector<LoopFacts> loop_facts(const LostMotion& lost_motion, const std::vector<Recording>& recordings) {
  std::vector<LoopFacts> facts;
  for (const LostMotionLevel& level : lost_motion.levels) {
    Branches branches;
    for (const Recording& r : recordings)
      if (!r.u.empty()) add_branches(r.motor_trace(), level.amplitude, branches);
    LoopFacts f;
    f.amplitude = level.amplitude;
    f.runs_free = level.free_run > kFree * level.lost_motion;
    if (branches.enough()) {
      f.friction = friction_of(branches), f.stiffness = mean_of(branches.stiffness);
      draw(branches, kReach * level.amplitude, f);
    }
    facts.push_back(f);
  }
  return facts;
}

}  // namespace gapscope::internal::changes
