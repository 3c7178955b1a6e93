// The published schemas are those that the command knows, and what it writes is valid by them.
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

TEST(Schemas, EveryKindOfResultIsValid) {
  Workplace place;
  place.file("drive.yaml", kDrive);
  place.file(
      "c.yaml",
      "name: c\nbase:\n  encoder: {bits: 18}\n  simulation: {rate: 1000, duration: 4, plant: independent, "
      "excitation: {sine: {amplitude: 0.58, frequency: 1}}}\n  model: " +
          testing::kPaperModel + "axes: {simulation.seed: {repeat: 2, seed: 1}}\nestimators: [model_free]\n");
  for (const char* command : {"run drive.yaml -o run", "detect drive.yaml -o detect", "fit drive.yaml -o fit",
                              "compare run detect -o both", "simulate drive.yaml -o r.csv",
                              "campaign c.yaml -o campaign", "check r.csv -o check.json"}) {
    const auto made = place.run(command);
    ASSERT_EQ(made.status, 0) << command << made.err;
  }
  const std::string stream =
      "cd " + place.folder().string() + " && " GAPSCOPE_EXECUTABLE " detect --stream <r.csv >stream.jsonl";
  ASSERT_EQ(std::system(stream.c_str()), 0);
  const std::string kept = (kSource / "reports").string();
  const std::string said = judged(
      place,
      "run/result.json run/timing.json detect/result.json fit/result.json both/compare.json check.json "
      "stream.jsonl campaign/campaign.json " +
          kept + "/blind/blind.json " + kept + "/04_sampling_resolution/campaign.json");
  GAPSCOPE_NEEDS_VALIDATOR(said);
  EXPECT_EQ(said, "10 files are valid\n");
}

TEST(Schemas, ADiagnosisIsValid) {
  Workplace place;
  place.file("drive.yaml", kDrive);
  const auto made = place.run("diagnose drive.yaml -o d");
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string said = judged(place, "d/diagnosis.json");
  GAPSCOPE_NEEDS_VALIDATOR(said);
  EXPECT_EQ(said, "1 files are valid\n");
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
  place.file("damaged.json", "{\"schema\": \"gapscope.result/1\", \"simulated_gap_rad\": NaN}");
  EXPECT_THAT(judged(place, "damaged.json"), HasSubstr("holds NaN"));
}

}  // namespace
}  // namespace gapscope
