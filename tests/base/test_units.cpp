#include <gtest/gtest.h>

#include "gapscope/base/units.h"

namespace gapscope {
namespace {

TEST(Units, AreThoseOfTheAxis) {
  EXPECT_EQ(axis_unit("N m s/rad", true), "N m s/rad");
  EXPECT_EQ(axis_unit("N m s/rad", false), "N s/m");
  EXPECT_EQ(axis_unit("kg m^2", false), "kg");
  EXPECT_EQ(axis_unit("rad/s^2", false), "m/s^2");
}

TEST(Units, StandBehindTheNumbersOfASentence) {
  const std::string said =
      "a gap of 0.0021 rad, damping 20 N m s/rad, level from 1.2 to 3e-05 N m; drag 2 N m s^2/rad^2, 7 "
      "rad/s² "
      "in 3 N moves, inertia 5 kg m^2.";
  EXPECT_EQ(axis_sentence(said, true), said);
  EXPECT_EQ(axis_sentence(said, false),
            "a gap of 0.0021 m, damping 20 N s/m, level from 1.2 to 3e-05 N; drag 2 N s^2/m^2, 7 m/s² "
            "in 3 N moves, inertia 5 kg.");
  EXPECT_EQ(axis_sentence("12 radii, gap_rad 3 radial N m", false), "12 radii, gap_rad 3 radial N m");
}

TEST(Units, AreTypesetForReaders) {
  EXPECT_EQ(shown_unit("N m s/rad", true), "N·m s/rad");
  EXPECT_EQ(shown_unit("N m/rad", false), "N/m");
  EXPECT_EQ(shown_unit("kg m^2", true), "kg m²");
  EXPECT_EQ(shown_unit("-", true), "");
}

}  // namespace
}  // namespace gapscope
