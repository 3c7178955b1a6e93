// contact_adhesion – a closed contact holds until it is pulled apart.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ContactAdhesion {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law = "a closed contact opens at a tensile torque";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"release_nm", "N m", 0.0, 0.0, 1.0, Scale::kPeakTorque}};
  static constexpr std::array<const char*, 0> look_alikes = {};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr ContactPhase acts_in[] = {ContactPhase::kEngagement, ContactPhase::kGap};
  static constexpr EffectNeeds needs = EffectNeeds::kContact;
  static constexpr EffectStart starts[] = {{0.05}, {0.2}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.adhesion += p[0];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(contact_adhesion, ContactAdhesion)
