// backlash – a gap where the nominal model has none.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct Backlash {
  static constexpr EffectSide side = EffectSide::kContact;
  static constexpr const char* law =
      "gap 2 beta between two parts of the inertia, load_share of it behind the gap";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"gap_rad", "rad", 0.0, 0.0, 0.66, Scale::kTravel},
      {"load_share", "-", 0.5, 0.02, 0.98, Scale::kOne}};
  static constexpr std::array<const char*, 0> look_alikes = {};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr EffectNeeds needs = EffectNeeds::kNoGap;
  static constexpr EffectStart starts[] = {{0.02, 0.5}, {0.1, 0.5}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.drive.gap = p[0];
    if (plant.structure.has_load || value_of(p[0]) <= 0.0) return;
    // One inertia is divided in two; without a nominal contact the two meet rigidly and plastically.
    plant.structure.has_load = true;
    plant.structure.contact = ContactLaw::kRigid;
    plant.structure.restitution = 0.3;
    plant.drive.mass_ratio = p[1] / (1.0 - p[1]);
    plant.drive.motor_inertia = plant.drive.motor_inertia * (1.0 - p[1]);
    plant.drive.load_damping = plant.drive.motor_damping * p[1];
    plant.drive.motor_damping = plant.drive.motor_damping * (1.0 - p[1]);
    plant.drive.load_coulomb_friction = T(0.0);
    plant.load_sticks = false;
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(backlash, Backlash)
