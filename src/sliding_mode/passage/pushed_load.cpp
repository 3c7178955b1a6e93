#include "sliding_mode/passage/pushed_load.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "signals/motion_law.h"
#include "sliding_mode/passage/turn.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// How well the law must hold, and how badly one without g(x). Eight own rigs (docs/record/detector.md)
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

/// Of both bodies in contact, up to the turn from which a passage begins.
struct EngagedStroke {
  Passage* passage;
  std::size_t first, last, turn;
};

std::vector<EngagedStroke> engaged_strokes(const MotorTrace& trace, std::vector<Passage>& passages,
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

/// What tells that a force exceeds the friction: the law of all strokes, and those without some of them.
struct PushedStrokes {
  std::vector<EngagedStroke> strokes;
  std::vector<signals::MotionLaw> laws;

  bool pushes(const MotorTrace& trace, const EngagedStroke& s) const {
    return std::ranges::all_of(laws, [&](const signals::MotionLaw& law) {
      return law.drive() > 0.0 && law.viscous() >= 0.0 &&
             s.passage->event.direction * law.force(trace.x1[s.turn]) > std::abs(law.dry());
    });
  }
};

/// Of strokes that a law with g(x) follows, and none without; nothing where there is none.
std::optional<PushedStrokes> fit_strokes(const MotorTrace& trace, const signals::SignalFacts& facts,
                                         std::vector<Passage>& passages, double skipped) {
  PushedStrokes fit{engaged_strokes(trace, passages, skipped), {}};
  if (fit.strokes.size() < kFewestStrokes) return {};
  std::vector<signals::LawStretch> stretches;
  for (const EngagedStroke& s : fit.strokes)
    stretches.push_back({s.first, s.last, static_cast<double>(s.first), -s.passage->event.direction});
  const auto law = [&](int powers) {
    return signals::MotionLaw(trace, stretches, signals::MotionLaw::Friction::kAny,
                              {powers, facts.centre, facts.amplitude});
  };
  const signals::MotionLaw with = law(signals::LawColumns::kMostPowers), without = law(1);
  if (with.rms() > kLeavesOver * facts.noise || without.squares() < kFarBetter * kFarBetter * with.squares())
    return {};
  fit.laws.push_back(with);
  for (std::size_t g = 0; g < kLeftOut; ++g) fit.laws.push_back(with.without(g, kLeftOut));
  return fit;
}

}  // namespace

void refuse_pushed_loads(const MotorTrace& trace, const signals::SignalFacts& facts,
                         std::vector<Passage>& passages) {
  for (const double skipped : kSkippedForBounces) {
    const auto fit = fit_strokes(trace, facts, passages, skipped);
    if (!fit) continue;
    for (const EngagedStroke& s : fit->strokes)
      if (s.passage->refusal == Refusal::kNone && fit->pushes(trace, s)) refuse(*s.passage, Refusal::kPushed);
    return;
  }
}

}  // namespace gapscope::internal::sliding_mode
