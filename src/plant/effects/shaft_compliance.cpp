// shaft_compliance – the contact is softer or stiffer than the nominal one.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ShaftCompliance {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law = "contact stiffness k as given";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"stiffness_nm_rad", "N m/rad", 1.0, 0.01, 100.0, Scale::kStiffness}};
  static constexpr std::array<const char*, 2> look_alikes = {"impact_damping", "contact_hardening"};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr ContactPhase acts_in[] = {ContactPhase::kEngagement, ContactPhase::kImpact};
  static constexpr EffectNeeds needs = EffectNeeds::kContact;
  static constexpr int stands_for = place::kContactStiffness;
  static constexpr EffectStart starts[] = {{0.5}, {2.0}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.drive.contact_stiffness = p[0];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(shaft_compliance, ShaftCompliance)
