// hunt_crossley_contact – a contact as of two spheres: its spring and its damper grow with the overlap.
#include <algorithm>
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

/// K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440.
struct HuntCrossleyContact {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law =
      "contact torque k p q^0.5 + c p' (0.05 + 0.95 q^1.5) in place of k p + c p', q = |p| / length, p the penetration";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"length_rad", "rad", 4.0, 0.03, 50.0, Scale::kPenetration, true}};
  static constexpr std::array<const char*, 2> look_alikes = {"contact_hardening", "impact_damping"};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr ContactPhase acts_in[] = {ContactPhase::kEngagement, ContactPhase::kImpact};
  static constexpr EffectNeeds needs = EffectNeeds::kContact;

  /// What stays of the linear damper, so that a contact that closes pushes from its first instant on.
  static constexpr double kLinear = 0.05;
  /// A root has no slope at zero.
  static constexpr double kRounding = 1e-8;

  template <class T>
  static T contact(const T& penetration, const T& speed, const PlantModel<T>& plant, const T* p) {
    using std::sqrt;
    const T depth = penetration / p[0], square = depth * depth + kRounding;
    const T length = sqrt(square), root = sqrt(length);
    const DriveParameters<T>& drive = plant.drive;
    return drive.contact_stiffness * penetration * (root - 1.0) +
           drive.contact_damping * speed * (1.0 - kLinear) * (root * length - 1.0);
  }

  /// Of spring and damper at the overlap, which an impact passes through at its speed.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    const DriveParameters<T>& drive = at.plant.drive;
    const double m1 = value_of(drive.motor_inertia), m2 = m1 * value_of(drive.mass_ratio);
    const double inverse_mass = 1.0 / m1 + (m2 > 0.0 ? 1.0 / m2 : 0.0);
    const double apart = value_of(at.state.x1) - value_of(at.state.x2);
    const double depth = std::max(0.0, std::abs(apart) - 0.5 * value_of(drive.gap)) / value_of(p[0]);
    const double speed = std::abs(value_of(at.state.w1) - value_of(at.state.w2));
    return std::sqrt(value_of(drive.contact_stiffness) * std::sqrt(depth) * inverse_mass) +
           value_of(drive.contact_damping) * std::pow(depth, 1.5) * inverse_mass +
           2.0 * speed / value_of(p[0]);
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(hunt_crossley_contact, HuntCrossleyContact)
