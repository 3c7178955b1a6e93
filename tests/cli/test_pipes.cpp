// What is no regular file is not waited for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "cli/executable.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::Outcome;
using testing::Workplace;

/// Whatever names it, and whoever would write to it or not.
TEST(Pipes, AreRefusedAtOnceWhateverNamesThem) {
  Workplace place;
  const auto at = [&](const char* name) { return (place.folder() / name).string(); };
  place.file("drive.csv",
             testing::text_of(std::filesystem::path(GAPSCOPE_SOURCE_DIR) / "configs/03_recording.csv"));

  for (const char* name :
       {"pipe.csv", "pipe.mat", "pipe.npz", "pipe.h5", "pipe.db3", "pipe.mcap", "pipe.json", "pipe.xml"})
    ASSERT_EQ(mkfifo(at(name).c_str(), 0600), 0);
  const std::string model =
      "model: {parameters: {motor_inertia: 8.78e-4, torque_constant: 0.172, motor_damping: 0.01, mass_ratio: 0}}\n";
  const auto refused = [&](const std::string& command, const std::string& file,
                           const char* word = "is no regular file") {
    const Outcome o = place.run(command, "timeout -s KILL 20");
    EXPECT_EQ(o.status, 2) << command;
    EXPECT_THAT(o.err, HasSubstr(file)) << command;
    EXPECT_THAT(o.err, HasSubstr(word)) << command;
  };
  for (const std::string file :
       {"pipe.csv", "pipe.mat", "pipe.npz", "pipe.h5", "pipe.db3", "pipe.mcap", "pipe.json", "/dev/zero"}) {
    place.file("named.yaml", "recording: {file: " + file + "}\n" + model);
    for (const char* command : {"detect", "fit", "diagnose"})
      refused(std::string(command) + " named.yaml -o n", file);
    refused("check " + file, file);
    refused("init " + file, file);
  }
  place.file("sound.yaml", "recording: {file: drive.csv}\n" + model);
  place.file("held_out.yaml", "recording: {file: drive.csv, held_out: pipe.csv}\n" + model);
  refused("diagnose held_out.yaml -o n", "pipe.csv");
  refused("diagnose sound.yaml --simulated pipe.csv -o n", "pipe.csv");
  place.file("goes_on.yaml",
             "simulation: {rate: 1000, duration: 2, excitation: {recorded: {file: pipe.csv}}}\n" + model);
  refused("simulate goes_on.yaml -o n.csv", "pipe.csv");
  refused("init drive.csv --from pipe.xml --joint hip", "pipe.xml");
  place.file("scene.xml", "<mujoco><include file=\"pipe.xml\"/></mujoco>");
  refused("init drive.csv --from scene.xml --joint hip", "pipe.xml", "which is no file");
  EXPECT_FALSE(std::filesystem::exists(at("n")));
}

TEST(Pipes, ThatNobodyReadsAreGivenUpAtTheFirstSignal) {
  Workplace place;
  place.file("drive.csv",
             testing::text_of(std::filesystem::path(GAPSCOPE_SOURCE_DIR) / "configs/03_recording.csv"));
  ASSERT_EQ(mkfifo((place.folder() / "out").string().c_str(), 0600), 0);
  const Outcome o = place.run("check drive.csv -o out", "timeout --preserve-status -s TERM -k 20 1");
  EXPECT_EQ(o.status, 130) << o.err;
}

}  // namespace
}  // namespace gapscope
