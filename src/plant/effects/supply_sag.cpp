// supply_sag – the supply gives way as the drive draws power from it.
#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct SupplySag {
  static constexpr EffectSide side = EffectSide::kCommand;
  static constexpr const char* law =
      "Km u (1 - r P/(P + P0)), P = Km u w1 the power drawn, none while the motor brakes";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"ratio", "-", 0.0, 0.0, 1.0, Scale::kOne, false, "of the supply"},
      {"power_w", "W", 1.0, 0.05, 5.0, Scale::kPeakPower}};
  static constexpr std::array<const char*, 2> look_alikes = {"torque_saturation", "quadratic_drag"};
  static constexpr ResidualPattern follows = ResidualPattern::kInput;
  static constexpr EffectStart starts[] = {{0.3, 1.0}, {0.6, 0.3}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T*) {
    plant.motor_sticks = true;  // level zero: reversals, where the power has a kink, are located
  }

  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    const T power = at.drive_torque * at.state.w1;
    if (value_of(power) <= 0.0 || at.motor_direction == 0) return {};
    return {.motor = -at.drive_torque * p[0] * power / (power + p[1])};
  }

  /// The power passes P0 at this rate, at the most that the torque in force can do; in contact the speed
  /// swings with its spring.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const DriveParameters<T>& d = at.plant.drive;
    const double torque = value_of(at.drive_torque), m1 = value_of(d.motor_inertia);
    const double driven = torque * torque / (m1 * value_of(p[1]));
    if (!at.plant.structure.has_load || at.plant.structure.contact == ContactLaw::kRigid) return driven;
    const bool locked = at.plant.structure.load == LoadKind::kLocked;  // has no inertia of its own
    const double both = locked ? 1.0 : 1.0 + 1.0 / value_of(d.mass_ratio);
    const double swing = std::sqrt(value_of(d.contact_stiffness) * both / m1);
    return std::max(driven, value_of(p[0]) * swing);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(supply_sag, SupplySag)
