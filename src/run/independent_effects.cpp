#include "run/independent_effects.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "base/require.h"

namespace gapscope::internal::run {
namespace {

using Values = std::array<double, kMostEffectParameters>;

struct StatedAlike {
  const char* effect;
  void (*apply)(const Values& p, independent_plant::Effects& e);
};

constexpr StatedAlike kStatedAlike[] = {
    {"contact_adhesion", [](const Values& p, independent_plant::Effects& e) { e.contact.release_nm = p[0]; }},
    {"contact_hardening",
     [](const Values& p, independent_plant::Effects& e) {
       e.contact.hardening_per_rad2 = p[0] / (p[1] * p[1]);
       e.contact.hardening_knee_rad = p[1];
     }},
    {"motor_coulomb_friction",
     [](const Values& p, independent_plant::Effects& e) { e.motor.friction.level_nm = p[0]; }},
    {"presliding_friction",
     [](const Values& p, independent_plant::Effects& e) {
       e.motor.bristle = {p[0], p[1], p[2]};
     }},
    {"stribeck_friction", [](const Values& p, independent_plant::Effects& e) {
       e.motor.friction.level_nm = p[0];
       e.motor.friction.stiction_ratio = p[1];
       e.motor.friction.stribeck_speed_rad_s = p[2];
       e.motor.friction.stribeck_exponent = p[3];
     }}};

}  // namespace

independent_plant::Effects independent_effects(const std::vector<EffectConfig>& effects) {
  independent_plant::Effects all;
  for (const EffectConfig& e : effects) {
    const auto known = std::find_if(std::begin(kStatedAlike), std::end(kStatedAlike), [&](const auto& k) {
      return std::string_view(k.effect) == e.effect.entry->name;
    });
    GAPSCOPE_REQUIRE(known != std::end(kStatedAlike));
    Values values{};
    std::transform(e.effect.parameters.begin(), e.effect.parameters.end(), values.begin(),
                   [](const ParameterSetting& p) { return p.value; });
    known->apply(values, all);
  }
  return all;
}

}  // namespace gapscope::internal::run
