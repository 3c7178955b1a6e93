// The manual page and the completions: both follow the help of every command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cli/executable.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::UnorderedElementsAre;
using ::testing::UnorderedElementsAreArray;
using testing::Workplace;
using Words = std::vector<std::string>;

Words lines_of(const std::string& text) {
  Words lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// What the help of a command lists: "-o" and "--output" under any heading, "merge" under those of commands.
struct Listed {
  Words options, commands;
};

Listed listed_in_help(const Workplace& place, const std::string& command) {
  Listed listed;
  std::string heading;
  static const std::regex option("^  (-[^ ]*)"), below("^  ([a-z]+) ");
  static const std::set<std::string> of_commands = {
      "Subcommands:", "Your drive:", "Many runs:", "Is it to be believed:", "To look up:"};
  std::smatch m;
  for (const std::string& line : lines_of(place.run(command + " --help").out)) {
    if (line[0] != ' ') heading = line;
    if (std::regex_search(line, m, option)) {
      std::istringstream names(m[1]);
      for (std::string name; std::getline(names, name, ',');) listed.options.push_back(name);
    }
    if (of_commands.contains(heading) && std::regex_search(line, m, below)) listed.commands.push_back(m[1]);
  }
  return listed;
}

/// Of "", "check", ..., "campaign", "campaign merge", ...
void collect(const Workplace& place, const std::string& command, std::map<std::string, Listed>& all) {
  const Listed listed = all[command] = listed_in_help(place, command);
  for (const std::string& name : listed.commands)
    collect(place, command.empty() ? name : command + " " + name, all);
}

/// A place with files, in which bash completes.
class Completion {
 public:
  Completion() {
    place_.file("complete.sh", place_.run("completion bash").out +
                                   "COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1))\n"
                                   "_gapscope && printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    place_.file("drive.yaml", "");
    place_.file("drive.csv", "");
    place_.file("reports/drive/result.json", "");
  }
  /// What is offered for the last word of the line.
  Words of(const std::string& line) const {
    const auto outcome = place_.run(line, "bash complete.sh");
    EXPECT_EQ(outcome.err, "") << line;
    return lines_of(outcome.out);
  }
  const Workplace& place() const { return place_; }

 private:
  Workplace place_;
};

TEST(Shell, TheManualAndTheCompletionHaveEveryCommandAndOptionOfTheHelp) {
  const Completion completion;
  std::map<std::string, Listed> commands;
  collect(completion.place(), "", commands);
  ASSERT_GT(commands.size(), 15u);
  const std::string page = std::regex_replace(completion.place().run("man").out, std::regex(R"(\\-)"), "-");
  for (const auto& [command, listed] : commands) {
    EXPECT_THAT(completion.of(command + " -"), UnorderedElementsAreArray(listed.options)) << command;
    EXPECT_THAT(completion.of(command + " ''"), IsSupersetOf(listed.commands)) << command;
    const std::string heading = command.empty() ? ".SH OPTIONS\n" : ".SS gapscope " + command + "\n";
    const std::size_t begin = page.find(heading);
    ASSERT_NE(begin, page.npos) << heading;
    const std::string section = page.substr(begin, page.find("\n.S", begin) - begin);
    for (const std::string& option : listed.options)
      EXPECT_NE(section.find("\\fB" + option + "\\fR"), section.npos) << command << " " << option;
  }
}

TEST(Shell, TheManualIsWellFormed) {
  const Workplace place;
  if (place.run("man >page && groff --version").status != 0) GTEST_SKIP() << "no groff here";
  const auto page = place.run("man >page && groff -k -Tutf8 -man -ww -P-c page");
  EXPECT_EQ(page.err, "");
  EXPECT_THAT(page.out,
              ::testing::HasSubstr("Example: gapscope fit configs/02_experiment.yaml -o reports/fitted"));
}

TEST(Shell, AValueIsCompletedByWhatItIs) {
  const Completion completion;
  EXPECT_THAT(completion.of("ca"), UnorderedElementsAre("campaign"));
  EXPECT_THAT(completion.of("run ''"), UnorderedElementsAre("drive.yaml", "reports"));
  EXPECT_THAT(completion.of("run drive.yaml -o ''"), UnorderedElementsAre("reports"));
  EXPECT_THAT(completion.of("report reports/d"), UnorderedElementsAre("reports/drive"));
  EXPECT_THAT(completion.of("check drive.c"), UnorderedElementsAre("drive.csv"));
  EXPECT_THAT(completion.of("blind make --labels drive.c"), UnorderedElementsAre("drive.csv"));
  EXPECT_THAT(completion.of("campaign ''"), UnorderedElementsAre("drive.yaml", "reports", "export", "merge"));
  EXPECT_THAT(completion.of("campaign drive.yaml -j ''"), IsEmpty());
  EXPECT_THAT(completion.of("diagnose drive.yaml --exclude load_"),
              UnorderedElementsAre("load_dependent_friction", "load_inertia_variation", "load_resonance",
                                   "load_unbalance"));
  EXPECT_THAT(completion.of("blind drives --kind ''"), UnorderedElementsAre("gap", "gap_free"));
  EXPECT_THAT(completion.of("completion ''"), UnorderedElementsAre("bash", "zsh"));
}

TEST(Shell, EffectsAreBareNamesInAPipeAndExplainedOnRequest) {
  const Workplace place;
  EXPECT_THAT(place.run("effects").out, ::testing::StartsWith("actuator_lag\nbacklash\n"));
  EXPECT_THAT(place.run("effects --laws").out,
              HasSubstr("\ncogging_torque          motor    motor torque -A (sin"));
  EXPECT_EQ(place.run("effects --laws --json").status, 2);
  EXPECT_THAT(place.run("effects motor_coulomb_friction").out,
              HasSubstr("known       effects: [{motor_coulomb_friction: {level_nm: NUMBER}}]"));
  const auto guessed = place.run("effects coulomb");
  EXPECT_EQ(guessed.status, 2);
  EXPECT_THAT(guessed.err, HasSubstr("the nearest is motor_coulomb_friction"));
}

}  // namespace
}  // namespace gapscope
