// Numbers of a sheet that hold at the motor's shaft, in front of a gear.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/configuration.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

std::string geared(const std::string& parameters, const std::string& more = "gear_ratio: {position: -50}") {
  return "recording: {file: r.csv, " + more + "}\nmodel:\n  parameters:\n" + parameters;
}

const ParameterSetting& parameter(const Configuration& c, int index) {
  return c.model.parameters[static_cast<std::size_t>(index)];
}

TEST(GivenAt, TheMotorIsAskedForAndTheAxisBehindTheGearIsMeant) {
  const Configuration c =
      parse_configuration(geared("    motor_inertia: {value: 2.0e-6, given_at: motor}\n"
                                 "    torque_constant: {value: 0.01, given_at: motor}\n"
                                 "    motor_damping: {value: 4.0e-6, estimate: true, bounds: [0, 1.0e-3], "
                                 "prior: {value: 4.0e-6, std: "
                                 "1.0e-6}, given_at: motor}\n"
                                 "    gap: {value: 0.5, estimate: true, bounds: [0, 2.5], given_at: motor}\n"
                                 "    load_coulomb_friction: {value: 0.3, given_at: load}\n"
                                 "    contact_stiffness: {value: 0.1, given_at: motor}\n"),
                          "c.yaml");
  EXPECT_DOUBLE_EQ(parameter(c, place::kMotorInertia).value, 5e-3);
  EXPECT_DOUBLE_EQ(parameter(c, place::kTorqueConstant).value, 0.5);
  EXPECT_DOUBLE_EQ(parameter(c, place::kMotorDamping).value, 1e-2);
  EXPECT_DOUBLE_EQ(parameter(c, place::kMotorDamping).high, 2.5);
  EXPECT_DOUBLE_EQ(parameter(c, place::kGap).value, 0.01);
  EXPECT_DOUBLE_EQ(parameter(c, place::kGap).high, 0.05);
  EXPECT_DOUBLE_EQ(parameter(c, place::kLoadCoulombFriction).value, 0.3);
  EXPECT_DOUBLE_EQ(parameter(c, place::kContactStiffness).value, 250.0);
}

TEST(GivenAt, TheLoadTakesNoGear) {
  const Configuration c = parse_configuration(
      geared("    load_coulomb_friction: {value: 0.3, given_at: load}\n", "window: [0, 1]"), "c.yaml");
  EXPECT_EQ(c.model.parameters[place::kLoadCoulombFriction].value, 0.3);
}

TEST(GivenAt, WhatItDoesNotSayIsRefusedWithWhatWasExpected) {
  const auto refused = [](const std::string& text) {
    return testing::refusal([&] { parse_configuration(text, "c.yaml"); });
  };
  EXPECT_THAT(refused(geared("    mass_ratio: {value: 1, given_at: motor}\n")),
              HasSubstr("c.yaml:4: model.parameters.mass_ratio.given_at stands beside a ratio, expected"));
  EXPECT_THAT(refused(geared("    gap: {value: 1, given_at: rotor}\n")), HasSubstr("expected motor or load"));
  EXPECT_THAT(refused(geared("    gap: {value: 1, given_at: motor}\n", "window: [0, 1]")),
              HasSubstr("needs the gear, expected recording: gear_ratio: {position:"));
  EXPECT_THAT(refused(geared("    gap: {value: 1, given_at: motor}\n") + "coordinates: translation\n"),
              HasSubstr("stands on a slide"));
}

}  // namespace
}  // namespace gapscope
