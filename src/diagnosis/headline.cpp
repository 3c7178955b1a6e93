#include "diagnosis/headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/numbers.h"
#include "diagnosis/rule.h"
#include "gapscope/base/statistics.h"
#include "gapscope/base/text.h"

namespace gapscope::internal::diagnosis {
namespace {

const MapShare& largest(const std::vector<MapShare>& map) {
  return *std::max_element(map.begin(), map.end(),
                           [](const MapShare& a, const MapShare& b) { return a.share < b.share; });
}

constexpr std::string_view kDepends = "depends ";

/// By its odds, so that a phase which lasts most of the time can be it, too.
bool denser_than_chance(const MapShare& m) {
  return m.share * (1.0 - m.expected) > kTelling.dense * m.expected * (1.0 - m.share);
}

/// Most of it, and more than the time that they take: what the contact's law leaves rings on.
bool is_behind_impacts(const MismatchPlace& place) {
  return place.behind_impacts.share > 0.5 && denser_than_chance(place.behind_impacts);
}

std::string share_words(const MapShare& m, Coordinates coordinates) {
  return fmt::format(" ({:.0f} % of the squared correcting {} in {:.0f} % of the time)", 100.0 * m.share,
                     coordinates.torque_word(), 100.0 * m.expected);
}

std::string behind_impacts_words(const MismatchPlace& place, Coordinates coordinates) {
  return "at impacts and just behind them" + share_words(place.behind_impacts, coordinates);
}

std::string phase_words(const MismatchPlace& place, Coordinates coordinates) {
  static constexpr const char* kWhere[] = {"in the gap", "in engagement", "at impacts"};
  if (!place.phase) return "";
  const auto phase = static_cast<std::size_t>(*place.phase);
  const MapShare& m = place.mode[phase];
  if (!denser_than_chance(m) || !(m.share - m.expected > kTelling.beyond_chance)) return "";
  return kWhere[phase] + share_words(m, coordinates);
}

/// Of the one in which it is denser than the time that it takes, be it the smaller share; where neither is,
/// what depends on the direction can differ by its sign only.
std::string direction_words(const std::vector<MapShare>& direction, bool reverses, bool explained) {
  const auto dense = std::find_if(direction.begin(), direction.end(), denser_than_chance);
  const bool alike = dense == direction.end();
  const std::string words =
      alike || reverses ? "reverses with the direction of motion" : "depends on the direction of motion";
  if (alike || explained) return words;
  if (!(dense->share < 1.0)) return words + ", all of it " + dense->bin;
  const double here = dense->share / dense->expected, there = (1.0 - dense->share) / (1.0 - dense->expected);
  return fmt::format("{}, {:.2g} times as large {} (rms)", words, std::sqrt(here / there), dense->bin);
}

std::string angle_words(const MismatchPlace& p, Coordinates coordinates) {
  const char* const along = coordinates.rotational() ? "motor angle" : "motor position";
  if (!std::isfinite(p.periods_per_turn))
    return fmt::format("depends on the {} (largest at {})", along, range_words(largest(p.angle).bin));
  if (!coordinates.rotational())
    return "periodic in the motor position, every " + coordinates.thousandths(2.0 * kPi / p.periods_per_turn);
  const std::string cycles = fmt::format("{:.3g}", p.periods_per_turn);
  return "periodic in the motor angle" +
         (cycles == "1" ? ", once per turn" : " with " + cycles + " cycles per turn");
}

std::string pattern_words(ResidualPattern pattern, const MismatchPlace& p, Coordinates coordinates,
                          bool reverses, bool explained) {
  switch (pattern) {
    case ResidualPattern::kAngle:
      return angle_words(p, coordinates);
    case ResidualPattern::kDirection:
      return direction_words(p.direction, reverses, explained);
    case ResidualPattern::kSpeed:
      return fmt::format("depends on the speed (largest at {})", range_words(largest(p.speed).bin));
    case ResidualPattern::kInput:
      return fmt::format("depends on the input level (largest at {})", range_words(largest(p.input).bin));
    case ResidualPattern::kTime:
      return fmt::format("varies over the recording (largest at {})", range_words(largest(p.time).bin));
    case ResidualPattern::kInputSteps:
      return fmt::format("arises where the input {} changes", coordinates.torque_word());
    case ResidualPattern::kCounts:
      return "within the count of a coarser encoder";
    case ResidualPattern::kMode:
      break;
  }
  return "";
}

bool is_adjective(const std::string& words) {
  return words.starts_with("periodic") || words.starts_with("within");
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

std::string one_way_words(const std::vector<MapShare>& direction) {
  for (const MapShare& way : direction) {
    if (way.expected >= kTelling.hardly_any) continue;  // of the time in motion: nothing to compare with
    return way.expected > 0.0
               ? fmt::format("hardly any {} motion was recorded", way.bin)
               : fmt::format("only {} motion was recorded", way.bin == "forward" ? "backward" : "forward");
  }
  return "";
}

std::string headline_of(const MismatchPlace& place, Coordinates coordinates, bool reverses, bool explained) {
  std::string patterns;
  const std::string one_way = one_way_words(place.direction);
  for (const ResidualPattern pattern : place.follows) {
    if (pattern == ResidualPattern::kDirection && !one_way.empty()) continue;  // nothing to compare with
    const std::string words = pattern_words(pattern, place, coordinates, reverses, explained);
    const std::string joint = patterns.find(',') == patterns.npos ? " and " : ", and ";
    const bool again =
        patterns.starts_with(kDepends) && words.starts_with(kDepends);  // "depends on x and on y"
    const bool needs_verb =
        is_adjective(words) && !is_adjective(patterns);  // "varies with x and is periodic"
    patterns += patterns.empty() || words.empty()
                    ? words
                    : joint + (needs_verb ? "is " : "") + words.substr(again ? kDepends.size() : 0);
  }
  const std::string phase = phase_words(place, coordinates);
  if (place.follows.empty() && is_behind_impacts(place)) return behind_impacts_words(place, coordinates);
  if (place.follows.empty() || (patterns.empty() && phase.empty() && one_way.empty()))
    patterns = "no clear pattern in angle, speed, input or time";
  const std::string told = phase + (phase.empty() || patterns.empty() ? "" : ", ") + patterns;
  if (one_way.empty()) return told;
  return (told.empty() ? "no place that these recordings tell" : told) + "; " + one_way;
}

}  // namespace gapscope::internal::diagnosis
