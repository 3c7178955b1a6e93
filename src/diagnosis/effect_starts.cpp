#include "diagnosis/effect_starts.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::diagnosis {
namespace {

using Starts = std::vector<EffectStart>;

/// All four quarters of a phase, for amplitude `a`.
Starts quarters(std::initializer_list<double> amplitudes) {
  Starts starts;
  for (const double a : amplitudes)
    for (const double quarter : {0.0, 0.5, 1.0, 1.5}) starts.push_back({a, quarter * kPi});
  return starts;
}

const std::map<std::string_view, Starts>& table() {
  static const std::map<std::string_view, Starts> rows = {
      {"actuator_lag", {{0.7}, {3.0}, {10.0}}},
      {"backlash", {{0.02, 0.5}, {0.1, 0.5}}},
      {"cogging_torque", {{0.05, kNaN, kNaN}}},
      {"constant_load_torque", {{0.05}, {-0.05}}},
      {"contact_adhesion", {{0.05}, {0.2}}},
      {"encoder_eccentricity", quarters({0.002, 0.02})},
      {"friction_asymmetry",
       {{0.08, 0.3, 0.15}, {0.08, -0.3, -0.15}, {0.08, 0.3, -0.15}, {0.08, -0.3, 0.15}}},
      {"gap_eccentricity", quarters({0.15})},
      {"gap_growth", {{0.3}, {-0.3}}},
      {"impact_damping", {{0.4}, {2.5}}},
      {"input_dead_zone", {{0.03}, {0.12}}},
      {"input_delay", {{0.7}, {3.0}, {10.0}}},
      {"load_inertia_variation", {{0.4, 0.25, 0.15}, {0.4, 0.4, 0.15}, {0.4, 0.6, 0.15}, {-0.3, 0.4, 0.15}}},
      {"load_unbalance", quarters({0.08})},
      {"measurement_lag", {{0.7}, {3.0}, {10.0}}},
      {"motor_coulomb_friction", {{0.02}, {0.1}}},
      {"presliding_friction", {{0.05, 0.02, 0.001}, {0.15, 0.03, 0.003}, {0.1, 0.01, 0.001}}},
      {"quadratic_drag", {{0.1, 2.0}, {0.4, 2.0}}},
      {"shaft_compliance", {{0.5}, {2.0}}},
      {"stribeck_friction", {{0.05, 0.8, 0.1, 1.5}, {0.1, 0.8, 0.25, 1.5}}},
      {"torque_ripple", {{0.1, kNaN, kNaN}}},
      {"torque_saturation", {{1.0, 3.0}, {2.5, 3.0}}},
      {"viscous_drift", {{0.4, 0.4}, {-0.3, 0.4}}},
  };
  return rows;
}

}  // namespace

std::vector<EffectStart> effect_starts(const EffectEntry& entry) {
  if (const auto row = table().find(entry.name); row != table().end()) return row->second;
  EffectStart start{};
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const EffectParameterSpec& p = entry.parameters[i];
    start[i] = p.low + 0.1 * (p.high - p.low);
  }
  return {start};
}

const EffectEntry* nested_parent(const EffectEntry& entry) {
  const std::string_view name = entry.name;
  if (name == "friction_asymmetry" || name == "stribeck_friction" || name == "presliding_friction")
    return find_effect("motor_coulomb_friction");
  return nullptr;
}

bool law_is_fixed(const EffectEntry& entry) {
  static constexpr std::string_view kFixed[] = {"actuator_lag",     "input_delay",    "measurement_lag",
                                                "shaft_compliance", "impact_damping", "constant_load_torque",
                                                "load_unbalance",   "input_dead_zone"};
  return std::find(std::begin(kFixed), std::end(kFixed), entry.name) != std::end(kFixed);
}

}  // namespace gapscope::internal::diagnosis
