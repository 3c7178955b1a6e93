#include "diagnosis/place.h"

#include <algorithm>

#include "diagnosis/numbers.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::diagnosis {
namespace {

const MapShare& largest(const std::vector<MapShare>& map) {
  return *std::max_element(map.begin(), map.end(),
                           [](const MapShare& a, const MapShare& b) { return a.share < b.share; });
}

}  // namespace

std::optional<ContactPhase> densest_phase(const std::vector<MapShare>& mode) {
  const MapShare* chosen = &largest(mode);
  for (const MapShare& m : mode)
    if (m.expected > 0.0 && m.share > kTelling.strength && m.share / m.expected > kTelling.dense &&
        m.share / m.expected > chosen->share / std::max(chosen->expected, 1e-9))
      chosen = &m;
  if (chosen->expected >= 1.0) return {};
  return static_cast<ContactPhase>(chosen - mode.data());  // the bins are in its order
}

double cycles_of(const ModelEffect& effect) {
  if (effect.entry->follows != ResidualPattern::kAngle) return kNaN;
  const int period = effect.entry->period_at();
  return period < 0 ? 1.0 : effect.parameters[static_cast<std::size_t>(period)].value;
}

std::vector<ResidualPattern> followed_patterns(const std::vector<PatternStrength>& patterns,
                                               const ModelEffect* effect) {
  std::vector<ResidualPattern> followed;
  if (effect != nullptr) followed.push_back(effect->entry->follows);
  const auto counts = [&](const PatternStrength& p) {
    return effect == nullptr || p.pattern != ResidualPattern::kTime ? p.strength : 0.0;
  };
  const auto strongest = std::max_element(
      patterns.begin(), patterns.end(),
      [&](const PatternStrength& a, const PatternStrength& b) { return counts(a) < counts(b); });
  if (strongest != patterns.end() && counts(*strongest) > kTelling.strength &&
      std::find(followed.begin(), followed.end(), strongest->pattern) == followed.end())
    followed.push_back(strongest->pattern);
  return followed;
}

std::optional<LackingWay> lacking_way(const std::vector<MapShare>& direction) {
  for (const MapShare& way : direction)
    if (way.expected < kTelling.hardly_any) return LackingWay{way.bin, !(way.expected > 0.0)};
  return {};
}

}  // namespace gapscope::internal::diagnosis
