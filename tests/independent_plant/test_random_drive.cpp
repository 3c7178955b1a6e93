#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "independent_plant/random_drive.h"

namespace gapscope::independent_plant {
namespace {

constexpr int kDrives = 200;

const std::vector<BlindCase>& drives() {
  static const std::vector<BlindCase> all = [] {
    std::vector<BlindCase> cases;
    for (int seed = 0; seed < kDrives; ++seed)
      cases.push_back(random_drive(static_cast<std::uint64_t>(seed)));
    return cases;
  }();
  return all;
}

double amplitude(const BlindCase& c) { return c.drive.torque_constant * c.excitation.amplitude; }

double peak_to_peak(const std::vector<double>& x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return *high - *low;
}

/// Kolmogorov's distance between what was drawn, mapped so that its law is uniform on [0, 1], and that law.
double distance_from_law(const std::function<double(const BlindCase&)>& share) {
  std::vector<double> shares;
  for (const BlindCase& c : drives()) shares.push_back(share(c));
  std::sort(shares.begin(), shares.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    distance = std::max(distance, std::abs(shares[i] - (static_cast<double>(i) + 0.5) / kDrives));
  return distance;
}

double log_share(double value, double low, double high) {
  return std::log(value / low) / std::log(high / low);
}

TEST(RandomDrive, NumbersFollowTheirLaws) {
  const double limit =
      1.63 / std::sqrt(kDrives);  // passed by 99 % of samples of the right law; the seeds are fixed
  const BlindDrive paper;
  EXPECT_LT(distance_from_law([](const BlindCase& c) { return log_share(c.drive.gap, 5e-3, 50e-3); }), limit);
  EXPECT_LT(distance_from_law([](const BlindCase& c) {
              return log_share(c.drive.load_inertia / c.drive.motor_inertia, 0.1, 10.0);
            }),
            limit);
  EXPECT_LT(distance_from_law(
                [](const BlindCase& c) { return log_share(c.drive.contact_stiffness, 50.0, 5000.0); }),
            limit);
  EXPECT_LT(distance_from_law(
                [](const BlindCase& c) { return (c.drive.load_coulomb / amplitude(c) - 0.02) / 0.58; }),
            limit);
  EXPECT_LT(distance_from_law([&](const BlindCase& c) {
              return log_share(c.drive.motor_damping / paper.motor_damping, 0.2, 2.0);
            }),
            limit);
  EXPECT_LT(distance_from_law([&](const BlindCase& c) {
              return log_share(c.drive.load_damping / paper.load_damping, 0.2, 2.0);
            }),
            limit);
  EXPECT_LT(distance_from_law([](const BlindCase& c) { return (c.excitation.frequency - 0.5) / 2.5; }),
            limit);
}

TEST(RandomDrive, WideLawsDrawContactTorqueAndLengthOfTheirOwn) {
  double least = 1.0, most = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const BlindCase c = random_drive(seed, Waveform::kSine, DriveLaws::kWide);
    const BlindDrive& d = c.drive;
    const double reduced = d.motor_inertia * d.load_inertia / (d.motor_inertia + d.load_inertia);
    const double ratio = d.contact_damping / (2.0 * std::sqrt(d.contact_stiffness * reduced));
    EXPECT_GE(ratio, 0.05);
    EXPECT_LE(ratio, 0.4);
    least = std::min(least, ratio), most = std::max(most, ratio);
    EXPECT_GE(c.options.duration * c.excitation.frequency, 8.0);
    EXPECT_GE(amplitude(c), 0.05);
  }
  EXPECT_LT(least, 0.08);  // of 60, uniform: all above with a chance of 0.5 %
  EXPECT_GT(most, 0.37);
}

TEST(RandomDrive, EncodersComeInEqualSharesAndHalfOfThemWithNoise) {
  std::map<int, int> bits;
  int noisy = 0;
  for (const BlindCase& c : drives()) {
    ++bits[static_cast<int>(std::lround(std::log2(2.0 * kPi / c.sensor.quantum)))];
    const double quanta = c.sensor.noise / c.sensor.quantum;
    if (quanta == 0.0) continue;
    ++noisy;
    EXPECT_GE(quanta, 0.3);
    EXPECT_LE(quanta, 1.5);
  }
  ASSERT_EQ(bits.size(), 4u);
  for (const auto& [bit, count] : bits) EXPECT_NEAR(count, kDrives / 4, 25) << bit;  // 4σ
  EXPECT_NEAR(noisy, kDrives / 2, 28);
}

TEST(RandomDrive, TheMotorTravelsAtLeastOneAndAHalfGapsAndTheContactIsCrossed) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    BlindCase c = random_drive(seed);
    c.options.tolerance = kFastTolerance;
    const BlindRun run = simulate_blind(c);
    EXPECT_GE(peak_to_peak(run.truth.x1), 1.5 * c.drive.gap);
    EXPECT_GE(c.options.rate, 1000.0);
    EXPECT_LE(c.options.rate, 10000.0);
    EXPECT_GT(run.truth.passages.size(), 4u);
  }
}

TEST(RandomDrive, ContactDampingGivesTheRestitutionItWasChosenFor) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    BlindDrive d = random_drive(seed).drive;
    d.motor_damping = d.load_damping = d.load_coulomb = 0.0;
    d.x1 = d.x2 + 0.5 * d.gap;
    d.w1 = 1.0;
    const Dynamics dynamics(d, {});
    Motion motion(dynamics, 1e-12);
    while (motion.contact_events().size() < 2) motion.advance(motion.time() + 1e-5);
    // The linear law gives up to 90 %, and a little more, because the damper does not pull at the end.
    EXPECT_GT(motion.state()[kW2] - motion.state()[kW1], 0.4);
    EXPECT_LT(motion.state()[kW2] - motion.state()[kW1], 0.92);
  }
}

TEST(RandomDrive, AGapFreeDriveHasNoContactToLose) {
  std::set<std::string> kinds;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    BlindCase c = random_gap_free_drive(seed);
    c.options.tolerance = kFastTolerance;
    kinds.insert(c.kind);
    const BlindRun run = simulate_blind(c);
    EXPECT_TRUE(run.truth.contact_events.empty()) << c.kind;
    EXPECT_GT(peak_to_peak(run.truth.x1), 7.5e-3) << c.kind;
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(kGapFreeKinds));
}

TEST(RandomDrive, ASeedAlwaysGivesTheSameDrive) {
  const BlindRun a = simulate_blind(random_drive(5)), b = simulate_blind(random_drive(5));
  EXPECT_EQ(a.recording.x1, b.recording.x1);
  EXPECT_NE(random_drive(6).drive.gap, random_drive(5).drive.gap);
}

TEST(RandomDrive, ADataSheetIsOffByNoMoreThanItsSpreadAndKnowsNoEffects) {
  BlindDrive drive;
  drive.effects.motor.friction.level_nm = 0.1;
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const BlindDrive sheet = data_sheet(drive, seed);
    EXPECT_EQ(sheet.effects.motor.friction.level_nm, 0.0);
    EXPECT_EQ(sheet.motor_inertia, drive.motor_inertia);
    EXPECT_EQ(sheet.torque_constant, drive.torque_constant);
    worst = std::max(worst, std::abs(sheet.gap / drive.gap - 1.0));
  }
  EXPECT_LE(worst, 0.2);
  EXPECT_GT(worst, 0.19);
}

}  // namespace
}  // namespace gapscope::independent_plant
