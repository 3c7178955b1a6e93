// A load whose unbalance exceeds its dry friction where the motion turns round.
#include <gtest/gtest.h>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"

namespace gapscope {
namespace {

constexpr double kTrueGap = 0.025;

GapEstimate read_unbalanced(double unbalance_nm, independent_plant::Waveform waveform, double amplitude) {
  independent_plant::BlindCase c;
  c.drive.motor_inertia = 3e-4, c.drive.torque_constant = 1.0, c.drive.motor_damping = 0.01;
  c.drive.load_inertia = 8e-4, c.drive.load_damping = 0.008, c.drive.load_coulomb = 0.01,
  c.drive.gap = kTrueGap;
  c.drive.contact_stiffness = 500.0, c.drive.contact_damping = 0.1;
  c.drive.effects.load.unbalance_nm = unbalance_nm;
  c.excitation.waveform = waveform;
  c.excitation.frequency = 0.8, c.excitation.amplitude = amplitude;
  c.options.rate = 1000.0, c.options.duration = 10.0, c.options.tolerance = independent_plant::kFastTolerance;
  c.sensor = independent_plant::BlindSensor::with_bits(15, 0.0);
  const independent_plant::BlindRun run = independent_plant::simulate_blind(c);
  MotorTrace trace = run.recording.motor_trace();
  trace.quantum = c.sensor.quantum;
  return detect_gap({&trace, 1});
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
