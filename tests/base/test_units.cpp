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

TEST(Units, AreTypesetForReaders) {
  EXPECT_EQ(shown_unit("N m s/rad", true), "N·m s/rad");
  EXPECT_EQ(shown_unit("N m/rad", false), "N/m");
  EXPECT_EQ(shown_unit("kg m^2", true), "kg m²");
  EXPECT_EQ(shown_unit("-", true), "");
}

}  // namespace
}  // namespace gapscope
