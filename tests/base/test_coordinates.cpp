#include <gtest/gtest.h>

#include <limits>

#include "gapscope/base/coordinates.h"

namespace gapscope {
namespace {

constexpr Coordinates kTurning = Coordinates::kRotation, kSliding = Coordinates::kTranslation;

TEST(Coordinates, AreThoseOfARotationUnlessTold) {
  EXPECT_EQ(Coordinates(), kTurning);
  EXPECT_STREQ(kTurning.name(), "rotation");
  EXPECT_STREQ(kSliding.name(), "translation");
}

TEST(Coordinates, GiveTheUnitsOfTheDrive) {
  EXPECT_EQ(kTurning.unit("N m s/rad"), "N m s/rad");
  EXPECT_EQ(kSliding.unit("N m s/rad"), "N s/m");
  EXPECT_EQ(kSliding.unit("kg m^2"), "kg");
  EXPECT_EQ(kSliding.unit("rad/s^2"), "m/s^2");
  for (const Coordinates c : {kTurning, kSliding}) {
    EXPECT_EQ(c.position_unit(), c.unit("rad"));
    EXPECT_EQ(c.torque_unit(), c.unit("N m"));
  }
}

TEST(Coordinates, TypesetUnitsForReaders) {
  EXPECT_EQ(kTurning.shown_unit("N m s/rad"), "N·m s/rad");
  EXPECT_EQ(kSliding.shown_unit("N m/rad"), "N/m");
  EXPECT_EQ(kTurning.shown_unit("kg m^2"), "kg m²");
  EXPECT_EQ(kTurning.shown_unit("-"), "");
}

TEST(Coordinates, PutTheirUnitsIntoWords) {
  EXPECT_EQ(kTurning.with_units("[N m] for each [rad]"), "N m for each rad");
  EXPECT_EQ(kSliding.with_units("[N m] for each [rad]"), "N for each m");
  EXPECT_EQ(kSliding.with_units("from [{}, {}] [rad] on"), "from [{}, {}] m on");
}

TEST(Coordinates, TellALengthInThousandths) {
  EXPECT_EQ(kTurning.thousandths(0.0188), "18.8 mrad");
  EXPECT_EQ(kSliding.thousandths(0.0188), "18.8 mm");
  EXPECT_EQ(kSliding.thousandths(std::numeric_limits<double>::quiet_NaN()), "-");
}

}  // namespace
}  // namespace gapscope
