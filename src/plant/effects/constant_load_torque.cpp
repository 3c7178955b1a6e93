// constant_load_torque – a steady torque on the load, or an offset of the input where there is no gap.
#include <array>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

struct ConstantLoadTorque {
  static constexpr EffectSide side = EffectSide::kLoad;
  static constexpr const char* law = "load torque T0";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"torque_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque}};
  static constexpr std::array<const char*, 2> look_alikes = {"friction_asymmetry", "load_unbalance"};
  static constexpr ResidualPattern follows = ResidualPattern::kMode;
  static constexpr ContactPhase acts_in[] = {ContactPhase::kEngagement};
  static constexpr EffectNeeds needs = EffectNeeds::kFreeLoad;
  static constexpr EffectStart starts[] = {{0.05}, {-0.05}};

  template <class T>
  static void shape(PlantModel<T>& plant, const T* p) {
    plant.load_torque += p[0];
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(constant_load_torque, ConstantLoadTorque)
