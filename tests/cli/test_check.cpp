#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "inspection/rows.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::Workplace;

TEST(Check, AGoodRecordingEndsWithZeroAndKeepsItsFindings) {
  Workplace place;
  place.file("r.csv", testing::rig().csv());
  const auto check = place.run("check r.csv -o r.json");
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_EQ(check.err, "");
  EXPECT_THAT(check.out, HasSubstr("16 checks: 15 passed, 1 note"));
  const auto stored = nlohmann::json::parse(testing::text_of(place.folder() / "r.json"));
  EXPECT_EQ(stored["schema"], "gapscope.check/1");
  EXPECT_EQ(stored["spoilt"], false);
  EXPECT_EQ(stored["findings"].size(), 16u);
  EXPECT_EQ(stored["findings"][0]["severity"], "fine");
  EXPECT_NEAR(stored["facts"]["rate_hz"].get<double>(), 1000.0, 1e-6);
  EXPECT_EQ(place.run("check r.csv --json").out, testing::text_of(place.folder() / "r.json"));
}

TEST(Check, ASpoiltRecordingEndsWithThreeAndSaysWhatToDo) {
  Workplace place;
  testing::Rows rows = testing::rig();
  for (double& u : rows.u) u = -u;
  place.file("wrong.csv", "time,i_q,theta\n" + rows.csv().substr(7));
  const auto check = place.run("check wrong.csv --time time --input i_q --position theta --window 1 7");
  EXPECT_EQ(check.status, 3) << check.err;
  EXPECT_THAT(check.out, HasSubstr("-> turn the sign of u or of x1"));
  EXPECT_THAT(check.out, HasSubstr("1 of 16 checks found what spoils the estimates: sign"));
  const auto json = place.run("check wrong.csv --time time --input i_q --position theta --json");
  EXPECT_EQ(json.status, 3);
  EXPECT_EQ(nlohmann::json::parse(json.out)["spoilt"], true);
}

}  // namespace
}  // namespace gapscope
