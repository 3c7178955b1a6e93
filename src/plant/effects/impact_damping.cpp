// impact_damping – the contact damps more or less than the nominal one.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ImpactDamping {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law = "contact damping c as given";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"damping_nms_rad", "N m s/rad", 1.0, 0.0, 100.0, Scale::kContactDamping}};
  static constexpr std::array<const char*, 1> look_alikes = {"shaft_compliance"};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr ContactPhase acts_in[] = {ContactPhase::kEngagement, ContactPhase::kImpact};
  static constexpr EffectNeeds needs = EffectNeeds::kContact;
  static constexpr int stands_for = place::kContactDamping;
  static constexpr EffectStart starts[] = {{0.4}, {2.5}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.drive.contact_damping = p[0];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(impact_damping, ImpactDamping)
