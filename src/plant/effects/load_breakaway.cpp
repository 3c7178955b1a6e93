// load_breakaway – dry friction of the load that falls from its break-away level as the load starts to move.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct LoadBreakaway {
  static constexpr EffectSide side = EffectSide::kLoad;
  static constexpr const char* law =
      "load torque -Fc2 (1 + r exp(-(w2/vs)^2)) sign(w2), set-valued at rest, in place of -Fc2 sign(w2)";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"stiction_ratio", "-", 0.0, -0.5, 5.0, Scale::kOne, false, "of the Coulomb friction, at standstill"},
      {"stribeck_speed_rad_s", "rad/s", 0.05, 1e-3, 1.0, Scale::kPeakSpeed}};
  static constexpr std::array<const char*, 1> look_alikes = {"stribeck_friction"};
  static constexpr ResidualPattern follows = ResidualPattern::kDirection;
  static constexpr EffectNeeds needs = EffectNeeds::kFreeLoad;

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.drive.load_coulomb_friction *= 1.0 + p[0];
  }

  /// What the sliding load is spared of its break-away level; zero at rest.
  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    using std::exp;
    const T v = at.state.w2 / p[1];
    const T spared = at.plant.drive.load_coulomb_friction * (p[0] / (1.0 + p[0])) * (1.0 - exp(-v * v));
    return {.load = value_of(v) < 0.0 ? T(-spared) : spared};
  }

  /// Speed passes through the law's width at this rate, at the most that the torque in force can do.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const DriveParameters<T>& drive = at.plant.drive;
    if (std::abs(value_of(at.state.w2)) > 4.0 * value_of(p[1])) return 0.0;
    const double torque = std::abs(value_of(at.drive_torque)) + value_of(drive.load_coulomb_friction);
    return 1.5 * torque / (value_of(drive.motor_inertia) * value_of(drive.mass_ratio) * value_of(p[1]));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(load_breakaway, LoadBreakaway)
