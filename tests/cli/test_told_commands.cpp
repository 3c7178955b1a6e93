// Commands that terminal, report and help tell: they can be pasted, and what they promise is there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::text_of;
using testing::Workplace;

// The paper's rig for two seconds, and a friction that its model lacks.
const std::string kRigWithFriction =
    "name: drive\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 2, seed: 3, "
    "excitation: {sine: {amplitude: 0.58, frequency: 1}}, "
    "model: {effects: [{motor_coulomb_friction: {level_nm: 0.02}}]}}\n"
    "model: " +
    testing::kPaperModel;

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(ToldCommands, TheReportSaysWhichFileIsTheConfigurationOfItsCommands) {
  Workplace place;
  place.file("c.yaml", kRigWithFriction);
  ASSERT_EQ(place.run("run c.yaml").status, 0);
  const std::string told = "CONFIG is the YAML that this report was made from";
  const std::string report = text_of(place.folder() / "reports/drive/report.md");
  EXPECT_THAT(report,
              AllOf(HasSubstr("gapscope diagnose CONFIG`"), HasSubstr(told), HasSubstr("`resolved.yaml`")));
  EXPECT_THAT(text_of(place.folder() / "reports/drive/report.html"), HasSubstr(told));
}

TEST(ToldCommands, ARunSendsToTheDiagnosisInItsCardAlone) {
  Workplace place;
  place.file("c.yaml", kRigWithFriction);
  const auto run = place.run("run c.yaml");
  ASSERT_EQ(run.status, 0);
  EXPECT_THAT(run.err, Not(HasSubstr("gapscope diagnose")));
  EXPECT_EQ(times(run.out, "gapscope diagnose"), 1) << run.out;
  EXPECT_EQ(times(run.out, "`gapscope diagnose c.yaml`"), 1) << run.out;
}

/// A recording without a model is sent to the command that writes one: `diagnose` of it would be refused.
TEST(ToldCommands, ARunWithoutAModelSendsToInit) {
  Workplace place;
  place.file("c.yaml", kRigWithFriction);
  ASSERT_EQ(place.run("simulate c.yaml -o r.csv").status, 0);
  place.file("d.yaml", "name: bare\nrecording: {file: r.csv}\n");
  const auto detect = place.run("detect d.yaml");
  ASSERT_EQ(detect.status, 0) << detect.err;
  EXPECT_THAT(detect.out, AllOf(HasSubstr("`gapscope init "), HasSubstr("r.csv` writes a first one")));
  EXPECT_THAT(detect.out, Not(HasSubstr("gapscope diagnose d.yaml")));
}

// A step that is pasted does what was done: with the settings and into the folder that were given.
TEST(ToldCommands, ATerminalRepeatsTheOptionsThatWereGiven) {
  Workplace place;
  place.file("c.yaml", kRigWithFriction);
  const auto run = place.run("run c.yaml --set simulation.seed=4 --set 'encoder={bits: 17}' -o 'my rig'");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(
      run.out,
      HasSubstr(
          "`gapscope diagnose c.yaml --set 'simulation.seed=4' --set 'encoder={bits: 17}' -o 'my rig'`"));
}

TEST(ToldCommands, NoStandardErrorIsToldOfADifferenceThatHasNone) {
  Workplace place;
  place.file("c.yaml",
             "name: rig\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 6, noise: 1.0e-5, seed: 5, "
             "excitation: {sine: {amplitude: 0.58, frequency: 1}}}\nmodel: " +
                 testing::kPaperModel);
  const auto run = place.run(
      "run c.yaml --set fit.max_iterations=1 --set fit.starts=1 --set "
      "'simulation.model.effects=[{motor_coulomb_friction: {level_nm: 0.02}}]'");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr(" not comparable: an interval is missing\n"));
}

TEST(ToldCommands, AShellTakesANameWithBlanksAsItIsTold) {
  Workplace place;
  place.file("c.yaml", kRigWithFriction);
  ASSERT_EQ(place.run("simulate c.yaml -o \"my drive's 7.csv\"").status, 0);
  const std::string quoted = "'my drive'\\''s 7.yaml'";
  const auto init = place.run("init \"my drive's 7.csv\"");
  ASSERT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("gapscope run " + quoted + " (or "));
  const auto run = place.run("detect " + quoted);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("`gapscope diagnose " + quoted + "`"));
}

/// Whatever a card tells in terms of CONFIG and DIR is told on the terminal with the names that are meant.
TEST(ToldCommands, FolderAndConfigurationStandInCommandsByTheirNames) {
  Workplace place;
  place.file("my drive.yaml", kRigWithFriction);
  const auto diagnose = place.run("diagnose 'my drive.yaml' -o 'my report'" +
                                  testing::excluding_all_but({"motor_coulomb_friction", "quadratic_drag"}));
  ASSERT_EQ(diagnose.status, 0) << diagnose.err;
  EXPECT_THAT(diagnose.out, AllOf(HasSubstr("`'my report/fitted.yaml'`"), HasSubstr("my report/report.html"),
                                  Not(HasSubstr("DIR"))));
  const auto run = place.run("run 'my drive.yaml' -o other");
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("`gapscope diagnose 'my drive.yaml' -o other`"), Not(HasSubstr("CONFIG"))));
}

TEST(ToldCommands, TheHelpPromisesANextExperimentOnlyWhereThereIsOne) {
  const std::string help = Workplace().run("diagnose --help").out;
  EXPECT_THAT(help, Not(HasSubstr("hold the input that would")));
  EXPECT_THAT(help, HasSubstr("Where two explanations come close"));
}

}  // namespace
}  // namespace gapscope
