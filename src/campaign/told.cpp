#include "campaign/told.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "results/sha256.h"

namespace gapscope::internal::campaign {
namespace {

/// " (1.25 of the plant's)" for a number that is not the plant's.
std::string how_far_off(const FittedParameter& p, const SimulatedPlant& plant) {
  constexpr double kSame = 1e-9;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    if (kDriveParameters[i].key != p.key || !has_parameter(plant.structure, i)) continue;
    const double own = drive_parameter(plant.drive, i);
    if (std::abs(p.value - own) <= kSame * std::abs(own)) return "";
    return own != 0.0 ? fmt::format(" ({:.3g} of the plant's)", p.value / own)
                      : fmt::format(" ({:.3g}, the plant has 0)", p.value);
  }
  return "";
}

bool has(const std::vector<EffectConfig>& effects, std::string_view name) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const EffectConfig& e) { return name == e.effect.entry->name; });
}

std::string_view bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

}  // namespace

std::string told_to(const FitSummary& fit, const Configuration& c) {
  std::vector<std::string> told;
  for (const std::string& key : fit.given())
    told.push_back(key + (c.simulation ? how_far_off(*fit.find(key), c.simulation->plant) : ""));
  return fmt::format("{}", fmt::join(told, ", "));
}

std::string lacked_by_model(const Configuration& c) {
  if (!c.simulation) return "";
  const SimulatedPlant& plant = c.simulation->plant;
  std::vector<std::string> lacks;
  for (const EffectConfig& e : plant.effects)
    if (const bool there = e.effect.parameters[0].value != 0.0;
        there && !has(c.model.effects, e.effect.entry->name))
      lacks.emplace_back(e.effect.entry->name);
  if (plant.structure.has_load && plant.structure.contact != c.model.structure.contact)
    lacks.emplace_back(plant.structure.contact == ContactLaw::kRigid ? "rigid contact" : "compliant contact");
  return fmt::format("{}", fmt::join(lacks, ", "));
}

std::string data_of(const std::vector<Recording>& recordings) {
  constexpr std::size_t kDigits = 16;
  std::string all;
  for (const Recording& r : recordings)
    for (const std::vector<double>* column : {&r.u, &r.x1}) all += sha256(bytes_of(*column));
  return sha256(all).substr(0, kDigits);
}

}  // namespace gapscope::internal::campaign
