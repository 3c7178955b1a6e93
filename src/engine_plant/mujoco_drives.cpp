#include "engine_plant/mujoco_plant.h"

namespace gapscope::engine_plant {

std::span<const std::string_view> mujoco_effects() {
  static constexpr std::string_view kNames[] = {
      "motor_coulomb_friction", "input_delay",      "actuator_lag",  "load_unbalance",
      "constant_load_torque",   "shaft_compliance", "impact_damping"};
  return kNames;
}

}  // namespace gapscope::engine_plant
