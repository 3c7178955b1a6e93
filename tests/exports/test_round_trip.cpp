// What goes to MuJoCo comes back as the same numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "config/starter.h"
#include "exports/export.h"
#include "exports/exported_drives.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/simulate.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

JointNumbers back(const Configuration& c) {
  const DriveExport drive = export_drive(c, ExportFormat::kMjcf);
  const testing::TemporaryFile file(drive.files[0].text, "model.xml");
  return joint_numbers(file.path(), c.name + "_motor");
}

TEST(RoundTrip, OfAnMjcfKeepsEveryNumberOfTheDrive) {
  for (const char* top : {"encoder: {bits: 20}", "coordinates: translation\nencoder: {quantum: 6.0e-6}"}) {
    const Configuration c = testing::rig_configuration(
        testing::kTwoBodies, "  effects: [{motor_coulomb_friction: {level_nm: 0.01}}]\n", top);
    const DriveParameters<double>& p = c.simulation->plant.drive;
    const JointNumbers n = back(c);
    EXPECT_EQ(n.slides, !c.coordinates.rotational());
    EXPECT_DOUBLE_EQ(n.inertia, p.motor_inertia);
    EXPECT_DOUBLE_EQ(n.torque_constant, p.torque_constant);
    EXPECT_DOUBLE_EQ(n.damping, p.motor_damping);
    EXPECT_DOUBLE_EQ(n.friction, 0.01);
    EXPECT_NEAR(n.gap, p.gap, 1e-15);
    EXPECT_DOUBLE_EQ(n.load_inertia, p.motor_inertia * p.mass_ratio);
    EXPECT_DOUBLE_EQ(n.load_damping, p.load_damping);
    EXPECT_DOUBLE_EQ(n.load_friction, p.load_coulomb_friction);
    EXPECT_NEAR(n.stiffness, p.contact_stiffness, 1e-9 * p.contact_stiffness);
    EXPECT_NEAR(n.contact_damping, p.contact_damping, 1e-9 * p.contact_damping);
  }
}

/// The first configuration of a recording of the drive, begun with its own export.
Configuration begun_with_export(const Configuration& c) {
  const SimulationConfig& s = *c.simulation;
  const std::vector<double> u = sample(s.excitation, s.rate, s.samples(), s.seed);
  SimulationOptions options;
  options.rate = s.rate;
  const Recording r = simulate(s.plant.plant_model(), u, options);
  const testing::TemporaryFile file("", "r.csv");
  write_csv(file.path(), r);
  RecordingConfig recording;
  recording.files = {{file.path(), file.path(), 0}};
  const Starter starter = starter_configuration(recording, c.encoder, c.coordinates, file.folder().string(),
                                                {.nominal = back(c)});
  return parse_configuration(starter.yaml, "begun.yaml");
}

/// Of the first effect of that name; 0 where there is none.
double number_of(const Configuration& c, std::string_view effect, std::string_view key) {
  for (const EffectConfig& e : c.model.effects)
    if (e.effect.entry->name == effect)
      for (std::size_t i = 0; i < e.effect.parameters.size(); ++i)
        if (e.effect.entry->parameters[i].key == key) return e.effect.parameters[i].value;
  return 0.0;
}

struct BackAs {
  const char* effect;
  const char* key;
  double value;
};

/// What the configuration says, to its three digits.
void expect_back(const std::string& effect, const std::string& numbers,
                 std::initializer_list<BackAs> expected, const std::string& model = "") {
  SCOPED_TRACE(effect + numbers);
  const Configuration begun =
      begun_with_export(testing::rig_configuration(numbers, model + "  effects: [{" + effect + "}]\n"));
  EXPECT_EQ(
      begun.model.effects.size(), expected.size() == 0 ? 0u : [&] {
        std::vector<std::string_view> names;
        for (const BackAs& e : expected)
          if (names.empty() || names.back() != e.effect) names.push_back(e.effect);
        return names.size();
      }());
  for (const BackAs& e : expected)
    EXPECT_NEAR(number_of(begun, e.effect, e.key), e.value, 5e-3 * std::abs(e.value)) << e.effect << e.key;
}

/// Every effect that the export says it carries whole, and its ranges: begun with its file nothing is
/// missing.
TEST(RoundTrip, OfAnMjcfBringsBackEveryEffectThatItCarries) {
  for (const std::string& numbers : {testing::kTwoBodies, std::string(", mass_ratio: 0")}) {
    expect_back("motor_coulomb_friction: {level_nm: 0.01}", numbers,
                {{"motor_coulomb_friction", "level_nm", 0.01}});
    expect_back("constant_load_torque: {torque_nm: -0.01}", numbers,
                {{"constant_load_torque", "torque_nm", -0.01}});
    expect_back("load_unbalance: {amplitude_nm: 0.01, phase_rad: 0.7}", numbers,
                {{"load_unbalance", "amplitude_nm", 0.01}, {"load_unbalance", "phase_rad", 0.7}});
    expect_back("actuator_lag: {time_constant_s: 2.0e-3}", numbers,
                {{"actuator_lag", "time_constant_s", 2e-3}});
    expect_back("torque_saturation: {knee: 0.5}", numbers, {{"torque_saturation", "knee", 0.5}});
    expect_back("torque_saturation: {knee: 0.7}", numbers, {});  // which the input does not reach
  }
  const std::string asymmetry = "friction_asymmetry: {level_nm: 0.01, coulomb_ratio: 0.4}";
  expect_back(asymmetry, testing::kTwoBodies,
              {{"friction_asymmetry", "level_nm", 0.01}, {"friction_asymmetry", "coulomb_ratio", 0.4}});
  // Of one body the difference of both directions is a torque that acts always, while it moves.
  expect_back(asymmetry, ", mass_ratio: 0",
              {{"constant_load_torque", "torque_nm", -0.004}, {"motor_coulomb_friction", "level_nm", 0.01}});
  expect_back("motor_coulomb_friction: {level_nm: 0.01}",
              ", gap: 0.019, contact_stiffness: 200, contact_damping: 0.05",
              {{"motor_coulomb_friction", "level_nm", 0.01}}, "  load: locked\n");
}

TEST(RoundTrip, OfAnMjcfKeepsALockedOutput) {
  const Configuration c = testing::rig_configuration(
      ", gap: 0.019, contact_stiffness: 200, contact_damping: 0.05", "  load: locked\n");
  const JointNumbers n = back(c);
  EXPECT_TRUE(n.locked);
  EXPECT_NEAR(n.gap, 0.019, 1e-15);
  EXPECT_NEAR(n.stiffness, 200.0, 1e-9 * 200.0);
  EXPECT_EQ(begun_with_export(c).model.structure.load, LoadKind::kLocked);
}

TEST(RoundTrip, OfAUrdfKeepsWhatItCarries) {
  const Configuration c =
      testing::rig_configuration(", mass_ratio: 0", "  effects: [{load_unbalance: {amplitude_nm: 0.01}}]\n");
  const DriveExport drive = export_drive(c, ExportFormat::kUrdf);
  const testing::TemporaryFile file(drive.files[0].text, "model.urdf");
  const JointNumbers n = joint_numbers(file.path(), "rig_joint");
  EXPECT_NEAR(n.inertia, c.simulation->plant.drive.motor_inertia, 1e-14);
  EXPECT_DOUBLE_EQ(n.damping, c.simulation->plant.drive.motor_damping);
}

}  // namespace
}  // namespace gapscope
