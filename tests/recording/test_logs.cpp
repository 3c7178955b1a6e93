// Logs of robots: tests/recording/files/make_logs.mjs and make_bag.py made the files.
#include "recording/array_fixture.h"

namespace gapscope {
namespace {

using testing::columns_named;
using ::testing::HasSubstr;
using testing::put;
using testing::TemporaryFile;
using testing::written_file;

Recording read_log(const std::string& file, const std::string& time, const std::string& position,
                   const std::string& input = "elbow.effort") {
  return read_recording(written_file(file), columns_named(time, input, position));
}

class JointStates : public ::testing::TestWithParam<const char*> {};

TEST_P(JointStates, AreColumnsByTheNameOfTheJoint) {
  const Recording elbow = read_log(GetParam(), "t", "elbow.position");
  ASSERT_EQ(elbow.size(), 60u) << "the messages of the lamp are no samples";
  EXPECT_DOUBLE_EQ(elbow.dt, 0.01);
  EXPECT_EQ(elbow.start, 0.0);
  EXPECT_EQ(elbow.x1[3], 0.03);
  EXPECT_EQ(elbow.u[7], 3.5);
  EXPECT_EQ(read_log(GetParam(), "log_time", "wrist.position").x1[59], -118.0);
  EXPECT_EQ(read_log(GetParam(), "stamp", "/joint_states/wrist.position").x1[59], -118.0);
}

TEST_P(JointStates, ThatAreNotThereAreRefusedWithThoseThatAre) {
  const auto tried = [](const std::string& position, const std::string& input) {
    return testing::refusal([&] { read_log(GetParam(), "t", position, input); });
  };
  EXPECT_THAT(tried("knee.position", "elbow.effort"), HasSubstr("has no 'knee.position' among '"));
  EXPECT_THAT(tried("knee.position", "elbow.effort"), HasSubstr("'/joint_states/elbow.position'"));
  EXPECT_THAT(
      tried("elbow.position", "knee.effort"),
      HasSubstr("there is no column 'knee.effort', expected it beside those that are there: 't', 'stamp'"));
  if (std::string(GetParam()) == "plain.mcap") return;  // has no lamp
  EXPECT_THAT(tried("elbow.position", "lamp.effort"),
              HasSubstr("message 1 of /joint_states has no 'lamp.effort', expected it in every one that has "
                        "'elbow.position'"));
}

INSTANTIATE_TEST_SUITE_P(Of, JointStates,
                         ::testing::Values("joints.mcap", "joints_lz4.mcap", "joints_zstd.mcap", "plain.mcap",
                                           "joints.db3"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(Mcap, AsksForTheTopicWhereSeveralHaveTheColumn) {
  EXPECT_THAT(
      testing::refusal([] { read_log("joints.mcap", "t", "header.stamp.sec"); }),
      HasSubstr("has 'header.stamp.sec' in the topics /gripper/joint_states, /joint_states, expected the one "
                "that is meant before it: /gripper/joint_states/header.stamp.sec"));
}

/// Where the record of this opcode is, the one with this number from 0 on.
std::size_t record_of(const std::string& bytes, char opcode, int which = 0) {
  std::size_t at = 8;
  while (bytes.at(at) != opcode || which-- > 0) {
    std::uint64_t length = 0;
    for (std::size_t i = 8; i > 0; --i) length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
    at += 9 + length;
  }
  return at;
}

constexpr char kSchemaRecord = 3, kChannelRecord = 4, kMessageRecord = 5, kChunkRecord = 6;

TEST(Mcap, RefusesAMalformedFileWithPlaceAndRemedy) {
  const std::string recover = "expected a whole MCAP (mcap recover FILE -o OUT)";
  const auto message = [](const std::string& b) { return record_of(b, kMessageRecord) + 9; };
  const auto place = [](std::size_t at) { return "damaged at byte " + std::to_string(at); };
  const std::string good = testing::text_of(written_file("joints.mcap"));
  const std::size_t first = record_of(good, kMessageRecord), channel = record_of(good, kChannelRecord);
  const std::vector<testing::Malformed> cases = {
      {"empty", [](auto& b) { b.clear(); }, {"is empty, expected a recording as"}},
      {"text", [](auto& b) { b = "t,u,x1\n0,0,0\n"; }, {"does not begin as an MCAP"}},
      {"magic alone", [](auto& b) { b.resize(8); }, {place(8), "ends there", recover}},
      {"half", [](auto& b) { b.resize(b.size() / 2); }, {"damaged at byte", "are there", recover}},
      {"in the head of a record",
       [=](auto& b) { b.resize(first + 4); },
       {place(first), "ends there", recover}},
      {"before a record", [=](auto& b) { b.resize(first); }, {place(first), "ends there", recover}},
      {"a long record",
       [=](auto& b) { put(b, first + 1, 1u << 30, 8); },
       {place(first), "1073741824 bytes", recover}},
      {"an endless record", [=](auto& b) { put(b, first + 1, ~0ull, 8); }, {place(first), recover}},
      {"a short record",
       [=](auto& b) { put(b, first + 1, 3, 8); },
       {place(first), "a field of 4 bytes", recover}},
      {"no kind", [=](auto& b) { b[first] = 0; }, {place(first), "of no kind", recover}},
      {"no channel", [=](auto& b) { put(b, first + 9, 77, 2); }, {place(first), "channel that is not there"}},
      {"no schema",
       [=](auto& b) { put(b, channel + 11, 77, 2); },
       {place(channel), "a schema 77 that is not"}},
      {"a long name",
       [=](auto& b) { put(b, channel + 13, 1u << 31, 4); },
       {place(channel), "2147483648 bytes"}},
      {"no schema at all",
       [](auto& b) { b[record_of(b, kSchemaRecord)] = 14; },
       {place(channel), "schema 1"}},
      {"no field",
       [](auto& b) { b[b.find("string[] name")] = 'X'; },
       {"has a field of type", "'elbow.position'"}},
      {"no line",
       [](auto& b) { b.replace(b.find("string[] name"), 9, "string_[]"); },
       {"expected a type and a name"}},
      {"protobuf",
       [](auto& b) { b.replace(b.find("cdr"), 3, "pro"); },
       {"encoded as 'pro'", "record them as JSON"}},
      {"not plain CDR", [&](auto& b) { b[message(b) + 23] = 7; }, {"CDR of the plain kind"}},
      {"a long list",
       [&](auto& b) { put(b, message(b) + 22 + 4 + 8 + 12, 1u << 30, 4); },
       {"no more than its bytes hold"}},
      {"a damaged later one",
       [&](auto& b) { b[record_of(b, kMessageRecord, 120) + 9 + 23] = 7; },
       {"message 6", "of /joint_states", "at its byte 0"}},
  };
  testing::expect_refused(written_file("joints.mcap"), ".mcap",
                          columns_named("t", "elbow.effort", "elbow.position"), cases);
}

/// An attachment of a camera or a whole firmware is nobody's damage, and is not read.
TEST(Mcap, PassesOverALargeAttachment) {
  std::string log = testing::text_of(written_file("joints.mcap"));
  const std::size_t at = record_of(log, kMessageRecord, 3);
  constexpr char kAttachmentRecord = 9;
  std::string head(1, kAttachmentRecord);
  head.resize(9);
  put(head, 1, (256u << 20) + 1, 8);
  const TemporaryFile file(log.substr(0, at) + head, "large.mcap");
  {
    std::fstream sparse(file.path(), std::ios::binary | std::ios::in | std::ios::out);
    sparse.seekp(static_cast<std::streamoff>(at) + 9 + (256 << 20) + 1);
    sparse << log.substr(at);
  }
  const Recording r = read_recording(file.path(), columns_named("t", "elbow.effort", "elbow.position"));
  EXPECT_EQ(r.x1, read_log("joints.mcap", "t", "elbow.position").x1);
}

/// A second channel of the topic with messages in JSON: each is read as what it is.
TEST(Mcap, ReadsEachChannelOfATopicByItsOwnType) {
  std::string log = testing::text_of(written_file("joints.mcap"));
  const std::size_t at = record_of(log, kMessageRecord, 3);
  const auto record = [](char opcode, const std::string& content) {
    std::string r(9, opcode);
    put(r, 1, content.size(), 8);
    return r + content;
  };
  const auto text = [](const std::string& t) {
    std::string length(4, '\0');
    put(length, 0, t.size(), 4);
    return length + t;
  };
  const std::string id("\x63\0", 2), no_schema("\0\0", 2), times(4 + 8 + 8, '\0');
  const std::string channel = id + no_schema + text("/joint_states") + text("json") + std::string(4, '\0');
  log.insert(at, record(kChannelRecord, channel) + record(kMessageRecord, id + times + "{\"state\": 3}"));
  const TemporaryFile file(log, "two.mcap");
  const Recording r = read_recording(file.path(), columns_named("t", "elbow.effort", "elbow.position"));
  EXPECT_EQ(r.x1, read_log("joints.mcap", "t", "elbow.position").x1);
}

TEST(Mcap, RefusesADamagedChunkWithPlaceAndRemedy) {
  const std::string good = testing::text_of(written_file("joints_zstd.mcap"));
  const std::size_t chunk = record_of(good, kChunkRecord);
  const std::string place = "damaged at byte " + std::to_string(chunk);
  const std::vector<testing::Malformed> cases = {
      {"larger", [=](auto& b) { put(b, chunk + 9 + 16, 9000, 8); }, {place, "does not unpack to 9000 bytes"}},
      {"endless",
       [=](auto& b) { put(b, chunk + 9 + 16, ~0ull, 8); },
       {place, "a chunk of 18446744073709551615 bytes"}},
      {"another checksum",
       [=](auto& b) { b[chunk + 9 + 24] ^= 1; },
       {place, "whose checksum is another one"}},
      {"unknown",
       [=](auto& b) { b[chunk + 9 + 32] = 'y'; },
       {place, "compressed by 'ystd', which this build"}},
      {"damaged", [=](auto& b) { b[chunk + 9 + 60] ^= 8; }, {place, "a chunk "}},
      {"packed beyond",
       [=](auto& b) { put(b, chunk + 9 + 36, 1u << 20, 8); },
       {place, "a field of 1048576 bytes"}},
  };
  testing::expect_refused(written_file("joints_zstd.mcap"), ".mcap",
                          columns_named("t", "elbow.effort", "elbow.position"), cases);
}

TEST(Rosbag, RefusesAMalformedFileWithPlaceAndRemedy) {
  const std::string whole = "expected a whole bag of ROS 2 (sqlite3 FILE .recover)";
  const std::vector<testing::Malformed> cases = {
      {"text", [](auto& b) { b = std::string(2000, 'x'); }, {whole}},
      {"empty", [](auto& b) { b.clear(); }, {"is empty, expected a recording as"}},
      {"half", [](auto& b) { b.resize(b.size() / 2); }, {whole}},
      {"another table",
       [](auto& b) { b.replace(b.find("tablemessages"), 13, "tablemassages"); },
       {"expected"}},
      {"another format",
       [](auto& b) {
         for (std::size_t at = 0; (at = b.find("Statecdr")) != b.npos;) b[at + 7] = 'x';
       },
       {"encoded as 'cdx'"}},
      {"another type",
       [](auto& b) {
         for (std::size_t at = 0; (at = b.find("JointStatecdr")) != b.npos;) b[at] = 'X';
       },
       {"without their definition", "ros2 bag convert"}},
      {"no pages", [](auto& b) { std::fill(b.begin() + 1024, b.end(), '\0'); }, {whole}},
  };
  testing::expect_refused(written_file("joints.db3"), ".db3",
                          columns_named("t", "elbow.effort", "elbow.position"), cases);
}

}  // namespace
}  // namespace gapscope
