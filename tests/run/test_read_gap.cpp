#include <gtest/gtest.h>

#include "run/read_gap.h"

namespace gapscope {
namespace {

const Progress kUntold = [](const std::string&) {};

/// The paper's rig in a motion of that amplitude, its model with that gap.
Configuration rig_moved(const char* amplitude, const char* gap) {
  return parse_configuration(
      std::string(
          "encoder: {bits: 20}\n"
          "simulation: {rate: 1000, duration: 5, noise: 2.0e-6, excitation: {sine: {frequency: 1, amplitude: ") +
          amplitude +
          "}},\n"
          "  model: {parameters: {motor_damping: 0.062, mass_ratio: 1, gap: 0.019}}}\n"
          "model: {parameters: {motor_inertia: 8.78e-4, torque_constant: 0.172, load_damping: 0.035,\n"
          "  load_coulomb_friction: 0.05, contact_stiffness: 200, contact_damping: 0.05,\n"
          "  motor_damping: {value: 0.04, estimate: true}, mass_ratio: {value: 1.5, estimate: true}, gap: " +
          gap + "}}\n",
      "rig.yaml");
}

LoadedRecordings recorded(const char* amplitude) {
  return load_recordings(rig_moved(amplitude, "0.019"), UnevenRows::kStamped, kUntold);
}

TEST(ReadGap, IsThatOfWhatIsFittedOrElseOfWhatIsHeldOut) {
  const Configuration c = rig_moved("0.5814", "{estimate: true}");
  const auto gap = internal::run::read_gap(c, {recorded("0.5814"), {}});
  ASSERT_TRUE(gap);
  EXPECT_NEAR(*gap, 0.019, 0.0005);
  const LoadedRecordings small = recorded("0.005");  // within the gap
  EXPECT_FALSE(internal::run::read_gap(c, {small, {}}));
  EXPECT_EQ(internal::run::read_gap(c, {small, recorded("0.5814")}), gap);
}

TEST(ReadGap, IsNoneWhereAStartIsGivenOrNoGapIsSought) {
  for (const char* known : {"0.019", "{value: 0.03, estimate: true}"})
    EXPECT_FALSE(internal::run::read_gap(rig_moved("0.5814", known), {recorded("0.5814"), {}})) << known;
}

}  // namespace
}  // namespace gapscope
