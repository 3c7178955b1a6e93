#include "telling/headline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/numbers.h"
#include "diagnosis/place.h"

namespace gapscope::internal::telling {
namespace {

using diagnosis::kTelling;

const MapShare& largest(const std::vector<MapShare>& map) {
  return *std::ranges::max_element(map, {}, &MapShare::share);
}

/// By its odds, so that a phase which lasts most of the time can be it, too.
bool denser_than_chance(const MapShare& m) {
  return m.share * (1.0 - m.expected) > kTelling.dense * m.expected * (1.0 - m.share);
}

/// Most of it, and more than the time that they take: what the contact's law leaves rings on.
bool is_behind_impacts(const MismatchPlace& place) {
  return place.follows.empty() && place.behind_impacts.share > 0.5 &&
         denser_than_chance(place.behind_impacts);
}

std::string share_words(const MapShare& m, Coordinates coordinates) {
  return fmt::format(" ({:.0f} % of the squared correcting {} in {:.0f} % of the time)", 100.0 * m.share,
                     coordinates.torque_word(), 100.0 * m.expected);
}

/// Where the contact is; empty where it tells nothing.
std::string phase_words(const MismatchPlace& place, Coordinates coordinates) {
  static constexpr const char* kWhere[] = {"is largest in the gap", "is largest in engagement",
                                           "is largest at impacts"};
  if (is_behind_impacts(place))
    return "is largest at impacts and just behind them" + share_words(place.behind_impacts, coordinates);
  if (!place.phase) return "";
  const auto phase = static_cast<std::size_t>(*place.phase);
  const MapShare& m = place.mode[phase];
  if (!denser_than_chance(m) || !(m.share - m.expected > kTelling.beyond_chance)) return "";
  return kWhere[phase] + share_words(m, coordinates);
}

/// Of the direction in which it is denser than the time that it takes, be it the smaller share; where neither
/// is, what depends on the direction can differ by its sign only.
std::string direction_words(const MismatchPlace& p) {
  const auto dense = std::ranges::find_if(p.direction, denser_than_chance);
  const bool alike = dense == p.direction.end();
  const std::string words =
      alike || p.reverses ? "reverses with the direction of motion" : "depends on the direction of motion";
  if (alike || p.explained) return words;
  if (!(dense->share < 1.0)) return words + ", all of it " + dense->bin;
  const double here = dense->share / dense->expected, there = (1.0 - dense->share) / (1.0 - dense->expected);
  return fmt::format("{}, {:.2g} times as large {} (rms)", words, std::sqrt(here / there), dense->bin);
}

std::string angle_words(const MismatchPlace& p, Coordinates coordinates, EncoderSide encoder) {
  const std::string along = std::string(encoder == EncoderSide::kLoad ? "load " : "motor ") +
                            (coordinates.rotational() ? "angle" : "position");
  if (!std::isfinite(p.periods_per_turn))
    return fmt::format("depends on the {} (largest at {})", along, range_words(largest(p.angle).bin));
  if (!coordinates.rotational())
    return fmt::format("is periodic in the {}, every {}", along,
                       coordinates.thousandths(2.0 * kPi / p.periods_per_turn));
  const std::string cycles = fmt::format("{:.3g}", p.periods_per_turn);
  return fmt::format("is periodic in the {}{}", along,
                     cycles == "1" ? ", once per turn" : " with " + cycles + " cycles per turn");
}

std::string pattern_words(ResidualPattern pattern, const MismatchPlace& p, Coordinates coordinates,
                          EncoderSide encoder) {
  switch (pattern) {
    case ResidualPattern::kAngle:
      return angle_words(p, coordinates, encoder);
    case ResidualPattern::kDirection:
      return diagnosis::lacking_way(p.direction) ? "" : direction_words(p);  // nothing to compare with
    case ResidualPattern::kSpeed:
      return fmt::format("depends on the speed (largest at {})", range_words(largest(p.speed).bin));
    case ResidualPattern::kInput:
      return fmt::format("depends on the input level (largest at {})", range_words(largest(p.input).bin));
    case ResidualPattern::kTime:
      return fmt::format("varies over the recording (largest at {})", range_words(largest(p.time).bin));
    case ResidualPattern::kInputSteps:
      return fmt::format("arises where the input {} changes", coordinates.torque_word());
    case ResidualPattern::kCounts:
      return "is within the count of a coarser encoder";
    case ResidualPattern::kMode:
      break;
  }
  return "";
}

/// "only forward motion was recorded"; empty where both ways were.
std::string one_way_words(const MismatchPlace& place) {
  const auto lacking = diagnosis::lacking_way(place.direction);
  if (!lacking) return "";
  return lacking->none
             ? fmt::format("only {} motion was recorded", lacking->way == "forward" ? "backward" : "forward")
             : fmt::format("hardly any {} motion was recorded", lacking->way);
}

}  // namespace

std::string headline_of(const MismatchPlace& place, Coordinates coordinates, EncoderSide encoder) {
  std::vector<std::string> told;
  const auto put = [&](std::string words) {
    if (!words.empty()) told.push_back(std::move(words));
  };
  put(phase_words(place, coordinates));
  for (const ResidualPattern pattern : place.follows)
    put(pattern_words(pattern, place, coordinates, encoder));
  const std::string one_way = one_way_words(place);
  if (told.empty())
    put(one_way.empty() ? "has no clear pattern in angle, speed, input or time"
                        : "has no pattern that these recordings show");
  const std::string text = fmt::format("{}", fmt::join(told, ", and "));
  return one_way.empty() ? text : text + "; " + one_way;
}

}  // namespace gapscope::internal::telling
