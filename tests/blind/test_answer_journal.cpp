// The answers so far: what of them is believed when the work goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "blind/answer_journal.h"
#include "gapscope/base/errors.h"
#include "support/company.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope::blind {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::refusal;
using testing::text_of;

constexpr const char* kCheck = "manifest 0123, gapscope 1.0";

BlindAnswer answer_named(const std::string& name) {
  BlindAnswer a;
  a.name = name;
  a.verdict = "none";
  a.before = 1.25;
  return a;
}

/// A journal with three answers.
class WrittenJournal {
 public:
  WrittenJournal() {
    AnswerJournal journal(path(), kCheck);
    for (const char* name : {"a", "b", "c"}) journal.add(answer_named(name));
  }
  std::string path() const { return (place_.folder() / "answers.json.partial").string(); }
  std::vector<std::string> lines() const {
    std::istringstream in(text_of(path()));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  void write(const std::vector<std::string>& lines) const {
    std::ofstream out(path());
    for (const std::string& line : lines) out << line << '\n';
  }
  std::string refused() const {
    return refusal([&] { AnswerJournal(path(), kCheck); });
  }

 private:
  testing::TemporaryFile place_{""};
};

TEST(AnswerJournal, GoesOnWithWhatItWroteAndDropsATornLine) {
  const WrittenJournal written;
  std::ofstream(written.path(), std::ios::app) << written.lines()[2].substr(0, 100);
  {
    AnswerJournal journal(written.path(), kCheck);
    EXPECT_EQ(journal.answers().size(), 3u);
    journal.add(answer_named("d"));
  }
  EXPECT_EQ(AnswerJournal(written.path(), kCheck).answers().size(), 4u);
}

TEST(AnswerJournal, RefusesWhatIsNotAsItWasWritten) {
  using Lines = std::vector<std::string>;
  const auto changes =
      std::vector<void (*)(Lines&)>{[](Lines& l) { l[1].replace(l[1].find("1.25"), 4, "1.26"); },  // a number
                                    [](Lines& l) { l.erase(l.begin() + 1); },
                                    [](Lines& l) { std::swap(l[1], l[2]); },
                                    [](Lines& l) { l.push_back(l[3]); },
                                    [](Lines& l) { l[2][0] = l[2][0] == '0' ? '1' : '0'; },
                                    [](Lines& l) { l[2].erase(0, l[2].find(' ') + 1); },  // without its hash
                                    [](Lines& l) { l.insert(l.begin() + 1, ""); }};
  for (const auto change : changes) {
    const WrittenJournal written;
    Lines lines = written.lines();
    change(lines);
    written.write(lines);
    const std::string before = text_of(written.path());
    EXPECT_THAT(written.refused(), HasSubstr("is not as it was written"));
    EXPECT_EQ(text_of(written.path()), before);
  }
}

TEST(AnswerJournal, HoldsOneAnswerToEachCase) {
  const WrittenJournal written;
  AnswerJournal(written.path(), kCheck).add(answer_named("b"));  // as only another program would
  EXPECT_THAT(written.refused(), HasSubstr("answers 'b' again"));
}

TEST(AnswerJournal, OfAnEarlierFormatIsToldToBeRemoved) {
  const WrittenJournal written;
  std::ofstream(written.path()) << kCheck << "\n{}\n";
  EXPECT_THAT(written.refused(), HasSubstr(".partial:1: begins with 'manifest 0123, gapscope 1.0', expected "
                                           "'gapscope.answers_so_far/2, manifest 0123, gapscope 1.0'; "
                                           "remove it to start again"));
}

TEST(AnswerJournal, RemovesNothingThatCameInItsPlace) {
  if (!testing::company_can_come()) GTEST_SKIP() << "no filter of system calls here";
  for (int when = 1, moments = 1; when <= moments; ++when) {
    const WrittenJournal written;
    AnswerJournal journal(written.path(), kCheck);
    const auto company = [&](int moment, long) {
      if (moment != when) return 0;
      std::ofstream(written.path() + ".saved") << "mine";
      fs::rename(written.path() + ".saved", written.path());
      return 0;
    };
    moments = testing::in_company(company, [&] { journal.remove(); }).moments;
    EXPECT_EQ(text_of(written.path()), "mine") << "moment " << when;
  }
}

}  // namespace
}  // namespace gapscope::blind
