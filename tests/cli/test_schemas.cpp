// The published schemas are those that the command knows. That what it writes is valid by them is judged at
// the end of every test program of the command (written_json.h).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/validated.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::judged;
using testing::text_of;
using testing::Workplace;

const fs::path kSource = GAPSCOPE_SOURCE_DIR;
const std::string kSchemas = (kSource / "docs/schemas").string();

const std::string kDrive =
    "name: drive\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 5, noise: 1.0e-5, plant: independent, "
    "excitation: {sine: {amplitude: 0.58, frequency: 1}}}\nfit: {starts: 1}\nmodel: " +
    testing::kPaperModel;

TEST(Schemas, AreThoseThatArePublished) {
  Workplace place;
  std::istringstream names(place.run("schema").out);
  std::size_t count = 0;
  for (std::string name; std::getline(names, name); ++count)
    EXPECT_EQ(place.run("schema " + name).out, text_of(kSchemas + "/" + name + ".schema.json"))
        << "gapscope schema " << name << " > docs/schemas/" << name << ".schema.json";
  EXPECT_EQ(count, static_cast<std::size_t>(std::distance(fs::directory_iterator(kSchemas), {})));
  EXPECT_EQ(place.run("schema nothing").status, 2);
}

TEST(Schemas, TheKeptReportsAreValid) {
  std::string files;
  for (const char* kept : {"05_estimators/campaign.json", "blind/blind.json"})  // 04 is of schema 1
    files += (kSource / "reports" / kept).string() + " ";
  Workplace place;
  const std::string said = judged(place, files);
  GAPSCOPE_NEEDS_VALIDATOR(said);
  EXPECT_EQ(said, "2 files are valid\n");
}

/// What one call of the validator says of several documents, each by its own name: it starts slowly.
class DamagedResults {
 public:
  void damage(const std::string& name, const std::string& where, const nlohmann::json& value) {
    nlohmann::json damaged = whole_;
    damaged[nlohmann::json::json_pointer(where)] = value;
    put(name, damaged.dump());
  }
  void remove(const std::string& name, const std::string& key) {
    nlohmann::json less = whole_;
    less.erase(key);
    put(name, less.dump());
  }
  void put(const std::string& name, const std::string& text) {
    place_.file(name + ".json", text);
    const std::size_t folder = name.find('/');
    names_ += (folder == name.npos ? name + ".json" : name.substr(0, folder)) + " ";
  }
  std::string judged_all() const { return judged(place_, names_); }

 private:
  static nlohmann::json result_of(Workplace& place) {
    place.file("drive.yaml", kDrive);
    EXPECT_EQ(place.run("detect drive.yaml -o r").status, 0);
    return nlohmann::json::parse(text_of(place.folder() / "r/result.json"));
  }

  Workplace place_;
  nlohmann::json whole_ = result_of(place_);
  std::string names_;
};

TEST(Schemas, ADamagedResultIsNot) {
  DamagedResults results;
  results.damage("renamed", "/name", "other");
  results.damage("verdict", "/model_free/verdict", "maybe");
  results.damage("text", "/model_free/gap_rad", "0.019");
  results.damage("nothing", "/model_free", nlohmann::json::object());
  results.damage("samples", "/recordings/0/samples", 1.5);
  results.damage("version", "/version", nullptr);
  results.damage("schema", "/schema", "gapscope.campaign/1");
  results.remove("less", "comparison");
  results.damage("hash", "/configuration/sha256", std::string(64, '0'));
  results.remove("older", "configuration");
  results.remove("now/older", "configuration");  // in a folder, whose results are of the present version
  results.put("nan", "{\"schema\": \"gapscope.result/1\", \"simulated_gap_rad\": NaN}");
  const std::string said = results.judged_all();
  GAPSCOPE_NEEDS_VALIDATOR(said);
  for (const char* expected :
       {"verdict.json: $.model_free", "text.json: $.model_free", "nothing.json: $.model_free",
        "samples.json: $.recordings[0].samples", "version.json: $.version", "less.json: $: 'comparison' is a",
        "hash.json: configuration.sha256 is not that of", "nan.json: holds NaN",
        "now/older.json: the configuration is missing"})
    EXPECT_THAT(said, HasSubstr(expected));
  EXPECT_THAT(said, ::testing::ContainsRegex("schema.json: [^\n]*is a required property"));
  EXPECT_THAT(said, ::testing::Not(::testing::ContainsRegex("(^|\n)(renamed|older).json:"))) << "valid";
}

}  // namespace
}  // namespace gapscope
