#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "base/interrupt.h"
#include "blind/answer_journal.h"
#include "blind/blind_check.h"
#include "gapscope/base/errors.h"
#include "results/blind_files.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using testing::refusal;
using testing::text_of;

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A check of three cases, made, answered on two threads and copied for each test.
class Answered {
 public:
  Answered() { fs::copy(original(), place_.folder(), fs::copy_options::recursive); }
  std::string path(const char* name) const { return (place_.folder() / name).string(); }
  std::string score() const {
    return refusal([&] { score_blind_check(path("cases"), path("labels.json"), path("answers.json")); });
  }
  BlindAnswers answers() const { return read_blind_answers(path("answers.json")); }

 private:
  static fs::path original() {
    static const testing::TemporaryFile place("");
    static const bool once = [] {
      fs::remove(place.path());
      BlindConfig c;
      c.name = "small";
      c.report = {9000001, 0, 0, 3, 0};  // quickly answered
      c.rigs = {"geared"};
      c.duration = 2.0;
      run_blind_check(c, place.folder().string(), 2);
      return true;
    }();
    return once ? place.folder() : fs::path();
  }
  testing::TemporaryFile place_{""};
};

/// What a journal of these answers begins with.
std::string check_of(const BlindAnswers& answers) {
  return "manifest " + answers.manifest_sha256 + ", gapscope " + answers.version;
}

TEST(BlindAnswer, IsTheSameOnOneThreadAndAfterAKill) {
  const Answered check;
  const std::string journal = check.path("again.json") + ".partial";
  const BlindAnswers whole = check.answers();
  blind::AnswerJournal(journal, check_of(whole)).add(whole.cases[1]);
  std::ofstream(journal, std::ios::app)
      << line_of(whole.cases[0]).substr(0, 100);  // of a second, half a line
  std::size_t first = 0;
  answer_blind_check(check.path("cases"), check.path("again.json"), 1, [&](std::size_t done, std::size_t) {
    if (first == 0) first = done;
  });
  EXPECT_EQ(first, 2u);
  EXPECT_EQ(text_of(check.path("again.json")), text_of(check.path("answers.json")));
  EXPECT_FALSE(fs::exists(journal));
}

TEST(BlindAnswer, GoesOnWithNoAnswersToAnotherCheck) {
  const Answered check;
  std::ofstream(check.path("again.json.partial")) << "manifest 0123, gapscope 1.0\n";
  EXPECT_THAT(refusal([&] { answer_blind_check(check.path("cases"), check.path("again.json"), 1); }),
              HasSubstr("again.json.partial:1: "));
}

TEST(BlindAnswer, RefusesASwappedRecording) {
  const Answered check;
  fs::copy(check.path("cases/case_001_train.csv"), check.path("cases/case_002_train.csv"),
           fs::copy_options::overwrite_existing);
  EXPECT_THAT(refusal([&] { answer_blind_check(check.path("cases"), check.path("again.json"), 1); }),
              HasSubstr("case_002_train.csv: is not the file of case_002 that was sealed"));
  EXPECT_THAT(check.score(), HasSubstr("is not the file of case_002 that was sealed"));
}

TEST(BlindAnswer, AStopLeavesNoAnswerThatAWholeRunWouldNotGive) {
  const Answered check;
  std::map<std::string, std::string> whole;
  for (const BlindAnswer& a : check.answers().cases) whole[a.name] = line_of(a);
  const std::string again = check.path("again.json");
  for (const int after : {150, 50, 250, 20, 100, 200, 300, 400}) {  // milliseconds
    std::thread stop([after] {
      std::this_thread::sleep_for(std::chrono::milliseconds(after));
      request_stop();
    });
    try {
      answer_blind_check(check.path("cases"), again, 1);
    } catch (const Interrupted&) {
    }
    stop.join();
    clear_stop_request();
    std::ifstream journal(again + ".partial");
    std::string line;
    std::getline(journal, line);  // of what check
    while (std::getline(journal, line)) {
      line.erase(0, line.find(' ') + 1);  // the hash of all before it
      const BlindAnswer answer = blind_answer_of(line, "journal");
      EXPECT_EQ(line, whole.at(answer.name)) << after << " ms";
    }
  }
  answer_blind_check(check.path("cases"), again, 1);
  EXPECT_EQ(text_of(again), text_of(check.path("answers.json")));
}

