#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using nlohmann::json;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::Workplace;

std::vector<json> json_lines(const std::string& text) {
  std::vector<json> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
  return all;
}

/// Seven seconds of the paper's rig as r.csv, made by the plant that shares no code with the detector.
class Stream : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new Workplace;
    place_->file(
        "sim.yaml",
        "name: sim\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 7, noise: 1.0e-5, plant: "
        "independent, excitation: {sine: {amplitude: 0.58, frequency: 1}}}\nmodel: " +
            testing::kPaperModel);
    const auto made = place_->run("simulate sim.yaml -o r.csv");
    ASSERT_EQ(made.status, 0) << made.err;
  }
  static void TearDownTestSuite() { delete place_; }

  static std::string text(const char* file) { return testing::text_of(place_->folder() / file); }
  static void shell(const std::string& command) {
    std::system(("cd " + place_->folder().string() + "; " + command).c_str());
  }
  /// What a stream of this leaves.
  static testing::Outcome stream(const std::string& producer, const std::string& options = "") {
    shell(producer + " | (" GAPSCOPE_EXECUTABLE " detect --stream " + options +
          " >told.jsonl 2>err; echo $? >status)");
    return {std::stoi(text("status")), text("told.jsonl"), text("err")};
  }

  static Workplace* place_;
};

Workplace* Stream::place_ = nullptr;

TEST_F(Stream, TellsThePassagesAndASummaryThatDetectAgreesWith) {
  place_->file("r.yaml",
               "name: r\nrecording: {file: r.csv}\nencoder: {bits: 18}\nmodel: " + testing::kPaperModel);
  ASSERT_EQ(place_->run("detect r.yaml -o batch").status, 0);
  const json batch = json::parse(text("batch/result.json"))["model_free"];
  const auto told = stream("cat r.csv", "--quantum 2.3968449810713143e-05");
  EXPECT_EQ(told.status, 0) << told.err;
  const std::vector<json> all = json_lines(told.out);
  ASSERT_GE(all.size(), 14u);
  EXPECT_NEAR(static_cast<double>(all.size()), static_cast<double>(batch["events"].size()) + 3.0, 1.0);
  EXPECT_EQ(all[0]["kind"], "settings");
  EXPECT_EQ(all[0]["configuration"]["resolved"],
            "recording:\n  columns:\n    time: \"t\"\n    input: \"u\"\n    position: \"x1\"\n"
            "    # load_position: \"x2\" where there is one\n"
            "encoder: {quantum: 2.3968449810713143e-05}  # rad\ncoordinates: rotation\n");
  EXPECT_EQ(all[1]["kind"], "learnt");
  EXPECT_EQ(all[1]["bounds_rad_s2"].size(), all[1]["floors_rad"].size());
  for (std::size_t i = 2; i + 1 < all.size(); ++i) {
    json of_batch = batch["events"][0];
    for (const char* of_a_whole : {"file", "t_c_s"}) of_batch.erase(of_a_whole);
    EXPECT_EQ(all[i]["kind"], "event");
    for (const auto& [key, value] : of_batch.items()) EXPECT_TRUE(all[i].contains(key)) << key;
  }
  const json& summary = all.back();
  EXPECT_EQ(summary["kind"], "summary");
  EXPECT_EQ(summary["samples"], 7000);
  EXPECT_EQ(summary["passages"], all.size() - 3);
  EXPECT_EQ(summary["verdict"], "backlash");
  EXPECT_NEAR(summary["gap_rad"].get<double>(), 0.019, 4e-4);
  EXPECT_NEAR(summary["gap_rad"].get<double>(), batch["gap_rad"].get<double>(),
              batch["std_rad"].get<double>());
}

