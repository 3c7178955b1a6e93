// What Ctrl-C keeps and what it leaves, wherever a command is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "cli/executable.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::text_of;
using testing::Workplace;

// when.sh WHEN HOW OFTEN COMMAND...: Ctrl-C as soon as a file of that name is there, or after so many
// seconds; and again after a while. Says how long it took from the last one on [ms].
constexpr const char* kWhen = R"(when=$1 often=$2
shift 2
"$@" 2>err.txt >out.txt & pid=$!
case $when in
  [0-9]*) sleep $when ;;
  *) while kill -0 $pid 2>/dev/null && ! ls r/.gapscope-partial-*/$when >/dev/null 2>&1; do sleep 0.002; done ;;
esac
for i in $(seq $often); do
  [ $i -gt 1 ] && sleep 0.2
  begin=$(date +%s%N)
  kill -INT $pid 2>/dev/null
done
wait $pid
status=$?
echo $((($(date +%s%N) - begin) / 1000000)) >took.txt
exit $status
)";

/// A search of many seconds.
constexpr const char* kNothingKnown = R"(recording: {file: 03_recording.csv}
encoder: {bits: 16}
model:
  parameters: {motor_inertia: 8.78e-4, torque_constant: 0.172, motor_damping: {estimate: true}, mass_ratio: {estimate: true},
    gap: {estimate: true}, load_damping: {estimate: true}, load_coulomb_friction: {estimate: true},
    contact_stiffness: {estimate: true}, contact_damping: {estimate: true}}
  effects: [{motor_coulomb_friction: {level_nm: {estimate: true}}}]
)";

class Interrupts : public ::testing::Test {
 protected:
  void SetUp() override {
    const fs::path configs = fs::path(GAPSCOPE_SOURCE_DIR) / "configs";
    for (const char* name : {"03_recording.csv", "03_recording.yaml"})
      place_.file(name, text_of(configs / name));
    place_.file("when.sh", kWhen);
    place_.file("sought.yaml", kNothingKnown);
  }
  Outcome interrupted(const std::string& command, const std::string& when, int often,
                      const char* configuration = "03_recording.yaml") {
    fs::remove_all(place_.folder() / "r");
    return place_.run(command + " " + configuration + " -o r --quiet",
                      "sh when.sh " + when + " " + std::to_string(often));
  }
  int milliseconds() const { return std::stoi(text_of(place_.folder() / "took.txt")); }

  Workplace place_;
};

/// The estimates are there by then.
TEST_F(Interrupts, WhileTheReportIsDrawnTheReportIsCompleted) {
  for (const char* command : {"run", "fit", "detect"}) {
    int status = 0;  // 0: on a busy machine all was drawn before the signal came
    for (int tried = 0; tried < 5 && status == 0; ++tried) status = interrupted(command, "*.png", 1).status;
    EXPECT_EQ(status, 130) << command;
    for (const char* file : {"r/result.json", "r/report.md", "r/report.html", "r/files.json"})
      EXPECT_TRUE(place_.content().contains(file)) << command << ": " << file;
    EXPECT_THAT(text_of(place_.folder() / "err.txt"), HasSubstr("reports what has been found")) << command;
  }
}

/// The first lets `run` keep its reading: then the report may be whole before the second.
TEST_F(Interrupts, ASecondOneEndsAtOnceAndLeavesAllOfItOrNothing) {
  constexpr int kAtOnce = 1000;  // milliseconds
  for (const char* command : {"diagnose", "run", "fit"})
    for (const char* when : {"0.4", "0.9"}) {
      EXPECT_EQ(interrupted(command, when, 2, "sought.yaml").status, 130) << command;
      EXPECT_LT(milliseconds(), kAtOnce) << command;
      EXPECT_EQ(fs::exists(place_.folder() / "r"), fs::exists(place_.folder() / "r/files.json")) << command;
      for (const std::string& name : place_.content())
        EXPECT_EQ(name.find(".gapscope-"), std::string::npos) << name;
    }
}

/// Also where the moment is that in which files are written.
TEST_F(Interrupts, ASecondOneWhileTheReportIsDrawnLeavesAllOfItOrNothing) {
  for (const char* command : {"diagnose", "run"}) {
    EXPECT_EQ(interrupted(command, "*.json", 2).status, 130) << command;
    for (const std::string& name : place_.content())
      EXPECT_EQ(name.find(".gapscope-"), std::string::npos) << name;
    EXPECT_EQ(fs::exists(place_.folder() / "r"), fs::exists(place_.folder() / "r/files.json")) << command;
  }
}

}  // namespace
}  // namespace gapscope
