// Which of two recordings `init` would rather fit, and the command that it tells for that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"
#include "cli/one_body_csv.h"
#include "support/data.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::Workplace;

TEST(InitOrder, SaysWhichOfTwoRecordingsIsBetterFittedAndSwapsNothing) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  const auto weak = [](double t) { return 0.1 * std::sin(9.0 * t) + 0.06 * std::sin(31.0 * t); };
  place.file("rich.csv", one_body_csv(input));
  place.file("poor.csv", one_body_csv(weak));
  const std::string init = "init --model one_body --input-unit V ";
  const auto good = place.run(init + "rich.csv --held-out poor.csv -o good.yaml");
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("order       good as it is: rich.csv is fitted"));
  EXPECT_THAT(good.out, ::testing::ContainsRegex("input up to 0[.][0-9]+ against 0[.]1[0-9]* V"));
  const auto wrong = place.run(init + "poor.csv --held-out rich.csv -o wrong.yaml");
  EXPECT_EQ(wrong.status, 0) << wrong.err;
  EXPECT_THAT(wrong.out, HasSubstr("order       better the other way round: rich.csv asks more"));
  EXPECT_THAT(wrong.out, HasSubstr("-> gapscope init rich.csv --held-out poor.csv --input-unit V --model "
                                   "one_body -o wrong_turned_round.yaml\n"));
  const std::string yaml = testing::text_of(place.folder() / "wrong.yaml");
  EXPECT_THAT(yaml, HasSubstr("# better the other way round"));
  EXPECT_THAT(yaml, HasSubstr("file: \"poor.csv\"\n  held_out: \"rich.csv\""));
  place.file("again.csv", one_body_csv(input));
  EXPECT_THAT(place.run(init + "rich.csv --held-out again.csv -o same.yaml").out,
              HasSubstr("either recording may be fitted: both go as far"));
  EXPECT_THAT(place.run(init + "rich.csv -o alone.yaml").out, Not(HasSubstr("order ")));
  EXPECT_THAT(place.run("init --help").out, HasSubstr("is better fitted"));
}

/// With every option that was given, so that it can be pasted.
TEST(InitOrder, TheCommandForTheOtherWayRoundReadsTheFilesAsTheFirstOneDid) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  const auto weak = [](double t) { return 0.1 * std::sin(9.0 * t) + 0.06 * std::sin(31.0 * t); };
  place.file("rich.csv", one_body_csv(input));
  place.file("poor one.csv", one_body_csv(weak));
  const std::string options =
      " --input-unit 'N m' --position-unit deg --gear-ratio=-30 --window 0.5 5.5 --model one_body";
  const auto wrong = place.run("init 'poor one.csv' --held-out rich.csv -o first.yaml" + options);
  ASSERT_EQ(wrong.status, 0) << wrong.err;
  const std::string start = "-> gapscope ", all = wrong.out.substr(wrong.out.find(start) + start.size());
  const std::string command = all.substr(0, all.find('\n'));
  EXPECT_THAT(command, HasSubstr("init rich.csv --held-out 'poor one.csv' "));
  ASSERT_EQ(place.run(command).status, 0) << command;
  const auto from = [](const std::string& yaml, const char* key) { return yaml.substr(yaml.find(key)); };
  const std::string first = testing::text_of(place.folder() / "first.yaml");
  const std::string second = testing::text_of(place.folder() / "first_turned_round.yaml");
  const auto columns = [&](const std::string& yaml) {
    const std::string rest = from(yaml, "  columns:");
    return rest.substr(0, rest.find("\nencoder"));
  };
  EXPECT_EQ(columns(first), columns(second));
  EXPECT_THAT(columns(second), HasSubstr("position: -30"));
}

}  // namespace
}  // namespace gapscope