TEST_F(Stream, ABrokenLineIsRefusedAfterTheSummaryOfWhatStoodBeforeIt) {
  const auto told = stream("(head -4001 r.csv; echo 4.0,what,0.1,0,gap)");
  EXPECT_EQ(told.status, 2);
  EXPECT_THAT(told.err, HasSubstr("standard input:4002: "));
  EXPECT_THAT(told.err, HasSubstr(", expected "));
  const std::vector<json> all = json_lines(told.out);
  ASSERT_GE(all.size(), 6u);
  EXPECT_EQ(all.back()["kind"], "summary");
  EXPECT_EQ(all.back()["samples"], 4000);
  const auto empty = stream("true");
  EXPECT_EQ(empty.status, 2);
  EXPECT_EQ(empty.out, "");
  EXPECT_THAT(empty.err, StartsWith("standard input: is empty, expected a header"));
}

TEST_F(Stream, ANumberThatNoDriveHasIsRefusedAfterTheSummary) {
  for (const char* edit : {"NR==4{$3=\"1e200\"}", "NR==1200{$3=\"1.7e308\"}", "NR>1{$3=$3*1e200}"}) {
    const auto told = stream(std::string("awk -F, -v OFS=, '") + edit + " {print}' r.csv");
    EXPECT_EQ(told.status, 2) << edit << told.err;
    EXPECT_THAT(told.err, HasSubstr("expected at most 1e+15 in size")) << edit;
  }
  EXPECT_EQ(
      json_lines(stream("awk -F, -v OFS=, 'NR==4000{$3=\"1.#QNAN\"} {print}' r.csv").out).back()["samples"],
      3998);
  EXPECT_EQ(stream("awk -F, -v OFS=, 'NR>1{$1=$1*1e-300} {print}' r.csv").status, 2);
}

TEST_F(Stream, EventsAreThereAtOnceAndCtrlCEndsWithTheSummary) {
  shell(
      "rm -f told.jsonl pipe; mkfifo pipe; (cat r.csv; exec sleep 60) >pipe & producer=$!; " GAPSCOPE_EXECUTABLE
      " detect --stream <pipe >told.jsonl 2>err & detector=$!; "
      "for i in $(seq 300); do grep -q event told.jsonl 2>/dev/null && break; sleep 0.1; done; cp told.jsonl before; "
      "kill -INT $detector; wait $detector; echo $? >status; kill $producer");
  EXPECT_THAT(text("before"), HasSubstr("\"kind\":\"event\""));
  EXPECT_EQ(json_lines(text("told.jsonl")).back()["kind"], "summary");
  EXPECT_THAT(text("err"), EndsWith("gapscope: interrupted\n"));
  EXPECT_EQ(text("status"), "130\n");
}

TEST_F(Stream, AReaderThatLeavesIsNoFault) {
  shell("(" GAPSCOPE_EXECUTABLE " detect --stream <r.csv 2>err; echo $? >status) | head -1 >first");
  EXPECT_EQ(text("status"), "0\n");
  EXPECT_EQ(text("err"), "");
  EXPECT_EQ(json_lines(text("first")).at(0)["kind"], "settings");
}

TEST_F(Stream, ASlowReaderOfAPipeThatDoesNotBlockGetsAllOfIt) {
  constexpr int kOutput = 9;  // one digit, for the shell
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
  ASSERT_GT(::fcntl(ends[1], F_SETPIPE_SZ, 4096), 0);  // [byte]: less than what is told
  ASSERT_EQ(::dup2(ends[1], kOutput), kOutput);
  shell("rm -f status; (" GAPSCOPE_EXECUTABLE " detect --stream <r.csv >&9 2>err; echo $? >status) &");
  ::close(ends[1]), ::close(kOutput);
  std::string told;
  std::array<char, 256> piece;
  for (ssize_t n = -1; n != 0; n = ::read(ends[0], piece.data(), piece.size())) {
    if (n > 0) told.append(piece.data(), static_cast<std::size_t>(n));
    ::usleep(n > 0 ? 1000 : 100000);  // [µs]: the pipe is full when it is read first
  }
  ::close(ends[0]);
  EXPECT_EQ(text("status"), "0\n") << text("err");
  EXPECT_GT(told.size(), 4096u);
  EXPECT_EQ(json_lines(told).back()["kind"], "summary");
}

}  // namespace
}  // namespace gapscope
