// What a file lacks of the drive is said where it matters, with the line that mends it in a loop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "exports/export.h"
#include "exports/exported_drives.h"
#include "exports/mujoco_engine.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::kTwoBodies;
using ::testing::Not;
using testing::rig_configuration;

/// Twelve seconds of one body whose motor has detents and a ripple, which take it elsewhere.
Configuration rippling(double cogging = 0.03, double ripple = 0.08) {
  Configuration c = rig_configuration(
      ", mass_ratio: 0",
      fmt::format("  effects: [{{cogging_torque: {{amplitude_nm: {}, periods_per_turn: 24, second_harmonic: "
                  "0.2}}}}, {{torque_ripple: {{ratio: {}, periods_per_turn: 6, phase_rad: -0.5}}}}]\n",
                  cogging, ripple));
  c.simulation->duration = 12.0;
  return c;
}

TEST(LeftOut, IsAWarningWithTheLinesThatMendIt) {
  const Certificate c = export_drive(rippling(), ExportFormat::kMjcf).certificate;
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_THAT(c.warnings[0],
              HasSubstr("by what is left out or approximated (cogging_torque, torque_ripple) this file is "));
  EXPECT_THAT(c.warnings[0], HasSubstr(": do not use it as it is"));
  EXPECT_THAT(c.warnings[0], HasSubstr("`qfrc_applied -= 0.03*(sin(y) + 0.2*sin(2*y)) with y = 24*qpos`"));
  EXPECT_THAT(c.warnings[0], HasSubstr("`ctrl = u*(1 + 0.08*sin(6*qpos - 0.5))`"));
  EXPECT_THAT(certificate_text(c), HasSubstr("do not use it as it is"));
}

TEST(LeftOut, ThatTakesTheFileFarOffLeavesOneRowOverTheWholeRecording) {
  const Certificate c = export_drive(rippling(), ExportFormat::kMjcf).certificate;
  EXPECT_EQ(c.errors.size(), 1u);
  EXPECT_TRUE(c.limits.empty());
  EXPECT_DOUBLE_EQ(c.duration, 12.0);
  EXPECT_THAT(certificate_text(c), Not(HasSubstr("the largest stable step")));
}

TEST(Certificate, TheEndOfTheTableIsNoLimit) {
  Certificate c;
  const auto row = [](double step) {
    TargetError e;
    e.integrator = "Euler", e.step = step, e.rms = e.max = 0.06;
    return e;
  };
  c.errors = {row(0.01), row(0.02)};
  StepLimits limits;
  limits.integrator = "Euler", limits.largest = 0.02;
  c.limits = {limits};
  EXPECT_THAT(certificate_text(c), HasSubstr("stable step is at least 20 ms, the largest that was tried; "));
  c.errors.push_back(row(0.05));
  EXPECT_THAT(certificate_text(c), HasSubstr("stable step is 20 ms (beyond, the error exceeds"));
}

TEST(LeftOut, ThatDoesLittleLeavesTheStepsInTheTable) {
  const Certificate c = export_drive(rippling(1e-6, 1e-6), ExportFormat::kMjcf).certificate;
  EXPECT_GT(c.errors.size(), 8u);
  ASSERT_FALSE(c.warnings.empty());
  EXPECT_THAT(c.warnings.back(), HasSubstr("this file is "));
  EXPECT_THAT(c.warnings.back(), Not(HasSubstr("do not use")));
}

TEST(LeftOut, IsMendedInMuJoCoByTheLinesThatAreTold) {
  const Configuration c = rippling();
  const SimulationConfig& s = *c.simulation;
  const std::vector<double> u = sample(s.excitation, s.rate, s.samples(), s.seed);
  SimulationOptions options;
  options.rate = s.rate;
  const std::vector<double> x1 = simulate(s.plant.plant_model(), u, options).x1;
  testing::MujocoEngineRun engine(export_drive(c, ExportFormat::kMjcf).files[0].text);
  constexpr int kInner = 4;  // 0.1 ms
  std::vector<double> input;
  for (std::size_t i = 0; i < u.size() * kInner; ++i) input.push_back(u[i / kInner]);
  const auto loop = [](double given, mjData& d) {
    const double y = 24 * d.qpos[0];
    d.qfrc_applied[0] = 0.0;
    d.qfrc_applied[0] -= 0.03 * (std::sin(y) + 0.2 * std::sin(2 * y));
    return given * (1 + 0.08 * std::sin(6 * d.qpos[0] - 0.5));
  };
  const std::vector<double> bare = engine.motion(1e-4, mjINT_RK4, input);
  const std::vector<double> mended = engine.motion(1e-4, mjINT_RK4, input, loop);
  double was = 0.0, is = 0.0;
  for (std::size_t i = 0; i < x1.size(); ++i) {
    was = std::max(was, std::abs(bare[kInner * i] - x1[i]));
    is = std::max(is, std::abs(mended[kInner * i] - x1[i]));
  }
  EXPECT_GT(was, 0.01);
  EXPECT_LT(is, 0.02 * was);
}

TEST(LeftOut, OfOtherFormatsIsToldAlike) {
  const Certificate c = export_drive(rippling(), ExportFormat::kUrdf).certificate;
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_THAT(c.warnings[0], HasSubstr("`effort = 0.172*u*(1 + 0.08*sin(6*q - 0.5))`"));
  EXPECT_THAT(c.warnings[0], Not(HasSubstr("torque_constant")));
  EXPECT_THAT(export_drive(rippling(), ExportFormat::kC).certificate.warnings, ElementsAre());
}

TEST(LeftOut, OfAControllerSaysWhatTheInputIsAndIsJudgedByTheDrivesOwnTravel) {
  Configuration c =
      rig_configuration(", mass_ratio: 0", "", "encoder: {bits: 20}\ncontroller: {position: {gain: 2}}");
  const Certificate told = export_drive(c, ExportFormat::kMjcf).certificate;
  EXPECT_LT(told.travel, 1.5) << "of a goal that moves by 1.2 rad, which no longer is the torque";
  EXPECT_EQ(told.input, "what the controller makes of its goal");
  EXPECT_EQ(told.parts.back().part, "controller");
  EXPECT_EQ(told.parts.back().fidelity, Fidelity::kLeftOut);
  ASSERT_EQ(told.warnings.size(), 1u);
  EXPECT_THAT(told.warnings[0],
              HasSubstr("the controller is not in the file: the input of the file is u, not the "
                        "goal (torque = torque_constant * u)"));
}

}  // namespace
}  // namespace gapscope