TEST(BlindAnswer, IsToWhatWasSealedAlsoWhereThatIsSwappedMeanwhile) {
  const Answered check;
  const fs::path cases = check.path("cases");
  const auto swap_the_last = [&](std::size_t, std::size_t) {  // when the first one is answered
    for (const char* part : {"_train.csv", "_held_out.csv"})
      fs::copy(cases / ("case_001" + std::string(part)), cases / ("case_003" + std::string(part)),
               fs::copy_options::overwrite_existing);
  };
  EXPECT_THAT(
      refusal([&] { answer_blind_check(cases.string(), check.path("again.json"), 1, swap_the_last); }),
      HasSubstr("is not the file of case_003 that was sealed"));
}

TEST(BlindAnswer, TakesNoFileOfSomebodyElse) {
  const Answered check;
  for (const char* name : {"again.json", "again.json.partial"}) {
    std::ofstream(check.path(name)) << "mine";
    EXPECT_THAT(refusal([&] { answer_blind_check(check.path("cases"), check.path("again.json"), 1); }),
                HasSubstr(name));
    EXPECT_EQ(text_of(check.path(name)), "mine");
    fs::remove(check.path(name));
  }
}

TEST(BlindAnswer, KeepsNoAnswerThatWasPutIntoItsJournal) {
  const Answered check;
  const BlindAnswers whole = check.answers();
  const auto changes = std::vector<void (*)(BlindAnswer&)>{
      [](BlindAnswer& a) { a.verdict = "effect"; }, [](BlindAnswer& a) { a.verdict = "perhaps"; },
      [](BlindAnswer& a) { a.files[0].sha256[0] ^= 1; },
      [](BlindAnswer& a) { a.headline.assign(200000, '1'); }};
  for (const auto change : changes) {
    BlindAnswer forged = whole.cases[0];
    change(forged);
    fs::remove(check.path("again.json.partial"));
    blind::AnswerJournal(check.path("again.json.partial"), check_of(whole)).add(forged);
    EXPECT_THAT(refusal([&] { answer_blind_check(check.path("cases"), check.path("again.json"), 1); }),
                HasSubstr("again.json.partial: "));
  }
}

TEST(BlindAnswer, TakesNoRecordingThatWasNotSealed) {
  const Answered check;
  const std::string path = check.path("cases/manifest.json");
  BlindManifest manifest = read_blind_manifest(path);
  manifest.cases[0].files.erase(manifest.cases[0].files.begin() + 1);
  write_blind_manifest(path, manifest);
  EXPECT_THAT(refusal([&] { answer_blind_check(check.path("cases"), check.path("again.json"), 1); }),
              HasSubstr("expected a recording that was sealed with it"));
}

TEST(BlindCheck, ScoresWhatNobodyChanged) { EXPECT_EQ(Answered().score(), ""); }

/// How often a file is opened meanwhile.
template <class Action>
int openings(const std::string& file, Action action) {
  const int watch = inotify_init1(IN_NONBLOCK);
  inotify_add_watch(watch, file.c_str(), IN_OPEN | IN_CLOSE);
  action();
  alignas(inotify_event) std::array<char, 4096> events{};
  const ssize_t size = read(watch, events.data(), events.size());
  close(watch);
  int count = 0;
  for (ssize_t at = 0; at < size; at += static_cast<ssize_t>(sizeof(inotify_event))) {  // of a file: no names
    inotify_event event{};
    std::memcpy(&event, events.data() + at, sizeof(event));
    count += (event.mask & IN_OPEN) != 0 ? 1 : 0;
  }
  return count;
}

