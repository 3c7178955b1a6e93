// What long work says on a terminal, and only there.
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
std::string told_on_terminal(const Workplace& place, const std::string& arguments) {
  const std::string command = "cd " + place.folder().string() + " && " + GAPSCOPE_EXECUTABLE + " " +
                              arguments + " >out.txt </dev/null";
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  std::string told;
  char part[4096];
  for (ssize_t n; (n = read(terminal, part, sizeof part)) > 0;)
    told.append(part, static_cast<std::size_t>(n));
  close(terminal);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0) << told;
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
