// Whatever is wrong with a recording, a configuration or the command line: exit status 2, the place, what was
// expected, and nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::Workplace;

const std::string kModel =
    "model:\n"
    "  parameters:\n"
    "    motor_inertia: 1.0e-3\n"
    "    torque_constant: 0.1\n"
    "    motor_damping: 0.01\n"
    "    mass_ratio: 2\n"
    "    gap: 0.02\n"
    "    contact_stiffness: 200\n";
const std::string kRecorded = "name: bad\nrecording:\n  file: r.csv\n" + kModel;
const std::string kSimulated =
    "name: bad\nsimulation:\n  rate: 1000\n  duration: 1\n"
    "  excitation: {sine: {amplitude: 0.5, frequency: 2}}\n" +
    kModel;

std::string rows(int count) {
  std::string text = "t,u,x1\n";
  for (int i = 0; i < count; ++i) text += std::to_string(0.001 * i) + ",0.5,0.25\n";
  return text;
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

struct BadInput {
  const char* name;
  const char* arguments;
  std::string config;     ///< c.yaml
  std::string recording;  ///< r.csv
  const char* message;    ///< how standard error begins
};

void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

class BadInputTest : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, GivesStatusTwoThePlaceAndLeavesNothing) {
  Workplace place;
  if (!GetParam().config.empty()) place.file("c.yaml", GetParam().config);
  if (!GetParam().recording.empty()) place.file("r.csv", GetParam().recording);
  place.file("folder/file", "");
  const auto before = place.content();
  const auto outcome = place.run(GetParam().arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, StartsWith(GetParam().message));
  EXPECT_THAT(outcome.err, HasSubstr(", expected "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(place.content(), before);
}

BadInput recording(const char* name, const std::string& text, const char* message) {
  return {name, "detect c.yaml", kRecorded, text, message};
}
BadInput config(const char* name, const std::string& text, const char* message) {
  return {name, "run c.yaml", text, rows(60), message};
}
BadInput line(const char* name, const char* arguments, const char* message) {
  return {name, arguments, kSimulated, rows(60), message};
}

const std::vector<BadInput> kRecordings = {
    recording("no_file", "", "c.yaml:3: there is no recording r.csv"),
    recording("no_header", with(rows(60), "t,u,x1\n", ""), "r.csv:1: begins with numbers"),
    recording("no_position", with(rows(60), "x1", "y"), "r.csv:1: there is no column 'x1'"),
    recording("bars", "t|u|x1\n0|0|0\n", "r.csv:1: there is no column 't'"),
    recording("word", with(rows(60), "0.003000,0.5", "0.003000,half"), "r.csv:5: u is 'half'"),
    recording("infinite", with(rows(60), "0.25\n0.006", "inf\n0.006"), "r.csv:7: x1 is 'inf'"),
    recording("short_row", rows(60) + "0.06\n", "r.csv:62: 1 fields"),
    recording("decimal_commas", rows(60) + "0,06,0,5,0,25\n", "r.csv:62: 6 fields"),
    recording("time_back", rows(60) + "0.01,0,0\n", "r.csv:62: t goes from 0.059 to 0.01 s"),
    recording("pause", rows(60) + "0.5,0,0\n", "r.csv:62: time is not uniform"),
    recording("few_samples", rows(49), "r.csv: 49 samples"),
    recording("comments_only", "# t,u,x1\n", "r.csv: is empty"),
    {"window_beyond", "detect c.yaml", with(kRecorded, "r.csv\n", "r.csv\n  window: [5, 6]\n"), rows(60),
     "r.csv: 0 samples in the window 5 to 6 s"},
    {"missing_load_column", "detect c.yaml",
     with(kRecorded, "r.csv\n", "r.csv\n  columns: {load_position: phi}\n"), rows(60),
     "r.csv:1: there is no column 'phi'"},
    {"folder_as_recording", "detect c.yaml", with(kRecorded, "r.csv", "folder"), "",
     "folder: is no regular file"},
};

const std::vector<BadInput> kConfigs = {
    config("unknown_method", kSimulated + "detector: {method: loop}\n",
           "c.yaml:14: detector.method is 'loop'"),
    config("paper_without_a_bound", kSimulated + "detector: {method: paper}\n",
           "c.yaml:14: detector.method is paper without a bound"),
    config("literal_without_a_bound", kSimulated + "detector: {method: literal}\n",
           "c.yaml:14: detector.method is literal without a bound"),
    config("loop_with_a_bound", kSimulated + "detector: {method: lost_motion, bound: 4}\n",
           "c.yaml:14: detector.method is lost_motion beside a bound"),
    config("empty", "# nothing\n", "c.yaml: is empty"),
    config("syntax", "name: [a\nrecording: {\n", "c.yaml:"),
    config("two_documents", kRecorded + "---\nname: b\n", "c.yaml:12: a second document"),
    config("unknown_key", kRecorded + "enocder: {bits: 20}\n",
           "c.yaml:12: unknown key 'enocder', expected encoder"),
    config("unknown_parameter", with(kRecorded, "gap:", "backlash:"), "c.yaml:10: unknown key 'backlash'"),
    config("effect_with_control_characters",
           kRecorded + "  effects: [{\"cog\\e[31m\\n\": {amplitude_nm: 1}}]\n",
           "c.yaml:12: model.effects[0].cog?[31m? is no effect of the catalogue"),
    config("key_twice", kRecorded + "name: c\n", "c.yaml:12: the key 'name' is there twice"),
    config("name_with_slash", with(kRecorded, "bad", "a/b"), "c.yaml:1: name is 'a/b'"),
    config("no_data", "name: a\n" + kModel, "c.yaml:1: there is no recording"),
    config("both_data", kSimulated + "recording: {file: r.csv}\n",
           "c.yaml:2: simulation stands beside recording"),
    config("no_model", "name: a\nrecording: {file: r.csv}\n", "c.yaml: there is no model"),
    config("no_inertia", with(kRecorded, "    motor_inertia: 1.0e-3\n", ""),
           "c.yaml:4: model.parameters has no motor_inertia"),
    config("gap_negative", with(kRecorded, "gap: 0.02", "gap: -0.02"),
           "c.yaml:10: model.parameters.gap is -0.02 rad"),
    config("outside_bounds", with(kRecorded, "gap: 0.02", "gap: {value: 0.5, bounds: [0, 0.3]}"),
           "c.yaml:10: model.parameters.gap.value is 0.5 rad, expected 0 to 0.3 rad"),
    config("bounds_reversed",
           with(kRecorded, "gap: 0.02", "gap: {value: 0.2, estimate: true, bounds: [1, 0]}"),
           "c.yaml:10: model.parameters.gap.bounds"),
    config("wrong_type", with(kRecorded, "gap: 0.02", "gap: [0.02]"),
           "c.yaml:10: model.parameters.gap is a list"),
    config("text_for_number", with(kRecorded, "gap: 0.02", "gap: '0.02'"),
           "c.yaml:10: model.parameters.gap is the text"),
    config("encoder", kRecorded + "encoder: {bits: 99}\n", "c.yaml:12: encoder.bits is '99'"),
    config("detector", kRecorded + "detector: {bound: auot}\n", "c.yaml:12: detector.bound is 'auot'"),
    config("fit_option", kRecorded + "fit: {starts: 0}\n", "c.yaml:12: fit.starts is '0'"),
    config("too_many_samples", with(kSimulated, "duration: 1", "duration: 1e7"),
           "c.yaml:2: simulation gives rate x duration = 1e+10 samples"),
    config("excitation", with(kSimulated, "frequency", "freqency"), "c.yaml:5: unknown key 'freqency'"),
    config("above_nyquist", with(kSimulated, "frequency: 2", "frequency: 600"),
           "c.yaml:5: simulation.excitation sine: frequency is 600 Hz"),
    config("resample", with(kRecorded, "r.csv\n", "r.csv\n  resample: 400\n"),
           "c.yaml:4: recording.resample is '400'"),
};

const std::vector<BadInput> kCommandLines = {
    line("no_command", "", "gapscope: there is no command"),
    line("unknown_command", "rnu c.yaml", "gapscope: there is no command 'rnu' (nearest: run), expected"),
    line("no_config", "run", "gapscope: CONFIG is required"),
    line("unknown_option", "run c.yaml --fast", "gapscope: "),
    line("second_config", "run c.yaml d.yaml", "gapscope: "),
    line("option_without_value", "run c.yaml -o", "gapscope: "),
    line("setting_without_value", "run c.yaml --set", "gapscope: "),
    line("no_setting", "run c.yaml --set name", "gapscope: --set is 'name', expected KEY=VALUE"),
    line("unknown_setting", "fit c.yaml --set model.parameters.gapp=1",
         "--set model.parameters.gapp: unknown key 'gapp' in model.parameters, expected gap"),
    line("setting_out_of_range", "diagnose c.yaml --set model.parameters.gap=-1",
         "--set model.parameters.gap: model.parameters.gap is -1 rad"),
    line("setting_of_a_file", "detect c.yaml --set simulation.excitation={trace:{file:nowhere.csv}}",
         "--set simulation.excitation: "),
    line("setting_of_a_stream", "detect --stream --set name=a", "gapscope: --set excludes --stream"),
    line("missing_config", "run nothing.yaml", "nothing.yaml: there is no such file"),
    line("folder_as_config", "run folder", "folder: is a folder"),
    line("file_as_report", "run c.yaml -o folder/file", "folder/file: is a file"),
    line("simulate_without_output", "simulate c.yaml", "gapscope: --output is required"),
    line("simulate_into_folder", "simulate c.yaml -o folder", "folder: is a folder"),
    line("simulate_into_nowhere", "simulate c.yaml -o no/where.csv", "no/where.csv: cannot be written there"),
    line("simulate_over_its_config", "simulate c.yaml -o ./c.yaml", "./c.yaml: is the input itself"),
    {"diagnose_no_recording", "diagnose no.csv", kRecorded, rows(60), "no.csv: there is no such file"},
    {"simulate_recorded", "simulate c.yaml -o o.csv", kRecorded, rows(60), "c.yaml: there is no simulation"},
    line("check_nothing", "check", "gapscope: FILE is required"),
    line("check_missing", "check nothing.csv", "nothing.csv: there is no such file"),
    line("check_other_columns", "check r.csv --input i_q", "r.csv:1: there is no column 'i_q'"),
    line("check_window_reversed", "check r.csv --window 3 1", "gapscope: --window goes backwards"),
    line("check_rate", "check r.csv --resample 0", "gapscope: --resample"),
    line("check_over_its_recording", "check r.csv -o ./r.csv", "./r.csv: is the input itself"),
    line("compare_one", "compare folder", "gapscope: DIR"),
    line("compare_nothing", "compare folder nowhere", "folder: has no result.json"),
    line("compare_into_a_file", "compare folder nowhere -o r.csv", "r.csv: is a file"),
    line("stream_and_configuration", "detect --stream c.yaml", "gapscope: CONFIG excludes --stream"),
    line("column_without_stream", "detect c.yaml --input i_q", "gapscope: --input requires --stream"),
    line("detect_nothing", "detect", "gapscope: CONFIG is required"),
    line("report_of_nothing", "report nowhere", "nowhere: there is no such folder"),
    line("report_of_another_folder", "report folder", "folder"),
};

const auto kName = [](const auto& tested) { return std::string(tested.param.name); };
INSTANTIATE_TEST_SUITE_P(Recording, BadInputTest, ::testing::ValuesIn(kRecordings), kName);
INSTANTIATE_TEST_SUITE_P(Configuration, BadInputTest, ::testing::ValuesIn(kConfigs), kName);
INSTANTIATE_TEST_SUITE_P(CommandLine, BadInputTest, ::testing::ValuesIn(kCommandLines), kName);

}  // namespace
}  // namespace gapscope
