// What the documents show of the terminal is what the program says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "cli/executable.h"
#include "support/data.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::text_of;
using testing::Workplace;

const fs::path kRoot = GAPSCOPE_SOURCE_DIR;

struct Block {
  std::string language, text;
};

std::vector<Block> blocks_of(const std::string& document) {
  std::vector<Block> blocks;
  std::istringstream lines(document);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) blocks.push_back({line.substr(3), ""});
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

std::string find_block(const std::string& document, const std::string& language,
                       const std::string& beginning) {
  for (const Block& block : blocks_of(document))
    if (block.language == language && block.text.starts_with(beginning)) return block.text;
  ADD_FAILURE() << "no block begins with " << beginning;
  return "";
}

/// Whether a line of a document, which "..." may cut short, is this one of the program.
bool shows(const std::string& line, const std::string& of_program) {
  constexpr std::string_view kCut = " ...";
  return line.ends_with(kCut) ? of_program.starts_with(line.substr(0, line.size() - kCut.size()))
                              : line == of_program;
}

/// Each line of the block comes in what the program said, in this order.
void expect_shown(const std::string& block, const std::string& said) {
  std::istringstream expected(block), lines(said);
  std::string line, of_program;
  while (std::getline(expected, line)) {
    do
      if (!std::getline(lines, of_program)) {
        ADD_FAILURE() << "not said, or not there: " << line << "\nthe program said:\n" << said;
        return;
      }
    while (!shows(line, of_program));
  }
}

TEST(Documents, TheReadmeShowsWhatTheFirstExampleSays) {
  Workplace place;
  place.file("configs/02_experiment.yaml", text_of(kRoot / "configs/02_experiment.yaml"));
  const auto run = place.run("run configs/02_experiment.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  expect_shown(find_block(text_of(kRoot / "README.md"), "", "report      reports/02_experiment"), run.out);
}

TEST(Documents, ThePictureOfTheReadmeIsOfWhatIsRead) {
  GAPSCOPE_NEEDS_DATA();
  Workplace place;
  fs::create_symlink(testing::data_folder() / "cycloidal/baseline_pos1.csv", place.folder() / "ramps.csv");
  ASSERT_EQ(place.run("init ramps.csv --input-unit 'N m' --model locked").status, 0);
  const auto detect = place.run("detect ramps.yaml");
  const std::string readme = std::regex_replace(text_of(kRoot / "README.md"), std::regex("\n"), " ");
  EXPECT_THAT(detect.out,
              HasSubstr("lost motion at zero torque is 33.7 mrad after input ramps to ±3.95 and 37.5 mrad"));
  EXPECT_THAT(detect.out, HasSubstr("gap is at most 35.1 mrad"));
  EXPECT_THAT(readme, HasSubstr("33.7 mrad of play after small ramps, 37.5 mrad after large ones"));
  EXPECT_THAT(readme, HasSubstr("the gap is at most 35 mrad"));
}

TEST(Documents, TheTutorialShowsWhatCheckAndDetectSay) {
  GAPSCOPE_NEEDS_DATA();
  const std::string tutorial = text_of(kRoot / "docs/tutorial.md");
  Workplace place;
  place.file("emps.yaml", find_block(tutorial, "yaml", "name: emps\n"));
  for (const char* file : {"emps_train.csv", "emps_pulses.csv"})
    fs::create_symlink(testing::data_folder() / "emps" / file, place.folder() / file);
  const auto check = place.run("check --translation emps_train.csv");
  expect_shown(find_block(tutorial, "", "fine        time"), check.out);
  const auto detect = place.run("detect emps.yaml -o detect");
  expect_shown(find_block(tutorial, "", "report      detect"), detect.out);
}

TEST(Documents, ThePlayersOfTheMuJoCoPageFindWhatTheyLookUp) {
  const std::string page = text_of(kRoot / "docs/my_mujoco_model_is_wrong.md");
  const std::string arm = find_block(page, "xml", "<mujoco>\n  <worldbody>");
  const std::string python = find_block(page, "python", "import csv"), c = find_block(page, "c", "#include");
  EXPECT_THAT(python, HasSubstr("m.actuator(\"elbow_motor\")"));
  EXPECT_THAT(c, HasSubstr("mj_name2id(m, mjOBJ_ACTUATOR, \"elbow_motor\")"));
  EXPECT_THAT(arm, HasSubstr("<motor name=\"elbow_motor\" joint=\"elbow\"/>"));
  EXPECT_THAT(c, HasSubstr("if (joint < 0 || drive < 0) return "));
}

/// Runs the commands of all sh blocks in turn. @returns what they said, the output of each after the other
std::string said_by_page(const std::string& page, Workplace& place) {
  std::string said;
  for (const Block& block : blocks_of(page)) {
    if (block.language != "sh") continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) {
      constexpr std::string_view kCommand = "gapscope ";
      if (!line.starts_with(kCommand)) continue;
      line = std::regex_replace(line.substr(kCommand.size(), line.find("   #") - kCommand.size()),
                                std::regex("\\$CONFIGS"), (kRoot / "configs").string());
      const auto outcome = place.run(line);
      EXPECT_EQ(outcome.status, 0) << line << ": " << outcome.err;
      said += outcome.out;
    }
  }
  return said;
}

TEST(Documents, ThePageOfTheSlideRunsAndShowsWhatIsSaid) {
  Workplace place;
  const std::string page = text_of(kRoot / "docs/a_slide_with_a_screw.md");
  const std::string said = said_by_page(page, place);
  expect_shown(find_block(page, "", "model       one body"), said);
  expect_shown(find_block(page, "", "verdict     effect"), said);
}

TEST(Documents, ThePageOfTheServoRunsAndShowsWhatIsSaid) {
  Workplace place;
  const std::string page = text_of(kRoot / "docs/a_servo_without_torque.md");
  const std::string said = said_by_page(page, place);
  expect_shown(find_block(page, "", "model       one body"), said);
  expect_shown(find_block(page, "", "verdict     effect"), said);
}

}  // namespace
}  // namespace gapscope
