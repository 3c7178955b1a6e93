// Recordings as JSON: of test benches of servos, of lists, an object on every line.
#include <fmt/format.h>

#include "recording/array_fixture.h"

namespace gapscope {
namespace {

using testing::columns_named;
using ::testing::HasSubstr;
using testing::TemporaryFile;

constexpr int kEntries = 60;

std::string entries(const char* between = ", ") {
  std::string all;
  for (int i = 0; i < kEntries; ++i)
    all += fmt::format(
        R"({}{{"timestamp": {}, "position": {}, "joints": [{{"q": {}}}], "pwm": {}e-1, "torque_enable": true}})",
        i == 0 ? "" : between, 0.01 * i, 0.02 * i, -i, i);
  return all;
}

std::string bench() {
  return R"({"mass": 0.49, "arm_mass": 0.05, "motor": "xl330", "vin": 7.5, "warm_up": [{"timestamp": 0}], "entries": [)" +
         entries() + "],\n \"kp\": 100}\n";
}

std::string lists() {
  std::string t, q;
  for (int i = 0; i < kEntries; ++i)
    t += fmt::format("{}{}", i == 0 ? "" : ",", 0.01 * i),
        q += fmt::format("{}[{},{}]", i == 0 ? "" : ",", i, -i);
  return fmt::format(R"({{"t": [{}], "u": [{}], "q": [{}], "note": ["a", "b"], "rate": 100}})", t, t, q);
}

Recording read_json(const std::string& text, const ReadOptions& options, const std::string& name = "r.json") {
  const TemporaryFile file(text, name);
  return read_recording(file.path(), options);
}

void expect_entries(const Recording& r) {
  ASSERT_EQ(r.size(), static_cast<std::size_t>(kEntries));
  EXPECT_DOUBLE_EQ(r.dt, 0.01);
  EXPECT_DOUBLE_EQ(r.x1[3], 0.06);
  EXPECT_DOUBLE_EQ(r.u[7], 0.7);
}

TEST(Json, ReadsTheEntriesOfATestBench) {
  ReadOptions options = columns_named("timestamp", "pwm", "position");
  expect_entries(read_json(bench(), options));
  options.columns.voltage = "vin";  // a number for all entries
  EXPECT_DOUBLE_EQ(read_json(bench(), options).u[7], 0.7 * 7.5);
  EXPECT_EQ(read_json(bench(), columns_named("timestamp", "pwm", "joints[0].q")).x1[5], -5.0);
}

TEST(Json, ReadsAListAndAnObjectOnEveryLine) {
  const ReadOptions options = columns_named("timestamp", "pwm", "position");
  expect_entries(read_json("\n[" + entries(",\n") + "]", options));
  expect_entries(read_json(entries("\n"), options, "r.jsonl"));
}

TEST(Json, ReadsListsOfNumbersAndTables) {
  EXPECT_EQ(read_json(lists(), columns_named("t", "u", "q[:, 1]")).x1[5], -5.0);
  const std::string what = testing::refusal([] { read_json(lists(), columns_named("t", "u", "q")); });
  EXPECT_THAT(what,
              HasSubstr("the column 'q' is of size 60 x 2, expected a vector of real numbers (one of its"));
}

/// A rollout is no row, however long it is: its lists are columns.
TEST(Json, ReadsLongRolloutsByTheirPaths) {
  std::string t, u, x;
  for (int i = 0; i < 4000; ++i) {
    const char* const comma = i > 0 ? "," : "";
    t += comma + std::to_string(0.01 * i), u += comma + ("[" + std::to_string(0.1 * i) + "]");
    x += comma + std::to_string(-i);
  }
  const std::string rollout = "{\"t\": [" + t + "], \"actions\": [" + u + "], \"qpos\": [" + x + "]}";
  for (const auto& [text, path] : {std::pair{"{\"data\": [" + rollout + "]}", "data[0]."},
                                   {"[" + rollout + "]", "[0]."},
                                   {"{\"run\": " + rollout + "}", "run."}}) {
    const std::string at = path;
    EXPECT_EQ(read_json(text, columns_named(at + "t", at + "actions", at + "qpos")).x1[5], -5.0) << at;
  }
}

/// One row of the table has a number too few, the next one too many: all in all as many as there should be.
TEST(Json, RefusesRowsOfOtherLengthsWhoseTotalAgrees) {
  std::string ragged = lists();
  const std::string rows = "[1,-1],[2,-2]";
  ragged.replace(ragged.find(rows), rows.size(), "\n[1],[2,-2,7]");
  const std::string what = testing::refusal([&] { read_json(ragged, columns_named("t", "u", "q[:, 1]")); });
  EXPECT_THAT(what, HasSubstr("r.json:2: is no whole JSON"));
  EXPECT_THAT(what, HasSubstr("ends a row of 1 numbers in 'q', expected 2 as in the first"));
}

TEST(Json, RefusesAMalformedFileWithPlaceAndRemedy) {
  const auto cut = [](const char* at, std::size_t more) {
    return [=](std::string& b) { b.resize(b.find(at) + more); };
  };
  const auto with = [](const char* from, const std::string& to) {
    return [=](std::string& b) { b.replace(b.find(from), std::string(from).size(), to); };
  };
  const std::string broken = "r.json:1: is no whole JSON: byte ";
  const std::vector<testing::Malformed> cases = {
      {"empty", [](auto& b) { b.clear(); }, {"is empty, expected a recording as"}},
      {"text", [](auto& b) { b = "t,u,x1\n0,0,0\n"; }, {broken + "0 is 't,u,x1"}},
      {"a number", [](auto& b) { b = "17"; }, {broken + "0 is '17' there"}},
      {"an open list", cut("],\n", 0), {"expected ,"}},
      {"an open object",
       [](auto& b) { b.resize(b.rfind('}')); },
       {"r.json:2: is no whole JSON", "nothing more there"}},
      {"an open text", cut("\"position\"", 4), {broken, "expected a quotation mark"}},
      {"an open number", cut("\"position\": ", 12), {broken, "nothing more there, expected a number"}},
      {"no comma", with("}, {", "}  {"), {broken, "there, expected ,"}},
      {"no colon", with("\"vin\":", "\"vin\" "), {broken, "there, expected :"}},
      {"no quotation marks", with("\"vin\"", "vin"), {broken, "expected \""}},
      {"no number", with("7.5", "x"), {broken, "is 'x, \"warm_up\"", "expected a number"}},
      {"a wrong escape", with("xl330", "\\q"), {broken, "a character behind the backslash"}},
      {"deep",
       with("7.5", std::string(100, '[') + std::string(100, ']')),
       {broken, "no more than 64 values"}},
      {"a long name",
       with("\"vin\"", "\"" + std::string(2000, 'v') + "\""),
       {"has a name of 2000 characters, expected at most 1000"}},
      {"more behind",
       [](auto& b) { b += "]"; },
       {"r.json:3: is no whole JSON", "expected the end of the text"}},
      {"a missing number",
       with("\"position\": 0.1,", ""),
       {"entry 6 has no 'position', expected it in every one"}},
      {"a text", with("\"position\": 0.1,", "\"position\": \"0.1\","), {"entry 6 has no 'position'"}},
      {"too large",
       with("\"position\": 0.1,", "\"position\": 1e300,"),
       {"entry 6: position is 1e+300, expected at most"}},
      {"backwards",
       with("\"timestamp\": 0.05,", "\"timestamp\": 0.01,"),
       {"entry 6: timestamp goes from 0.04 to 0.01 s"}},
      {"entries of texts",
       [](auto& b) { b = R"({"entries": ["a", "b"]})"; },
       {"there is no column 'timestamp'"}},
  };
  const TemporaryFile good(bench(), "good.json");
  testing::expect_refused(good.path(), ".json", columns_named("timestamp", "pwm", "position"), cases);
}

}  // namespace
}  // namespace gapscope
