// A drive that is told otherwise is the same drive: what a command says of it is the same where it must be,
// and where it cannot be, that is told.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "metamorphic/relations.h"

namespace gapscope::metamorphic {
namespace {

struct Case {
  const Relation* relation;
  Base base;
  Command command;

  const Expected& expected() const { return relation->asked(command).expected; }
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << to_string(c.command) << " of " << letter_of(c.base);
}

/// Of each relation one command and one base, in turn; with GAPSCOPE_EVERY_BASE set all of them (.ci/hour).
std::vector<Case> cases() {
  const bool every = std::getenv("GAPSCOPE_EVERY_BASE") != nullptr;
  std::vector<Case> all;
  std::size_t turn = 0;
  for (const Relation& relation : relations()) {
    std::vector<Case> of_relation;
    for (const Command command : {Command::kDetect, Command::kRun, Command::kDiagnose})
      for (const char letter : std::string_view(relation.asked(command).bases))
        of_relation.push_back({&relation, base_of(letter), command});
    if (every)
      all.insert(all.end(), of_relation.begin(), of_relation.end());
    else
      all.push_back(of_relation[turn++ % of_relation.size()]);
  }
  return all;
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  std::string name = info.param.relation->name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return std::to_string(info.index) + "_" + name + "__" + to_string(info.param.command) + "_of_" +
         letter_of(info.param.base);
}

/// What it is compared with; of the base as it is it is asked but once.
const Answers& answers_before(const Case& c) {
  static std::map<std::pair<Base, Command>, Answers> of_bases;
  static Answers of_changed;
  if (c.relation->before == nullptr) {
    const auto [at, is_new] = of_bases.try_emplace({c.base, c.command});
    if (is_new) at->second = ask(c.command, drive_of(c.base));
    return at->second;
  }
  ToldDrive drive = drive_of(c.base);
  c.relation->before(drive);
  return of_changed = ask(c.command, drive);
}

Answers answers_after(const Case& c) {
  ToldDrive drive = drive_of(c.base);
  c.relation->change(drive);
  return ask(c.command, drive);
}

double half_width(const Interval& interval) { return 0.5 * (interval.high - interval.low); }

bool holds_truth(const Answers& answers, double truth) {
  return answers.gap.ci95.low <= truth && truth <= answers.gap.ci95.high;
}

void expect_equal(const Number& before, const Number& after, const Expected& expected) {
  EXPECT_NEAR(after.value, before.value, expected.tolerance * std::abs(before.value));
  const double width = half_width(before.ci95);
  EXPECT_EQ(std::isfinite(width), std::isfinite(half_width(after.ci95)));
  if (!std::isfinite(width)) return;
  EXPECT_NEAR(half_width(after.ci95), width, expected.width * width);
}

void expect_equal(const Answers& before, const Answers& after, const Expected& expected) {
  EXPECT_EQ(after.words, before.words);
  EXPECT_EQ(after.numbers.size(), before.numbers.size());
  for (const auto& [name, number] : before.numbers) {
    SCOPED_TRACE(name);
    const auto there = after.numbers.find(name);
    if (there != after.numbers.end()) expect_equal(number, there->second, expected);
  }
}

/// `check` knows how long a second is: of a drive at another speed it may find a recording too short.
void expect_same_findings(const Answers& before, const Answers& after) {
  if (after.time_scale == before.time_scale) {
    EXPECT_EQ(after.findings, before.findings);
  }
}

/// Both are read off other rows.
void expect_within(const Answers& before, const Answers& after) {
  for (const char* of : {"verdict", "verdict without a model"})
    if (before.words.contains(of)) {
      EXPECT_EQ(after.words.at(of), before.words.at(of));
    }
  const double joint = std::hypot(half_width(before.gap.ci95), half_width(after.gap.ci95));
  EXPECT_NEAR(after.gap.value, before.gap.value, joint);
}

void expect_told(const Answers& answers, double truth) {
  if (answers.trust != AnswerTrust::kGood) return;
  EXPECT_TRUE(holds_truth(answers, truth)) << answers.gap.value << " [" << answers.gap.ci95.low << ", "
                                           << answers.gap.ci95.high << "] of " << truth << " rad";
}

void expect_not_fresh(const Answers& answers) {
  const auto found = answers.findings.find("fresh samples");
  ASSERT_NE(found, answers.findings.end());
  EXPECT_EQ(found->second, Severity::kSpoils) << "is `" << to_string(found->second) << "`";
}

class ToldOtherwise : public ::testing::TestWithParam<Case> {};

TEST_P(ToldOtherwise, IsTheSameDriveOrThatIsTold) {
  const Case& c = GetParam();
  const Answers after = answers_after(c);
  if (c.expected().holds == Holds::kRefused) {
    EXPECT_NE(after.refusal, "");
    return;
  }
  ASSERT_EQ(after.refusal, "");
  if (c.relation->not_fresh) expect_not_fresh(after);
  if (c.expected().holds == Holds::kTold) return expect_told(after, true_gap(c.base));
  const Answers& before = answers_before(c);
  ASSERT_EQ(before.refusal, "");
  if (c.expected().holds == Holds::kEqual) {
    expect_equal(before, after, c.expected());
    if (c.expected().same_first) expect_same_findings(before, after);
  }
  if (c.expected().holds == Holds::kWithin) expect_within(before, after);
}

INSTANTIATE_TEST_SUITE_P(Relations, ToldOtherwise, ::testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace gapscope::metamorphic
