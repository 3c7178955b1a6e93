#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gapscope/recording/recording_file.h"
#include "recording/register_look.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFile;

TEST(Units, EachIsWhatItsNameSays) {
  const double turn = 2.0 * std::numbers::pi;
  const auto si = [](Quantity quantity, const char* unit, double value) {
    const auto scale = unit_scale(quantity, unit);
    return scale ? (*scale)(value) : -1.0;
  };
  EXPECT_EQ(si(Quantity::kTime, "ms", 7.0), 0.007);  // to the last bit
  EXPECT_EQ(si(Quantity::kTime, "us", 3.0), 3e-6);
  EXPECT_DOUBLE_EQ(si(Quantity::kAngle, "deg", 360.0), turn);
  EXPECT_DOUBLE_EQ(si(Quantity::kAngle, "arcmin", 360.0 * 60.0), turn);
  EXPECT_DOUBLE_EQ(si(Quantity::kAngle, "arcsec", 360.0 * 3600.0), turn);
  EXPECT_DOUBLE_EQ(si(Quantity::kAngle, "rev", 1.0), turn);
  EXPECT_EQ(si(Quantity::kAngle, "mrad", 5.0), 0.005);
  EXPECT_EQ(si(Quantity::kLength, "um", 5.0), 5e-6);
  EXPECT_EQ(si(Quantity::kTorque, "mN m", 5.0), 0.005);
  EXPECT_EQ(si(Quantity::kForce, "kN", 2.0), 2000.0);
  EXPECT_EQ(si(Quantity::kAngle, "1.5e-3", 2.0), 0.003);
  for (const char* none : {"mm", "degree", "", "0", "-1", "inf", "nan", "1 rad", "Deg", "1e99"})
    EXPECT_FALSE(unit_scale(Quantity::kAngle, none)) << none;
  EXPECT_THAT(known_units(Quantity::kTime),
              HasSubstr("ms, us, ns, 100ns, min, or a number (s per recorded unit)"));
}

TEST(Units, OfATorqueAreTakenAsTheyAreCommonlyWritten) {
  for (const char* written : {"N m", "Nm", "N.m", "N*m", "N·m"}) {
    const auto scale = unit_scale(Quantity::kTorque, written);
    ASSERT_TRUE(scale) << written;
    EXPECT_EQ((*scale)(5.0), 5.0) << written;
    EXPECT_EQ(si_unit(Quantity::kTorque, written), "N m") << written;
  }
  EXPECT_EQ((*unit_scale(Quantity::kTorque, "mNm"))(5.0), 0.005);
  EXPECT_EQ(si_unit(Quantity::kTorque, "kN*m"), "N m");
  EXPECT_EQ((*unit_scale(Quantity::kTorque, "Nmm"))(5.0), 0.005);
  EXPECT_EQ((*unit_scale(Quantity::kTorque, "N.cm"))(5.0), 0.05);
  EXPECT_NEAR((*unit_scale(Quantity::kTorque, "ozf in"))(1.0), 7.0616e-3, 1e-7);
  for (const char* none : {"nm", "NM", "N  m", "N/m", "N m ", "Nkm", "N m m", "N", "m"})
    EXPECT_FALSE(unit_scale(Quantity::kTorque, none)) << none;
  EXPECT_FALSE(unit_scale(Quantity::kForce, "Nm"));
}

/// 120 rows of whole numbers.
std::string rows() {
  std::string text = "t,u,x1,x2\n";
  for (int i = 0; i < 120; ++i)
    text += std::to_string(i) + "," + std::to_string(i % 7) + "," + std::to_string(3 * i) + "," +
            std::to_string(-i) + "\n";
  return text;
}

TEST(Units, EveryColumnOfACsvIsBroughtToSi) {
  const TemporaryFile file(rows());
  ReadOptions options;
  options.columns.scales = {{1.0, 1000.0}, {2.0, 1.0}, {std::numbers::pi, 180.0}, {1.0, -50.0}};
  options.window = {0.02, 1.0};  // of the time in s
  const Recording r = read_recording(file.path(), options);
  EXPECT_EQ(r.start, 0.02);
  EXPECT_DOUBLE_EQ(r.dt, 0.001);
  EXPECT_EQ(r.u[1], 0.0);
  EXPECT_EQ(r.u[3], 4.0);
  EXPECT_DOUBLE_EQ(r.x1[0], std::numbers::pi / 3.0);
  EXPECT_EQ(r.x2[30], 1.0);
}

TEST(Units, ARegisterIsKnownByTheShorterWayOfItsNumbersHoweverFarTheySwing) {
  for (const int bits : {8, 16}) {
    const int all = 1 << bits, most = all / 2 - 1;
    for (const double part : {0.02, 0.4, 0.8, 1.0}) {
      std::vector<double> twos, offset;
      for (int i = 0; i < 1000; ++i) {
        const int value = static_cast<int>(std::lround(part * most * std::sin(0.05 * i)));
        twos.push_back((value + all) % all), offset.push_back(value + all / 2);
      }
      EXPECT_EQ(seen_register(twos).bits, bits) << part;
      EXPECT_EQ(seen_register(offset).is_one(), false) << part;
    }
  }
  std::vector<double> relay;  // full and none, of a duty of 8 bits
  for (int i = 0; i < 1000; ++i) relay.push_back(i / 100 % 2 == 0 ? 255.0 : 0.0);
  EXPECT_FALSE(seen_register(relay).is_one());
}

TEST(Units, ANumberThatTheUnitMakesInfiniteIsNone) {
  const TemporaryFile file(rows() + "120,1,1e308,0\n");
  ReadOptions options;
  options.columns.scales.position = {10.0, 1.0};
  EXPECT_THAT(testing::refusal([&] { read_recording(file.path(), options); }),
              HasSubstr("r.csv:122: x1 is '1e308', expected a finite number"));
}

}  // namespace
}  // namespace gapscope
