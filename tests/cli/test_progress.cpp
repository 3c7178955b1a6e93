// What long work says on a terminal, and what it answers to Ctrl-C.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <regex>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using testing::kPaperModel;
using testing::Workplace;

const std::string kShortSimulation = R"(encoder: {bits: 18}
simulation:
  rate: 1000
  duration: 2
  excitation: {sine: {amplitude: 0.58, frequency: 1}}
  noise: 1.0e-5
)";

/// What the command writes to a terminal that is its standard error.
/// @param cue  at which Ctrl-C is pressed; empty: never
std::string told_on_terminal(const Workplace& place, const std::string& arguments, int expected = 0,
                             const std::string& cue = "") {
  const std::string command = "cd " + place.folder().string() + " && exec " + GAPSCOPE_EXECUTABLE + " " +
                              arguments + " >out.txt </dev/null";
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  std::string told;
  char part[4096];
  bool pressed = cue.empty();
  for (ssize_t n; (n = read(terminal, part, sizeof part)) > 0;) {
    told.append(part, static_cast<std::size_t>(n));
    if (pressed || told.find(cue) == told.npos) continue;
    pressed = write(terminal, "\x03", 1) == 1;
  }
  close(terminal);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status)) << told;
  EXPECT_EQ(WEXITSTATUS(status), expected) << told;
  return told;
}

TEST(Progress, OfADiagnosisIsTheStepOfHowManyAndTheTimeSoFar) {
  Workplace place;
  place.file("c.yaml",
             kShortSimulation +
                 "  model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}\nmodel: " + kPaperModel);
  const std::string told =
      told_on_terminal(place, "diagnose c.yaml -j 1 -o r" +
                                  testing::excluding_all_but({"motor_coulomb_friction", "quadratic_drag"}));
  EXPECT_THAT(told, ContainsRegex(" +[0-9]+:[0-9][0-9]  fitting the nominal model \\.\\.\\."));
  EXPECT_THAT(told, ContainsRegex(" fitting [a-z_]+, 1 of 2 "));
  EXPECT_THAT(told, ContainsRegex(" refining [a-z_]+, 1 of [12] "));
}

/// The search is over then, and nothing of it is lost.
TEST(Progress, CtrlCWhileTheReportIsDrawnLeavesTheReport) {
  Workplace place;
  place.file("c.yaml",
             kShortSimulation +
                 "  model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}\nmodel: " + kPaperModel);
  const std::string told = told_on_terminal(
      place, "diagnose c.yaml -j 1 -o r" + testing::excluding_all_but({"motor_coulomb_friction"}), 130,
      "drawing the report");
  EXPECT_THAT(told, HasSubstr("gapscope: ends after the present step and reports what has been found"));
  for (const char* file : {"r/diagnosis.json", "r/report.md", "r/fitted.yaml"})
    EXPECT_TRUE(place.content().contains(file)) << file;
  EXPECT_THAT(testing::text_of(place.folder() / "r/diagnosis.json"), HasSubstr("\"verdict\": \"effect\""));
}

// wait.sh: the command writes to a pipe that nobody empties.
constexpr const char* kStuck = R"(mkfifo p; exec 3<>p
"$@" 2>err.txt & pid=$!
head -c 1 <&3 >/dev/null; kill -INT $pid; wait $pid; echo $? >status.txt; cat err.txt
)";

TEST(Progress, CtrlCEndsWhatNobodyReads) {
  Workplace place;
  place.file("c.yaml", std::regex_replace(kShortSimulation, std::regex("duration: 2"), "duration: 60") +
                           "model: " + kPaperModel);
  place.file("wait.sh", kStuck);
  const auto stuck = place.run("simulate c.yaml -o p", "timeout -s KILL 60 sh wait.sh");
  EXPECT_THAT(stuck.out, ::testing::EndsWith("gapscope: interrupted\n"));
  EXPECT_EQ(testing::text_of(place.folder() / "status.txt"), "130\n");
}

/// `timeout` signals the process and its group: the same request, twice at once.
TEST(Progress, ADiagnosisThatIsToldToEndTwiceAtOnceLeavesItsReport) {
  Workplace place;
  place.file("c.yaml",
             std::regex_replace(kShortSimulation, std::regex("duration: 2"), "duration: 20") +
                 "  model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}\nmodel: " + kPaperModel);
  const auto told = place.run(
      "diagnose c.yaml -j 1 -o r" + testing::excluding_all_but({"motor_coulomb_friction", "quadratic_drag"}),
      "timeout --preserve-status 1");
  EXPECT_EQ(told.status, 130) << told.err;
  EXPECT_TRUE(place.content().count("r/diagnosis.json")) << told.err;
}

TEST(Progress, OfACampaignIsTheRunOfHowManyAndTheTimeSoFar) {
  Workplace place;
  place.file("c.yaml", "name: small\naxes: {simulation.seed: [1, 2, 3]}\nbase:\n  " +
                           std::regex_replace(kShortSimulation, std::regex("\n(?=.)"), "\n  ") +
                           "  model: " + kPaperModel);
  const std::string told = told_on_terminal(place, "campaign c.yaml -j 1 -o r");
  EXPECT_THAT(told, ContainsRegex(" 0:0[0-9]  0 of 3 runs"));
  EXPECT_THAT(told, ContainsRegex(" 0:[0-9][0-9]  3 of 3 runs, [0-9.]+ runs/s, about 0 s left"));
  EXPECT_EQ(place.run("campaign c.yaml -j 1 -o again").err, "") << "and nothing where nobody looks";
}

}  // namespace
}  // namespace gapscope
