#include "blind/expected_place.h"

#include <algorithm>
#include <cmath>

#include "gapscope/plant/effect.h"

namespace gapscope::blind {
namespace {

constexpr double kCyclesWithin = 0.05;

bool is_told(const std::vector<std::string>& told, ResidualPattern pattern) {
  return std::find(told.begin(), told.end(), to_string(pattern)) != told.end();
}

}  // namespace

ToldPlace told_place(const MismatchPlace& place) {
  ToldPlace told;
  if (place.phase) told.phase = to_string(*place.phase);
  for (const ResidualPattern pattern : place.follows) told.follows.emplace_back(to_string(pattern));
  if (is_told(told.follows, ResidualPattern::kAngle)) told.periods_per_turn = place.periods_per_turn;
  return told;
}

bool names_the_place(const ToldPlace& told, const std::string& effect, double cycles_per_turn) {
  const EffectEntry* entry = find_effect(effect);
  if (entry == nullptr) return false;
  if (entry->follows == ResidualPattern::kMode)
    return std::any_of(entry->acts_in.begin(), entry->acts_in.end(),
                       [&](ContactPhase phase) { return told.phase == to_string(phase); });
  if (!is_told(told.follows, entry->follows)) return false;
  return entry->follows != ResidualPattern::kAngle ||
         std::abs(told.periods_per_turn / cycles_per_turn - 1.0) < kCyclesWithin;
}

}  // namespace gapscope::blind
