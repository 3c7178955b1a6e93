// Loads that something else than the motor moves where the motion turns round: an unbalance beyond their dry
// friction, or a friction that springs back.
#include <gtest/gtest.h>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"

namespace gapscope {
namespace {

constexpr double kTrueGap = 0.025;

GapEstimate read(const independent_plant::LoadEffects& on_load, independent_plant::Waveform waveform,
                 double amplitude, double motor_inertia = 3e-4) {
  independent_plant::BlindCase c;
  c.drive.motor_inertia = motor_inertia, c.drive.torque_constant = 1.0, c.drive.motor_damping = 0.01;
  c.drive.load_inertia = 8e-4, c.drive.load_damping = 0.008, c.drive.load_coulomb = 0.01,
  c.drive.gap = kTrueGap;
  c.drive.contact_stiffness = 500.0, c.drive.contact_damping = 0.1;
  c.drive.effects.load = on_load;
  c.excitation.waveform = waveform;
  c.excitation.frequency = 0.8, c.excitation.amplitude = amplitude;
  c.options.rate = 1000.0, c.options.duration = 10.0, c.options.tolerance = independent_plant::kFastTolerance;
  c.sensor = independent_plant::BlindSensor::with_bits(15, 0.0);
  const independent_plant::BlindRun run = independent_plant::simulate_blind(c);
  MotorTrace trace = run.recording.motor_trace();
  trace.quantum = c.sensor.quantum;
  return detect_gap({&trace, 1});
}

GapEstimate read_unbalanced(double unbalance_nm, independent_plant::Waveform waveform, double amplitude) {
  return read({.bristle = {}, .unbalance_nm = unbalance_nm}, waveform, amplitude);
}

/// A bristle of 0.6 gaps brings the load back from the turn, and goes on after the motor has left it.
TEST(PushedLoad, IsNotTakenToRestOnAFrictionThatSpringsBack) {
  const auto held = [](double length) {
    const independent_plant::BristleFriction friction{
        .level_nm = 0.03, .length_rad = length, .damping_nms = 2e-4};
    return read({.bristle = friction, .unbalance_nm = 0.0}, independent_plant::Waveform::kTriangle, 0.12,
                8e-4);
  };
  const GapEstimate soft = held(0.6 * kTrueGap);
  EXPECT_NE(soft.verdict, GapVerdict::kBacklash) << soft.gap;
  EXPECT_NE(soft.reason.text().find("springs back"), std::string::npos) << soft.reason.text();
  const GapEstimate stiff = held(0.002 * kTrueGap);
  ASSERT_EQ(stiff.verdict, GapVerdict::kBacklash) << stiff.reason.text();
  EXPECT_NEAR(stiff.gap / kTrueGap, 1.0, 0.05);
}

/// Motor and load start from the turn together: the motor goes 2.8 and 2.3 gaps until it hits the far flank.
TEST(PushedLoad, IsNotTakenToRest) {
  const GapEstimate triangle = read_unbalanced(0.03, independent_plant::Waveform::kTriangle, 0.12);
  EXPECT_NE(triangle.verdict, GapVerdict::kBacklash) << triangle.gap;
  const GapEstimate sine = read_unbalanced(0.03, independent_plant::Waveform::kSine, 0.14);
  EXPECT_NE(sine.verdict, GapVerdict::kBacklash) << sine.gap;
  EXPECT_NE(sine.reason.text().find("a force"), std::string::npos) << sine.reason.text();
}

TEST(PushedLoad, RestsWhereItsFrictionHoldsIt) {
  const GapEstimate g = read_unbalanced(0.0, independent_plant::Waveform::kTriangle, 0.12);
  ASSERT_EQ(g.verdict, GapVerdict::kBacklash) << g.reason.text();
  EXPECT_LE(g.ci95.low, kTrueGap);
  EXPECT_GE(g.ci95.high, kTrueGap);
}

}  // namespace
}  // namespace gapscope
