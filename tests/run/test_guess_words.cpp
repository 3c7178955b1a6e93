#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/run_words.h"

namespace gapscope::internal::run {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Configuration anchored(const std::string& anchor) {
  return parse_configuration(
      "recording: {file: servo.csv}\nmodel: {parameters: {mass_ratio: 0}}\nanchor: " + anchor + "\n",
      "c.yaml");
}

TEST(HangingWarning, IsOfAnArmThatEndsAtTheEdgeOfWhereItMayHang) {
  const Configuration about_zero = anchored("{mass: 0.49, arm: 0.1}");
  EXPECT_THAT(hanging_warning(about_zero, 0.5),
              AllOf(HasSubstr("(-0.5 to 0.5 rad)"), HasSubstr("anchor: hangs_at:")));
  EXPECT_THAT(hanging_warning(about_zero, -0.49999), HasSubstr("at the edge"));
  EXPECT_EQ(hanging_warning(about_zero, 0.3), "");
  const std::string elsewhere =
      "{mass: 0.49, arm: 0.1, hangs_at: {value: 3.14, estimate: true, bounds: [2.64, 3.64]}}";
  EXPECT_THAT(hanging_warning(anchored(elsewhere), -3.64), HasSubstr("(2.64 to 3.64 rad)"));
  EXPECT_EQ(hanging_warning(anchored(elsewhere), -3.13), "");
}

TEST(HangingWarning, IsNotOfAnAngleThatIsKnownOrOfAnotherAnchor) {
  EXPECT_EQ(hanging_warning(anchored("{mass: 0.49, arm: 0.1, hangs_at: 0.5}"), -0.5), "");
  EXPECT_EQ(hanging_warning(anchored("{inertia: 8.8e-4}"), 0.5), "");
}

TEST(HangingWarning, ReadsTheModelOfADiagnosis) {
  const Configuration c = anchored("{mass: 0.49, arm: 0.1}");
  ReferenceModel fitted = c.reference_model();
  fitted.effects[0].parameters[1].value = 0.1;
  EXPECT_EQ(hanging_warning(c, fitted), "");
  fitted.effects[0].parameters[1].value = -0.5;
  EXPECT_THAT(hanging_warning(c, fitted), HasSubstr("at the edge"));
}

}  // namespace
}  // namespace gapscope::internal::run
