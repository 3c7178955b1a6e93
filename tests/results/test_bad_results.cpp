// Whatever is wrong with a stored result of any schema: refused with its file, its line and what was
// expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "results/blind_files.h"
#include "results/blind_score.h"
#include "results/campaign_summary.h"
#include "results/diagnosis_result.h"
#include "results/drive_changes.h"
#include "results/run_result.h"
#include "results/scratch_folder.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::text_of;

/// Where a document is looked for in a report, and who reads it there.
struct Document {
  const char* file;
  void (*read)(const std::string& folder);
};
const std::map<std::string, Document> kDocuments = {
    {"result", {"result.json", [](const std::string& f) { read_run_result(f); }}},
    {"timing", {"timing.json", [](const std::string& f) { read_timing(f); }}},
    {"diagnosis", {"diagnosis.json", [](const std::string& f) { read_diagnosis_result(f); }}},
    {"campaign", {"campaign.json", [](const std::string& f) { read_campaign_summary(f); }}},
    {"compare", {"compare.json", [](const std::string& f) { read_drive_changes(f); }}},
    {"score", {"blind.json", [](const std::string& f) { read_blind_score(f); }}},
    {"labels", {"labels.json", [](const std::string& f) { read_blind_labels(f + "/labels.json"); }}},
    {"manifest", {"manifest.json", [](const std::string& f) { read_blind_manifest(f + "/manifest.json"); }}},
    {"answers", {"answers.json", [](const std::string& f) { read_blind_answers(f + "/answers.json"); }}},
    {"line", {"line", [](const std::string& f) { blind_answer_of(text_of(f + "/line"), f + "/line"); }}},
};

struct BadResult {
  const char* name;
  const char* document;  ///< one that is taken
  const char* from;      ///< first place of this text; "": all of it
  std::string to;
  const char* message;  ///< how it begins
};

void PrintTo(const BadResult& bad, std::ostream* out) { *out << bad.name; }

class BadResultTest : public ::testing::TestWithParam<BadResult> {};

TEST_P(BadResultTest, IsRefusedWithItsPlace) {
  const BadResult& bad = GetParam();
  const Document& document = kDocuments.at(bad.document);
  const ScratchFolder folder;
  std::string text = text_of(std::filesystem::path(GAPSCOPE_CORPUS) / "result" / bad.document);
  const std::string from = bad.from;
  const std::size_t at = text.find(from);
  ASSERT_NE(at, text.npos) << from;
  text.replace(at, from.empty() ? text.size() : from.size(), bad.to);
  std::ofstream(folder.path / document.file, std::ios::binary) << text;
  const std::string refused = testing::refusal([&] { document.read(folder.path.string()); });
  EXPECT_THAT(refused, StartsWith(folder.path.string() + "/" + bad.message));
  EXPECT_THAT(refused, HasSubstr(", expected "));
}

