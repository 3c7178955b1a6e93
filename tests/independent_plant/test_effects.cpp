#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "independent_plant/severity.h"

namespace gapscope::independent_plant {

void PrintTo(const DrawnEffect& entry, std::ostream* out) {
  *out << entry.name;
}  // found by its type's namespace

namespace {

/// A drive in wide motion (±0.6 rad), where every effect has its say.
BlindCase wide_case() {
  BlindCase c;
  c.excitation.amplitude = 1.2;
  c.excitation.frequency = 0.5;
  c.sensor = BlindSensor::with_bits(16);
  c.options = {.rate = 1000.0, .duration = 4.0};
  return c;
}

BlindCase one_inertia_case() {
  BlindCase c = wide_case();
  c.drive.load = BlindLoad::kNone;
  return c;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

Motion hold_and_wait(const Dynamics& dynamics, double torque, double until) {
  Motion motion(dynamics, 1e-12);
  motion.hold(torque / dynamics.drive().torque_constant);
  motion.advance(until);
  return motion;
}

class EveryEffect : public testing::TestWithParam<DrawnEffect> {};

std::string name_of(const testing::TestParamInfo<DrawnEffect>& info) { return std::string(info.param.name); }

TEST_P(EveryEffect, ShowsInTheRecordingAndShowsMoreWhenStronger) {
  const BlindCase nominal = can_have(wide_case().drive, GetParam()) ? wide_case() : one_inertia_case();
  const std::vector<double> without = simulate_blind(nominal).recording.x1;
  double change[2];
  for (const int strong : {0, 1}) {
    BlindCase c = nominal;
    give_effect(c, GetParam().name, strong, 7);
    const Recording recording = simulate_blind(c).recording;
    for (const double x : recording.x1) ASSERT_TRUE(std::isfinite(x));
    change[strong] = largest_difference(recording.x1, without);
  }
  EXPECT_GE(change[0], 0.99 * nominal.sensor.quantum);
  EXPECT_GT(change[1], change[0]);
}

TEST_P(EveryEffect, IsRepeatedExactlyByItsSeed) {
  BlindCase c = can_have(wide_case().drive, GetParam()) ? wide_case() : one_inertia_case();
  BlindCase again = c;
  c.options.duration = again.options.duration = 1.0;
  give_effect(c, GetParam().name, 0.5, 11);
  give_effect(again, GetParam().name, 0.5, 11);
  EXPECT_EQ(simulate_blind(c).recording.x1, simulate_blind(again).recording.x1);
}

TEST_P(EveryEffect, IsIntegratedToTheSameAccuracyAsTheBareDrive) {
  BlindCase c = can_have(wide_case().drive, GetParam()) ? wide_case() : one_inertia_case();
  give_effect(c, GetParam().name, 0.7, 5);
  const std::vector<double> x1 = simulate_blind(c).truth.x1;
  c.options.tolerance = 1e-11;
  EXPECT_LT(largest_difference(simulate_blind(c).truth.x1, x1), 5e-8);  // a tenth of a 20 bit quantum is 6e-7
}

INSTANTIATE_TEST_SUITE_P(Effects, EveryEffect,
                         testing::ValuesIn(effect_entries().begin(), effect_entries().end()), name_of);

TEST(Effects, TheCatalogueHasTwentySevenAndAtLeastFourLieOutside) {
  const auto inside = std::count_if(effect_entries().begin(), effect_entries().end(),
                                    [](const DrawnEffect& e) { return e.in_catalogue; });
  EXPECT_EQ(inside, 28);
  EXPECT_GE(static_cast<int>(effect_entries().size()) - inside, 4);
}

TEST(Effects, MotorFrictionHoldsTheMotorUpToItsBreakawayTorqueAndNoFurther) {
  BlindDrive drive;
  drive.effects.motor.friction = {.level_nm = 0.02, .coulomb_ratio = 0.1, .stiction_ratio = 0.5};
  const Dynamics dynamics(drive, {});
  const double forward = 0.02 * 1.1 * 1.5, backward = 0.02 * 0.9 * 1.5;
  EXPECT_EQ(hold_and_wait(dynamics, 0.999 * forward, 0.1).state()[kX1], 0.0);
  EXPECT_GT(hold_and_wait(dynamics, 1.001 * forward, 0.1).state()[kX1], 0.0);
  EXPECT_EQ(hold_and_wait(dynamics, -0.999 * backward, 0.1).state()[kX1], 0.0);
  EXPECT_LT(hold_and_wait(dynamics, -1.001 * backward, 0.1).state()[kX1], 0.0);
}

TEST(Effects, BristleGivesWayLikeAnExponentialSpring) {
  BlindDrive drive;
  drive.gap = 1.0;
  drive.effects.motor.bristle = {.level_nm = 0.02, .length_rad = 2e-3, .damping_nms = 0.3};
  const Dynamics dynamics(drive, {});
  // Loaded once without overshoot (the damping is well above critical), z = length·(1 − exp(−x1/length)), so
  // torque = level·(1 − exp(−x1/length)).
  const double at_rest = -2e-3 * std::log(1.0 - 0.5);
  EXPECT_NEAR(hold_and_wait(dynamics, 0.01, 2.0).state()[kX1], at_rest, 1e-9);
}

TEST(Effects, BristleOfALoadThatIsPushedGivesWayLikeThatOfTheMotor) {
  BlindDrive drive;
  drive.gap = 1e-3;
  drive.load_coulomb = 0.0;
  drive.effects.load.bristle = {.level_nm = 0.02, .length_rad = 2e-3, .damping_nms = 0.3};
  const Dynamics dynamics(drive, {});
  const auto state = hold_and_wait(dynamics, 0.01, 2.0).state();
  EXPECT_NEAR(state[kX2], -2e-3 * std::log(1.0 - 0.5), 1e-9);
}

TEST(Effects, UnbalanceAndConstantTorqueMoveAFrictionlessLoadToTheirBalance) {
  BlindDrive drive;
  drive.load = BlindLoad::kNone;
  drive.effects.load.unbalance_nm = 0.1;
  drive.effects.load.constant_torque_nm = 0.03;
  const Dynamics dynamics(drive, {});
  EXPECT_NEAR(hold_and_wait(dynamics, 0.02, 20.0).state()[kX1], std::asin(0.5), 1e-9);
}

TEST(Effects, DelayOfWholeSamplesIsAShiftOfTheCommand) {
  BlindCase c = wide_case();
  const BlindRun prompt = simulate_blind(c);
  c.drive.effects.command.delay_s = 3.0 / c.options.rate;
  const BlindRun late = simulate_blind(c);
  for (std::size_t k = 3; k < late.truth.x1.size(); ++k)
    ASSERT_NEAR(late.truth.x1[k], prompt.truth.x1[k - 3], 1e-8);
}

TEST(Effects, FractionalDelayActsInsideTheSample) {
  BlindDrive drive;
  drive.gap = 10.0;
  drive.motor_damping = 0.0;
  drive.effects.command.delay_s = 0.4e-3;
  const std::vector<double> u(11, 1.0);
  const BlindRun run = simulate_blind_command(drive, u, {}, {.rate = 1000.0});
  const double t = 10e-3 - 0.4e-3;
  EXPECT_NEAR(run.truth.x1.back(), 0.5 * drive.torque_constant / drive.motor_inertia * t * t, 1e-12);
}

TEST(Effects, TorqueLoopAndMeasurementFollowAStepExponentially) {
  BlindDrive drive;
  drive.load = BlindLoad::kNone;
  drive.effects.command.lag_s = 0.01;
  drive.effects.sensor.lag_s = 0.02;
  drive.motor_damping = 0.0;
  const BlindRun run = simulate_blind_command(drive, std::vector<double>(101, 1.0), {}, {.rate = 1000.0});
  const double a = drive.torque_constant / drive.motor_inertia, T = 0.01, t = 0.1;
  EXPECT_NEAR(run.truth.x1.back(), a * (0.5 * t * t - T * t - T * T * std::expm1(-t / T)), 1e-10);
  // A filter of time constant F on the same: its answers to t²/2, t and the exponential, summed.
  const double F = 0.02, ef = std::exp(-t / F), et = std::exp(-t / T);
  const double square = 0.5 * t * t - F * t + F * F * (1.0 - ef), ramp = t - F * (1.0 - ef), one = 1.0 - ef;
  const double decay = (et - ef) / (1.0 - F / T);
  EXPECT_NEAR(run.recording.x1.back(), a * (square - T * ramp + T * T * (one - decay)), 1e-10);
}

TEST(Effects, AdheringContactLetsGoAtItsTensileTorque) {
  BlindDrive drive;
  drive.x1 = 0.5 * drive.gap;
  drive.load = BlindLoad::kLocked;
  drive.effects.contact.release_nm = 0.02;
  const Dynamics dynamics(drive, {});
  Motion motion(dynamics, 1e-12);
  motion.hold(0.009 / drive.torque_constant);
  motion.advance(1.0);
  motion.hold(0.0);  // every step swings to less than twice itself: −0.009 N·m here, −0.018 N·m next
  motion.advance(2.0);
  motion.hold(-0.009 / drive.torque_constant);
  motion.advance(3.0);
  EXPECT_EQ(motion.flank_in_contact(), 1);
  EXPECT_NEAR(motion.state()[kX1], 0.5 * drive.gap - 0.009 / drive.contact_stiffness, 1e-9);
  motion.hold(-0.03 / drive.torque_constant);
  motion.advance(4.0);
  EXPECT_EQ(motion.flank_in_contact(), -1);
}

TEST(Effects, SensorFaultsActOnTheReadingOnly) {
  BlindCase c = wide_case();
  const BlindRun clean = simulate_blind(c);
  c.drive.effects.sensor = {
      .eccentricity_rad = 1e-3, .quantum_rad = 1e-2, .lost_count_times = 2, .lost_counts = 3};
  const BlindRun faulty = simulate_blind(c);
  EXPECT_EQ(faulty.truth.x1, clean.truth.x1);
  EXPECT_EQ(faulty.recording.quantum, c.sensor.quantum);  // what the sheet says
  for (const double x : faulty.recording.x1) ASSERT_NEAR(std::remainder(x, 1e-2), 0.0, 1e-12);
}

TEST(Effects, NoiseHasTheAskedStrengthAndRoundingStaysWithinHalfAQuantum) {
  BlindCase c = wide_case();
  c.sensor = {.quantum = 0.0, .noise = 1e-4};
  const BlindRun noisy = simulate_blind(c);
  double sum = 0.0;
  for (std::size_t k = 0; k < noisy.truth.x1.size(); ++k)
    sum += std::pow(noisy.recording.x1[k] - noisy.truth.x1[k], 2);
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(noisy.truth.x1.size())), 1e-4, 6e-6);  // 5σ of 4000 samples
  c.sensor = BlindSensor::with_bits(14);
  const BlindRun rounded = simulate_blind(c);
  EXPECT_LE(largest_difference(rounded.recording.x1, rounded.truth.x1), 0.5000001 * c.sensor.quantum);
}

}  // namespace
}  // namespace gapscope::independent_plant
