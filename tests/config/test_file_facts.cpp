// `recording: file: [{file, window, mass, arm, gain, voltage, off}]` – what is known of each recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "config/configuration.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::refusal;

constexpr const char* kServo =
    "  columns: {target: goal}\ncontroller: {position: {gain: 0.165}}\n"
    "model: {parameters: {torque_constant: {estimate: true}, motor_damping: 0.1, mass_ratio: 0}}\n";

Configuration known(const std::string& files, const std::string& more = "") {
  return parse_configuration("recording:\n  file: " + files + "\n" + kServo + more, "c.yaml");
}

TEST(FileFacts, AreThoseOfEachRecording) {
  const Configuration c = known(
      "[{file: a.csv, mass: 0.5, arm: 0.1, gain: 8, window: [0, 2], voltage: 12, off: [1, 2]}, "
      "{file: b.csv, mass: 1.0, arm: 0.15}]");
  const RecordingConfig& r = *c.recording;
  ASSERT_TRUE(c.anchor);
  EXPECT_EQ(c.anchor->mass, 0.5);
  EXPECT_EQ(c.anchor->arm, 0.1);
  EXPECT_TRUE(r.files[0].load.is_none());
  EXPECT_NEAR(r.files[1].load.inertia, 1.0 * 0.15 * 0.15 - 0.5 * 0.1 * 0.1, 1e-15);
  EXPECT_NEAR(r.files[1].load.gravity, 9.80665 * (1.0 * 0.15 - 0.5 * 0.1), 1e-12);
  const ReadOptions first = r.reading_of(r.files[0], UnevenRows::kStamped);
  EXPECT_EQ(first.gain_times, 8.0);
  EXPECT_EQ(first.window, std::pair(0.0, 2.0));
  EXPECT_EQ(first.voltage, 12.0);
  EXPECT_EQ(first.off, std::pair(1.0, 2.0));
  EXPECT_FALSE(r.reading_of(r.files[1], UnevenRows::kStamped).window);
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved_yaml(c), "c.yaml")), resolved_yaml(c));
}

TEST(FileFacts, LeaveToTheAnchorWhatTheyDoNotSay) {
  const Configuration c = known("[a.csv, {file: b.csv, mass: 1.0}]", "anchor: {mass: 0.5, arm: 0.1}\n");
  EXPECT_TRUE(c.recording->files[0].load.is_none());
  EXPECT_NEAR(c.recording->files[1].load.inertia, 0.5 * 0.01, 1e-15);
}

TEST(FileFacts, AllowOneFileInSeveralWindows) {
  EXPECT_EQ(known("[{file: a.csv, window: [0, 2]}, {file: a.csv, window: [3, 5]}]").recording->files.size(),
            2u);
  EXPECT_THAT(refusal([] { known("[{file: a.csv, window: [0, 2]}, {file: a.csv, window: [0, 2]}]"); }),
              HasSubstr("c.yaml:2: recording.file[1] names a.csv a second time"));
}

TEST(FileFacts, AreRefusedByHalves) {
  EXPECT_THAT(refusal([] { known("{file: a.csv, mass: 0.5}"); }),
              HasSubstr("c.yaml:2: a.csv has a mass without an arm, expected both"));
  EXPECT_THAT(refusal([] { known("[{file: a.csv, mass: 0.5, arm: 0.1}, b.csv, {file: c.csv, length: 1}]"); }),
              HasSubstr("length"));
  EXPECT_THAT(refusal([] { known("{file: a.csv, mass: -1, arm: 0.1}"); }), HasSubstr("mass"));
}

TEST(FileFacts, AreReadOffColumnsThatHoldOneNumber) {
  const std::string folder = ::testing::TempDir();
  const auto write = [&](const std::string& name, const std::string& last) {
    std::ofstream out(folder + "/" + name);
    out << "t,goal,x1,kg,m,kp\n";
    for (int i = 0; i < 60; ++i) out << 0.01 * i << ",0,0,0.535," << (i < 59 ? "0.1" : last) << ",16\n";
  };
  write("facts.csv", "0.1"), write("changing.csv", "0.2");
  const auto read = [&](const std::string& name) {
    return parse_configuration("recording:\n  file: " + name +
                                   "\n  columns: {target: goal, mass: kg, arm: m, gain: kp}\n"
                                   "controller: {position: {gain: 1}}\n",
                               folder + "/c.yaml");
  };
  const RecordedFile file = read("facts.csv").recording->files.front();
  EXPECT_EQ(file.mass, 0.535);
  EXPECT_EQ(file.arm, 0.1);
  EXPECT_EQ(file.gain_times, 16.0);
  EXPECT_THAT(refusal([&] { read("changing.csv"); }), HasSubstr("goes from 0.1 to 0.2, expected one number"));
}

}  // namespace
}  // namespace gapscope
