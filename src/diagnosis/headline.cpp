#include "diagnosis/headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kWorthNaming = 0.25;  ///< strength of a pattern
constexpr double kOneSided = 0.65;     ///< share of one direction
constexpr double kDense = 1.5;         ///< times what an error without a place would have there

const MapShare& largest(const std::vector<MapShare>& map) {
  return *std::max_element(map.begin(), map.end(),
                           [](const MapShare& a, const MapShare& b) { return a.share < b.share; });
}

/// The bin with most of the error; of modes the one where it is densest, if that is clear.
std::string mode_words(const std::vector<MapShare>& mode, bool rotation) {
  const MapShare* chosen = &largest(mode);
  for (const MapShare& m : mode)
    if (m.expected > 0.0 && m.share > 0.2 && m.share / m.expected > kDense &&
        m.share / m.expected > chosen->share / std::max(chosen->expected, 1e-9))
      chosen = &m;
  if (chosen->expected >= 1.0) return "";  // there is but one mode
  const char* const where = chosen->bin == "impact" ? "at impacts"
                            : chosen->bin == "gap"  ? "in the gap"
                                                    : "in engagement";
  return fmt::format("{} ({:.0f} % of the squared residual {} in {:.0f} % of the time)", where,
                     100.0 * chosen->share, rotation ? "torque" : "force", 100.0 * chosen->expected);
}

std::string direction_words(const std::vector<MapShare>& direction) {
  const MapShare& most = largest(direction);
  if (most.share > kOneSided)
    return fmt::format("following the direction of motion, mostly in {} motion ({:.0f} %)", most.bin,
                       100.0 * most.share);
  return "following the direction of motion, alike forward and backward";
}

std::string angle_words(const MismatchPlace& p, bool rotation) {
  const char* const along = rotation ? "motor angle" : "motor position";
  if (!std::isfinite(p.periods_per_turn))
    return fmt::format("along the {}, most at {}", along, largest(p.angle).bin);
  if (!rotation)
    return fmt::format("periodic in the motor position, every {:.4g} m", 2.0 * kPi / p.periods_per_turn);
  return fmt::format("periodic in the motor angle with {:.3g} cycles per turn", p.periods_per_turn);
}

std::string pattern_words(Pattern pattern, const MismatchPlace& p, bool rotation) {
  switch (pattern) {
    case Pattern::kAngle:
      return angle_words(p, rotation);
    case Pattern::kDirection:
      return direction_words(p.direction);
    case Pattern::kSpeed:
      return fmt::format("along the speed, most at {}", largest(p.speed).bin);
    case Pattern::kInput:
      return fmt::format("along the input level, most at {}", largest(p.input).bin);
    case Pattern::kTime:
      return fmt::format("changing over time, most at {}", largest(p.time).bin);
    case Pattern::kInputSteps:
      return fmt::format("where the torque changes, most at {}", largest(p.frequency).bin);
    case Pattern::kCounts:
      return "within the count of a coarser encoder";
    case Pattern::kMode:
      break;
  }
  return "";
}

}  // namespace

Pattern pattern_of(const EffectEntry& effect) {
  if (effect.side == EffectSide::kContact && effect.parameters.size() == 1 &&
      effect.parameters[0].scale != Scale::kGapPerRecord)
    return Pattern::kMode;
  for (const EffectParameterSpec& p : effect.parameters) {
    const std::string key = p.key;
    if (key == "phase_rad" || p.scale == Scale::kPerTravel) return Pattern::kAngle;
    if (p.scale == Scale::kRecord || p.scale == Scale::kGapPerRecord) return Pattern::kTime;
    if (p.scale == Scale::kSample) return Pattern::kInputSteps;
    if (p.scale == Scale::kPeakInput) return Pattern::kInput;
    if (p.scale == Scale::kTorquePerSpeed2) return Pattern::kSpeed;
    if (p.scale == Scale::kQuantum) return Pattern::kCounts;
  }
  return effect.side == EffectSide::kMotor ? Pattern::kDirection : Pattern::kMode;
}

double cycles_of(const ModelEffect& effect) {
  if (pattern_of(*effect.entry) != Pattern::kAngle) return kNaN;
  for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i)
    if (effect.entry->parameters[i].scale == Scale::kPerTravel) return effect.parameters[i].value;
  return 1.0;
}

std::string headline_of(const MismatchPlace& place, const std::vector<PatternStrength>& patterns,
                        const ModelEffect* effect, bool rotation) {
  std::string text = mode_words(place.mode, rotation);
  const auto add = [&text](const std::string& words) {
    text += text.empty() || words.empty() ? words : ", " + words;
  };
  std::vector<Pattern> named;
  if (effect != nullptr) named.push_back(pattern_of(*effect->entry));
  const auto strongest = std::max_element(
      patterns.begin(), patterns.end(),
      [](const PatternStrength& a, const PatternStrength& b) { return a.strength < b.strength; });
  if (strongest != patterns.end() && strongest->strength > kWorthNaming &&
      std::find(named.begin(), named.end(), strongest->pattern) == named.end())
    named.push_back(strongest->pattern);
  for (const Pattern pattern : named) add(pattern_words(pattern, place, rotation));
  if (named.empty()) add("forward and backward, without a clear order in angle, speed, input or time");
  return text;
}

}  // namespace gapscope::internal::diagnosis
