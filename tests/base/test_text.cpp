#include <gtest/gtest.h>

#include <vector>

#include "gapscope/base/text.h"

namespace gapscope {
namespace {

TEST(Text, IsReplacedWhereverItStandsAndNotInWhatReplacesIt) {
  EXPECT_EQ(replaced("a_b_c", "_", "__"), "a__b__c");
  EXPECT_EQ(replaced("abc", "x", "y"), "abc");
}

TEST(Text, OfAnIdentifierIsReadable) {
  EXPECT_EQ(readable("motor_coulomb_friction"), "motor coulomb friction");
}

TEST(Text, OfAListIsFoundAsAWhole) {
  const std::vector<std::string> names = {"gap", "mass_ratio"};
  EXPECT_TRUE(contains(names, "gap"));
  EXPECT_FALSE(contains(names, "mass"));
}

}  // namespace
}  // namespace gapscope
