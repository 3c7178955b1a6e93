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
    "name: drive\nencoder: {bits: 18}\nsimulation: {rate: 1000, duration: 5, noise: 1.0e-5, plant: "
    "independent, "
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
  for (const char* kept :
       {"04_sampling_resolution/campaign.json", "05_estimators/campaign.json", "blind/blind.json"})
    files += (kSource / "reports" / kept).string() + " ";
  Workplace place;
  const std::string said = judged(place, files);
  GAPSCOPE_NEEDS_VALIDATOR(said);
  EXPECT_EQ(said, "3 files are valid\n");
}

TEST(Schemas, ADamagedResultIsNot) {
  Workplace place;
  place.file("drive.yaml", kDrive);
  ASSERT_EQ(place.run("detect drive.yaml -o r").status, 0);
  const auto whole = nlohmann::json::parse(text_of(place.folder() / "r/result.json"));
  const auto said_of = [&](const std::string& where, const nlohmann::json& value) {
    nlohmann::json damaged = whole;
    damaged[nlohmann::json::json_pointer(where)] = value;
    place.file("damaged.json", damaged.dump());
    return judged(place, "damaged.json");
  };
  GAPSCOPE_NEEDS_VALIDATOR(said_of("/name", "drive"));
  EXPECT_EQ(said_of("/name", "other"), "1 files are valid\n");
  EXPECT_THAT(said_of("/model_free/verdict", "maybe"), HasSubstr("$.model_free"));
  EXPECT_THAT(said_of("/model_free/gap_rad", "0.019"), HasSubstr("$.model_free"));
  EXPECT_THAT(said_of("/model_free", nlohmann::json::object()), HasSubstr("$.model_free"));
  EXPECT_THAT(said_of("/recordings/0/samples", 1.5), HasSubstr("$.recordings[0].samples"));
  EXPECT_THAT(said_of("/version", nullptr), HasSubstr("$.version"));
  EXPECT_THAT(said_of("/schema", "gapscope.campaign/1"), HasSubstr("is a required property"));
  nlohmann::json less = whole;
  less.erase("comparison");
  place.file("damaged.json", less.dump());
  EXPECT_THAT(judged(place, "damaged.json"), HasSubstr("'comparison' is a required property"));
  EXPECT_THAT(said_of("/configuration/sha256", std::string(64, '0')), HasSubstr("is not that of"));
  nlohmann::json older = whole;
  older.erase("configuration");
  place.file("older.json", older.dump());
  place.file("now/older.json", older.dump());
  EXPECT_EQ(judged(place, "older.json"), "1 files are valid\n");
  EXPECT_THAT(judged(place, "now"), HasSubstr("the configuration is missing"));
  place.file("damaged.json", "{\"schema\": \"gapscope.result/1\", \"simulated_gap_rad\": NaN}");
  EXPECT_THAT(judged(place, "damaged.json"), HasSubstr("holds NaN"));
}

}  // namespace
}  // namespace gapscope