const std::vector<BadResult> kBadResults = {
    {"deep", "result", "", std::string(100000, '[') + std::string(100000, ']'),
     "result.json:1: is nested in more than 32 levels"},
    {"deep_object", "result", "\"bound_map\": null",
     "\"bound_map\": " + std::string(40, '[') + std::string(40, ']'), "result.json:53: is nested in more"},
    {"brackets_in_a_text", "result", "\"rig\"", "\"" + std::string(100, '[') + "\", \"x\": }",
     "result.json:3: is no valid JSON from here on"},
    {"number_too_large", "result", "\"scale\": ", "\"scale\": 1e999, \"was\": ",
     "result.json:21: has the number 1e999, which is too large"},
    {"map_without_bounds", "result", "\"bound_map\": null",
     R"("bound_map": {"file": "rig", "start_s": 0, "column_s": 1, "bounds_rad_s2": []})",
     "result.json:53: model_free.bound_map.bounds_rad_s2 does not rise"},
    {"map_of_falling_bounds", "result", "\"bound_map\": null",
     R"("bound_map": {"file": "rig", "start_s": 0, "column_s": 1, "bounds_rad_s2": [2, 1]})",
     "result.json:53: model_free.bound_map.bounds_rad_s2 does not rise"},
    {"time_as_text", "timing", "", "{\"model_free_s\": \"long\"}",
     "timing.json:1: model_free_s is \"long\", expected a number or null"},
    {"configuration_as_text", "result", "\"version\": ", R"("configuration": "c.yaml", "version": )",
     "result.json:4: configuration is \"c.yaml\", expected an object"},
    {"configuration_without_text", "result", "\"version\": ", R"("configuration": {}, "version": )",
     "result.json:4: configuration.resolved is missing"},
    {"configuration_of_another", "result",
     "\"version\": ", R"("configuration": {"resolved": "a: 1", "sha256": "00"}, "version": )",
     "result.json:4: configuration.sha256 is not that of `resolved`"},
    {"key_twice", "diagnosis", "\"verdict\": ", "\"verdict\": \"none\", \"verdict\": ",
     "diagnosis.json: has the key \"verdict\" twice"},
    {"other_schema", "diagnosis", "gapscope.diagnosis/2", "gapscope.diagnosis/7",
     "diagnosis.json:2: schema is \"gapscope.diagnosis/7\", expected \"gapscope.diagnosis/2\""},
    {"another_document", "diagnosis", "gapscope.diagnosis/2", "gapscope.result/1",
     "diagnosis.json:2: schema"},
    {"verdict", "diagnosis", "\"verdict\": \"effect\"", "\"verdict\": \"perhaps\"",
     "diagnosis.json:3: verdict is \"perhaps\", expected one of effect, helps, none, unknown"},
    {"effects_of_numbers", "diagnosis", "\"effects\": [", "\"effects\": [4, ",
     "diagnosis.json:4: effects holds 4, expected text"},
    {"floor", "diagnosis", "\"floor_from\": \"repeatability\"", "\"floor_from\": null",
     "diagnosis.json:37: gap.floor_from is null, expected one of encoder, noise, repeatability, records"},
    {"interval_of_one", "diagnosis", "\"shrink_ci95\": [", "\"shrink_ci95\": [0.5], \"was\": [",
     "diagnosis.json:25: added[0].shrink_ci95 is [0.5], expected [low, high] or null"},
    {"ranking_no_list", "diagnosis", "\"ranking\": [", "\"ranking\": 3, \"was\": [",
     "diagnosis.json:78: ranking is 3, expected a list"},
    {"parameter_text", "diagnosis", "\"amplitude_nm\": 0.008", "\"amplitude_nm\": \"much\"",
     "diagnosis.json:85: ranking[0].parameters.amplitude_nm is \"much\", expected a number or null"},
    {"share_list", "diagnosis", "\"mode\": {", "\"mode\": [], \"was\": {",
     "diagnosis.json:111: where.mode is [], expected an object"},
    {"axis_beyond", "campaign", "\"axis_a\": 0", "\"axis_a\": 7",
     "campaign.json:142: along_axes[0].axis_a is 7, expected 0 to 1"},
    {"axis_negative", "campaign", "\"axis_a\": 0", "\"axis_a\": -1",
     "campaign.json:142: along_axes[0].axis_a is -1"},
    {"a_pair_along_one_axis", "campaign", "\"axis_b\": -1", "\"axis_b\": 0",
     "campaign.json:143: along_axes[0].axis_b is 0, expected -1"},
    {"bin_beyond", "campaign", "\"cells\": [\n    {\n     \"a\": 0", "\"cells\": [\n    {\n     \"a\": 2",
     "campaign.json:146: along_axes[0].cells[0].a is 2, expected 0 to 1"},
    {"count_broken", "campaign", "\"runs\": 4", "\"runs\": 4.5",
     "campaign.json:5: runs is 4.5, expected a whole number"},
    {"truth_as_number", "campaign", "\"model_free\": true", "\"model_free\": 1",
     "campaign.json:9: model_free is 1, expected true or false"},
    {"quantities_list", "compare", "\"quantities\": {", "\"quantities\": [], \"was\": {",
     "compare.json:14: quantities is [], expected an object"},
    {"coordinates", "compare", "\"rotation\"", "\"sideways\"",
     "compare.json:4: coordinates is \"sideways\", expected one of rotation, translation"},
    {"cut_off", "score", "\"confusion\"", "\"conf", "blind.json:"},
    {"count_as_text", "score", "\"of\": 218", "\"of\": \"218\"",
     "blind.json:13: counts[0].of is \"218\", expected a whole number"},
    {"no_salt", "labels", "\"salt\"", "\"pepper\"", "labels.json:5: cases[0].salt is missing"},
    {"cases_object", "labels", "\"cases\": [", "\"cases\": {}, \"was\": [",
     "labels.json:4: cases is {}, expected a list"},
    {"more_events_than_samples", "result", "\"samples\": 5,", "\"samples\": 0,",
     "result.json:25: model_free.events has 2 items, expected at most one for each of 0 samples"},
    {"no_files", "manifest", "\"files\"", "\"piles\"", "manifest.json:7: cases[0].files is missing"},
    {"no_evidence", "answers", "\"evidence\": {", "\"evidence\": null, \"was\": {",
     "answers.json:35: cases[0].evidence is null, expected an object"},
    {"binary", "answers", "",
     "\x7f"
     "ELF\x02\x01",
     "answers.json:1: is no valid JSON"},
    {"torn_line", "line", ", \"evidence\"", "", "line:1: is no valid JSON from here on"},
    {"line_of_a_number", "line", "", "7", "line:1: the document is 7, expected an object"},
};

INSTANTIATE_TEST_SUITE_P(Of, BadResultTest, ::testing::ValuesIn(kBadResults),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace gapscope
