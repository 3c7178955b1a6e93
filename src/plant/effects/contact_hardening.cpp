// contact_hardening – the contact grows stiffer as it is compressed: teeth, bearings, harmonic drives.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ContactHardening {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law =
      "contact torque k p (1 + r q^2 / (1 + q^2)) + c p', q = p / length, p the penetration: a cubic spring "
      "where it is small, at most 1 + r as stiff as the nominal one";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"ratio", "-", 0.0, 0.0, 30.0, Scale::kOne, false, "of the contact's stiffness"},
      {"length_rad", "rad", 1.0, 0.03, 5.0, Scale::kPenetration}};
  static constexpr std::array<const char*, 1> look_alikes = {"shaft_compliance"};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr ContactPhase acts_in[] = {ContactPhase::kEngagement, ContactPhase::kImpact};
  static constexpr EffectNeeds needs = EffectNeeds::kContact;
  static constexpr EffectStart starts[] = {{1.0, 0.5}, {5.0, 1.0}};

  template <class T>
  static T contact(const T& penetration, const T&, const PlantModel<T>& plant, const T* p) {
    const T depth = penetration / p[1], square = depth * depth;
    return plant.drive.contact_stiffness * p[0] * penetration * (square / (1.0 + square));
  }

  /// Of the stiffness that comes on top, and of an impact that passes through the length.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const DriveParameters<T>& drive = at.plant.drive;
    const double m1 = value_of(drive.motor_inertia), m2 = m1 * value_of(drive.mass_ratio);
    const double inverse_mass = 1.0 / m1 + (m2 > 0.0 ? 1.0 / m2 : 0.0);
    const double speed = std::abs(value_of(at.state.w1) - value_of(at.state.w2));
    return std::sqrt(value_of(drive.contact_stiffness) * value_of(p[0]) * inverse_mass) +
           0.5 * speed / value_of(p[1]);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(contact_hardening, ContactHardening)
