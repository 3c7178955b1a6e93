#include <gtest/gtest.h>

#include <vector>

#include "base/shell_word.h"
#include "base/text.h"

namespace gapscope {
namespace {

TEST(Text, IsReplacedWhereverItStandsAndNotInWhatReplacesIt) {
  EXPECT_EQ(replaced("a_b_c", "_", "__"), "a__b__c");
  EXPECT_EQ(replaced("abc", "x", "y"), "abc");
}

TEST(Text, OfAnIdentifierIsReadable) {
  EXPECT_EQ(readable("motor_coulomb_friction"), "motor Coulomb friction");
  EXPECT_EQ(name_of_key("stribeck_speed_rad_s"), "Stribeck speed");
  EXPECT_EQ(range_words("34..51 mm/s"), "34–51 mm/s");
  EXPECT_EQ(range_words("-62..53 mN m"), "-62 to 53 mN·m");
}

TEST(Text, OfAListIsFoundAsAWhole) {
  const std::vector<std::string> names = {"gap", "mass_ratio"};
  EXPECT_TRUE(contains(names, "gap"));
  EXPECT_FALSE(contains(names, "mass"));
}

TEST(Text, TheNearestNameHasTheWordInItOrIsFewestLettersAway) {
  const std::vector<std::string> names = {"backlash", "motor_coulomb_friction", "load_coulomb_friction",
                                          "run"};
  EXPECT_EQ(nearest_name("coulomb", names), "load_coulomb_friction");
  EXPECT_EQ(nearest_name("rnu", names), "run");
  EXPECT_EQ(nearest_name("baklash", names), "backlash");
  EXPECT_EQ(nearest_name("", names), "run");
}

TEST(Text, TheEditDistanceCountsLettersPutInLeftOutAndReplaced) {
  EXPECT_EQ(edit_distance("gap", "gap"), 0u);
  EXPECT_EQ(edit_distance("gap", "gaps"), 1u);
  EXPECT_EQ(edit_distance("gap", "cap"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "gap"), 3u);
}

TEST(Text, APathIsOneWordForAShell) {
  EXPECT_EQ(shell_word("rigs/left-arm_2.yaml"), "rigs/left-arm_2.yaml");
  EXPECT_EQ(shell_word("my drive.yaml"), "'my drive.yaml'");
  EXPECT_EQ(shell_word("the drive's $1.yaml"), R"('the drive'\''s $1.yaml')");
  EXPECT_EQ(shell_word("-o.yaml"), "./-o.yaml") << "no option";
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace gapscope