TEST(BlindCheck, ReadsItsManifestOnceSoThatWhatIsJudgedIsWhatIsHashed) {
  const Answered check;
  const std::string manifest = check.path("cases/manifest.json");
  EXPECT_EQ(openings(manifest, [&] { EXPECT_EQ(check.score(), ""); }), 1);
  const auto answer = [&] { answer_blind_check(check.path("cases"), check.path("again.json"), 1); };
  EXPECT_EQ(openings(manifest, answer), 1);
}

TEST(BlindCheck, RefusesAChangedAnswer) {
  const Answered check;
  const auto changes = std::vector<void (*)(BlindAnswer&)>{
      [](BlindAnswer& a) { a.verdict = "unknown"; }, [](BlindAnswer& a) { a.effects = {"gap_growth"}; },
      [](BlindAnswer& a) { a.shrink = 0.5; }, [](BlindAnswer& a) { a.evidence.nominal.score += 1e-9; },
      [](BlindAnswer& a) { a.seal[0] = a.seal[0] == '0' ? '1' : '0'; }};
  for (const auto change : changes) {
    BlindAnswers changed = check.answers();
    change(changed.cases[1]);
    write_blind_answers(check.path("changed.json"), changed);
    EXPECT_THAT(refusal([&] {
                  score_blind_check(check.path("cases"), check.path("labels.json"),
                                    check.path("changed.json"));
                }),
                HasSubstr("changed.json: has another answer to case_002 than the one that was sealed"));
  }
}

TEST(BlindCheck, RefusesAnswersThatWereGivenToOtherRecordingsOrLeftOut) {
  const Answered check;
  const BlindManifest manifest = read_blind_manifest(check.path("cases/manifest.json"));
  BlindAnswers swapped = check.answers();
  std::swap(swapped.cases[0].files, swapped.cases[1].files);
  EXPECT_THAT(refusal([&] { verify_answers(manifest, swapped, "a.json"); }), HasSubstr("other recordings"));
  BlindAnswers fewer = check.answers();
  fewer.cases.pop_back();
  EXPECT_THAT(refusal([&] { verify_answers(manifest, fewer, "a.json"); }), HasSubstr("answers 2 cases"));
}

TEST(BlindCheck, RefusesAnswersWithAnotherSealThanTheAnnouncedOne) {
  const Answered check;
  const auto score = [&](const std::string& seal) {
    return refusal([&] {
      score_blind_check(check.path("cases"), check.path("labels.json"), check.path("answers.json"), seal);
    });
  };
  EXPECT_EQ(score(check.answers().seal()), "");
  EXPECT_THAT(score(std::string(64, '0')), HasSubstr("expected the one announced"));
}

TEST(BlindCheck, TellsWhetherAnAnnouncedSealWasChecked) {
  const Answered check;
  const auto scored = [&](const std::string& seal) {
    return score_blind_check(check.path("cases"), check.path("labels.json"), check.path("answers.json"), seal)
        .announced_seal;
  };
  EXPECT_EQ(scored(""), "");
  EXPECT_EQ(scored(check.answers().seal()), check.answers().seal());
}

TEST(BlindCheck, RefusesAnotherNameOrVersion) {
  const Answered check;
  const BlindAnswers answers = check.answers();
  for (const bool name : {true, false}) {
    BlindAnswers changed = answers;
    (name ? changed.name : changed.version) = "../evil";
    write_blind_answers(check.path("answers.json"), changed);
    EXPECT_THAT(check.score(),
                HasSubstr(name ? "answers the check '../evil', expected 'small'"
                               : "has another answer to case_001 than the one that was sealed"));
  }
}

TEST(BlindCheck, RefusesAChangedLabel) {
  const Answered check;
  BlindLabels labels = read_blind_labels(check.path("labels.json"));
  labels.cases[0].effects = {"gap_growth"};
  write_blind_labels(check.path("labels.json"), labels);
  EXPECT_THAT(check.score(), HasSubstr("has another label of case_001 than the one that was sealed"));
}

}  // namespace
}  // namespace gapscope
