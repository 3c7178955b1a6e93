#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
  EXPECT_THAT(check.out, HasSubstr("16 checks: 14 passed, 2 notes"));
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

TEST(Check, WritesNumbersAsAReaderDoesAndSaysWhereNoUnitIsDeclared) {
  Workplace place;
  testing::Rows rows = testing::rig();
  place.file("amperes.csv", rows.csv());
  EXPECT_THAT(place.run("check amperes.csv --input-unit A").out, HasSubstr("-0.5814 to 0.5814 A, no noise"));
  for (double& u : rows.u) u = std::fmod(std::round(885.0 * u) + 65536.0, 65536.0);
  place.file("register.csv", rows.csv());
  const auto check = place.run("check register.csv");
  EXPECT_THAT(check.out, HasSubstr("'u' is a signed register of 16 bits"));
  EXPECT_THAT(check.out, HasSubstr("-515 to 515 (no unit declared: --input-unit), noise"));
  EXPECT_THAT(check.out, ::testing::Not(HasSubstr("e+")));
}

TEST(Check, SaysWhichOfTwoRecordingsIsToBeFitted) {
  Workplace place;
  place.file("usual.csv", testing::rig().csv());
  place.file("strong.csv", testing::rig(sine(1.1628, 1.0)).csv());
  for (const char* files : {"usual.csv strong.csv", "strong.csv usual.csv"}) {
    const auto both = place.run(std::string("check ") + files + " --for diagnosis");
    EXPECT_EQ(both.status, 0) << both.out;
    EXPECT_THAT(both.out, HasSubstr("order       strong.csv asks more of the drive"));
    EXPECT_THAT(both.out, HasSubstr("input up to 1.16 against 0.581 units of u"));
    EXPECT_THAT(both.out, HasSubstr("recording: {file: strong.csv, held_out: usual.csv}"));
  }
  EXPECT_THAT(place.run("check usual.csv usual.csv --for diagnosis").out,
              ::testing::Not(HasSubstr("asks more of the drive")));
}

TEST(Check, JudgesForTheQuestionAndSeveralFilesTogether) {
  Workplace place;
  testing::Rows rows = testing::rig();
  place.file("good.csv", rows.csv());
  for (double& u : rows.u) u = -u;
  place.file("wrong.csv", rows.csv());
  const auto gap = place.run("check wrong.csv --for gap");
  EXPECT_EQ(gap.status, 0) << gap.out;
  EXPECT_THAT(gap.out, HasSubstr("16 checks, for gap: "));
  EXPECT_THAT(gap.out, HasSubstr("for a gap read from impacts x1 is enough"));
  const auto fit = place.run("check good.csv wrong.csv --for fit");
  EXPECT_EQ(fit.status, 3);
  EXPECT_THAT(fit.out, HasSubstr("1 of 16 checks, for fit found what spoils the answer: sign"));
  const auto both = place.run("check good.csv good.csv --for diagnosis");
  EXPECT_EQ(both.status, 0) << both.out;
  EXPECT_THAT(both.out, HasSubstr("together    all 2 recordings ask the drive the same"));
  EXPECT_EQ(place.run("check wrong.csv --picture seen.png").status, 3);
  EXPECT_THAT(testing::text_of(place.folder() / "seen.png"), ::testing::StartsWith("\x89PNG"));
  const auto taken = place.run("check good.csv --picture seen.png");
  EXPECT_EQ(taken.status, 2) << "nothing is overwritten";
  EXPECT_EQ(taken.out, "") << "a name that is taken is told before the work";
  const auto json = place.run("check wrong.csv --for gap --json");
  EXPECT_EQ(nlohmann::json::parse(json.out)["asked_for"], "gap");
  EXPECT_THAT(place.run("check good.csv wrong.csv --json").err,
              HasSubstr("expected one file and one axis beside them instead of 2"));
}

/// A note for the estimates, but no one model has both: whoever fits or holds it out is told.
TEST(Check, InitWarnsOfADriveThatIsSwitchedOffInAHeldOutRecording) {
  Workplace place;
  testing::Rows rows = testing::rig();
  place.file("on.csv", rows.csv());
  for (std::size_t i = rows.u.size() / 2; i < rows.u.size(); ++i) rows.u[i] = 0.0;
  place.file("off.csv", rows.csv());
  EXPECT_THAT(place.run("init on.csv --held-out off.csv --model gap").err,
              AllOf(HasSubstr("warning: off.csv: input: "), HasSubstr("was the drive switched off there?")));
  EXPECT_EQ(place.run("init on.csv --model gap -o alone.yaml").err, "");
}

TEST(Check, CountsAreWholeNumbersAndAStepIsAsTheEncoderSays) {
  Workplace place;
  testing::Rows rows = testing::rig();
  std::string grouped = "t\tu\tx1\n", whole = grouped;  // thousands with a comma, beside decimal commas
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    const long counts = 100000 + std::lround(rows.x1[i] / 6.283185307179586 * 262144.0);
    std::string begin = fmt::format("{}\t{}\t", rows.t[i], rows.u[i]);
    std::replace(begin.begin(), begin.end(), '.', ',');
    grouped += begin + fmt::format("{},{:03}\n", counts / 1000, counts % 1000);
    whole += begin + fmt::format("{},0\n", counts);
  }
  place.file("grouped.csv", grouped), place.file("whole.csv", whole);
  const auto spoilt = place.run("check grouped.csv --position-unit counts --bits 18");
  EXPECT_EQ(spoilt.status, 3) << spoilt.err;
  EXPECT_THAT(spoilt.out, HasSubstr("x1 steps by 1/1000 of a count (23.97 nrad): counts are whole numbers"));
  EXPECT_EQ(place.run("check whole.csv --position-unit counts --bits 18").status, 0);
  place.file("r.csv", rows.csv());
  EXPECT_THAT(place.run("check r.csv --bits 16").out,
              HasSubstr("x1 steps by 23.97 µrad where encoder: says 95.87 µrad"));
}

}  // namespace
}  // namespace gapscope
