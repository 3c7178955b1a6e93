// Whatever is wrong with a stored report: exit status 2, the file and line, what was expected, and the report
// as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::text_of;
using testing::Workplace;

struct Damage {
  const char* name;
  const char* file;
  const char* from;  ///< first place of this text; "": the whole file
  const char* to;
  const char* message;  ///< how standard error begins
};

constexpr const char* kResult = "result.json";
constexpr const char* kTrace = "traces/1_rig.csv";

const std::vector<Damage> kDamages = {
    {"empty", kResult, "", "", "report/result.json: is empty"},
    {"cut_off", kResult, "\"comparison\"", "\"compar", "report/result.json:"},
    {"list", kResult, "", "[1, 2]", "report/result.json:1: the document is [1,2], expected an object"},
    {"text", kResult, "", "\"hello\"", "report/result.json:1: the document is \"hello\""},
    {"binary", kResult, "", "\x01\x02\xff", "report/result.json:1: is no valid JSON"},
    {"no_utf8", kResult, "\"rig\"", "\"r\xffg\"", "report/result.json:3: is no valid JSON"},
    {"no_schema", kResult, " \"schema\": \"gapscope.result/1\",\n", "",
     "report/result.json:1: schema is missing"},
    {"other_schema", kResult, "gapscope.result/1", "gapscope.result/2",
     "report/result.json:2: schema is \"gapscope.result/2\", expected \"gapscope.result/1\""},
    {"schema_number", kResult, "\"gapscope.result/1\"", "1",
     "report/result.json:2: schema is 1, expected text"},
    {"coordinates", kResult, "\"rotation\"", "\"spiral\"",
     "report/result.json:5: coordinates is \"spiral\", expected one of rotation, translation"},
    {"verdict", kResult, "\"verdict\": \"backlash\"", "\"verdict\": \"maybe\"",
     "report/result.json:{line}: model_free.verdict is \"maybe\", expected one of backlash, none, inconclusive"},
    {"number_as_text", kResult, "\"scale\": ", "\"scale\": \"1\", \"was\": ",
     "report/result.json:{line}: model_free.scale is \"1\", expected a number or null"},
    {"interval_of_three", kResult, "\"ci95_rad\": [", "\"ci95_rad\": [0, ",
     "report/result.json:8: answer.ci95_rad is [0,0.0"},
    {"warnings_no_list", kResult, "\"warnings\": [", "\"warnings\": 3, \"was\": [",
     "report/result.json:{line}: model_free.warnings is 3, expected a list"},
    {"event_no_object", kResult, "\"events\": [", "\"events\": [7,",
     "report/result.json:{line}: model_free.events[0] is 7, expected an object"},
    {"event_direction", kResult, "\"direction\": -1,", "\"direction\": 1.5,",
     "report/result.json:{line}: model_free.events[0].direction is 1.5, expected a whole number"},
    {"missing_key", kResult, "\"message\": ", "\"massage\": ", "report/result.json:"},
    {"truth", kResult, "\"converged\": true", "\"converged\": \"yes\"", "report/result.json:"},
    {"count_beyond_numbers", kResult, "\"samples\": 5000", "\"samples\": 50000000000", "report/result.json:"},
    {"other_count", kResult, "\"samples\": 5000", "\"samples\": 1999",
     "report/traces/1_rig.csv: has 5000 samples, expected 1999"},
    {"trace_elsewhere", kResult, "traces/1_rig.csv", "../c.yaml",
     "report: its stored result names the trace '../c.yaml', expected a file in traces/"},
    {"trace_absolute", kResult, "traces/1_rig.csv", "/etc/passwd",
     "report: its stored result names the trace"},
    {"trace_missing", kResult, "traces/1_rig.csv", "traces/2_rig.csv",
     "report/traces/2_rig.csv: there is no such file"},
    {"trace_empty", kTrace, "", "", "report/traces/1_rig.csv: is empty"},
    {"trace_header", kTrace, "t_s,u", "t,u", "report/traces/1_rig.csv:1: the first column is not t_s"},
    {"trace_column", kTrace, "t_s,u", "t_s,v", "report/traces/1_rig.csv:1: there is a column 'v'"},
    {"trace_column_twice", kTrace, "t_s,u,", "t_s,u,u,", "report/traces/1_rig.csv:1: there is a column 'u'"},
    {"trace_without_position", kTrace, "x1_rad", "x2_rad", "report/traces/1_rig.csv:1: there is"},
    {"trace_without_error", kTrace, "e_x_rad", "torque_after_nm",
     "report/traces/1_rig.csv:1: there is no column e_x_rad"},
    {"trace_word", kTrace, "\n0.001,", "\n0.001,zero", "report/traces/1_rig.csv:3: 'zero"},
    {"trace_mode", kTrace, ",gap", ",gape", "report/traces/1_rig.csv:"},
    {"trace_field_more", kTrace, "\n0.001,", "\n0.001,0.5,", "report/traces/1_rig.csv:3: has "},
    {"map_word", "traces/bound_map.csv", "", "x\n", "report/traces/bound_map.csv:1: 'x' is no number"},
    {"map_width", "traces/bound_map.csv", "", "1,2\n", "report/traces/bound_map.csv:1: has 2 fields"},
};

void expect_refused(Workplace& place, const Damage& damage) {
  const auto path = place.folder() / "report" / damage.file;
  const std::string whole = text_of(path), from = damage.from;
  std::string text = whole;
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.empty() ? text.size() : from.size(), damage.to);
  place.file(std::string("report/") + damage.file, text);
  const auto before = place.content();
  const auto outcome = place.run("report report");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  std::string message = damage.message;
  if (const std::size_t line = message.find("{line}"); line != std::string::npos)
    message.replace(line, 6, std::to_string(1 + std::count(whole.begin(), whole.begin() + at, '\n')));
  EXPECT_THAT(outcome.err, StartsWith(message));
  EXPECT_THAT(outcome.err, HasSubstr(", expected "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(place.content(), before);
  EXPECT_EQ(text_of(path), text);
  place.file(std::string("report/") + damage.file, whole);
}

// One test: the report that is damaged takes longer to make than all of them to be refused.
TEST(DamagedReport, GivesStatusTwoThePlaceAndLeavesTheReport) {
  Workplace place;
  place.file("c.yaml",
             "name: rig\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 5, excitation: {sine: "
             "{amplitude: 0.58, frequency: 1}}}\nmodel: " +
                 testing::kPaperModel);
  ASSERT_EQ(place.run("run c.yaml -o report").status, 0);
  for (const Damage& damage : kDamages) {
    SCOPED_TRACE(damage.name);
    expect_refused(place, damage);
  }
}

}  // namespace
}  // namespace gapscope
