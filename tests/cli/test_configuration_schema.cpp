// A configuration that is read is valid by the published schema; one with a mistake in it is not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "cli/validated.h"
#include "support/yaml_as_json.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using testing::as_json;
using ::testing::HasSubstr;
using testing::judged;
using testing::text_of;
using testing::Workplace;

const fs::path kCheckout = GAPSCOPE_SOURCE_DIR;

std::string judged_yaml(const std::string& text) {
  Workplace place;
  place.file("configuration.json", as_json(YAML::Load(text)).dump());
  return judged(place, "configuration.json");
}

TEST(ConfigurationSchemas, TheConfigurationsOfTheRepositoryAreValid) {
  Workplace place;
  std::string files;
  int found = 0;
  for (const auto& entry : fs::directory_iterator(kCheckout / "configs")) {
    const std::string name = entry.path().filename().string(), text = text_of(entry.path());
    if (entry.path().extension() != ".yaml" || name.find("campaign") != name.npos || name == "07_blind.yaml")
      continue;
    place.file(name + "/configuration.json", as_json(YAML::Load(text)).dump());
    files += " " + name + "/configuration.json", ++found;
  }
  const std::string said = judged(place, files);
  GAPSCOPE_NEEDS_VALIDATOR(said);
  EXPECT_EQ(said, fmt::format("{} files are valid\n", found));
  EXPECT_GE(found, 6);
}

TEST(ConfigurationSchemas, WhatTheCommandsWriteIsValid) {
  Workplace place;
  const std::string recording = (kCheckout / "configs/03_recording.csv").string();
  ASSERT_EQ(place.run("init " + recording + " --model gap -o first.yaml").status, 0);
  const std::string said = judged_yaml(text_of(place.folder() / "first.yaml"));
  GAPSCOPE_NEEDS_VALIDATOR(said);
  EXPECT_EQ(said, "1 files are valid\n");
  ASSERT_EQ(place.run("detect first.yaml -o r").status, 0);
  EXPECT_EQ(judged_yaml(text_of(place.folder() / "r/resolved.yaml")), "1 files are valid\n");
}

TEST(ConfigurationSchemas, MistakesAreNot) {
  const std::string whole = text_of(kCheckout / "configs/08_missing_cogging.yaml");
  GAPSCOPE_NEEDS_VALIDATOR(judged_yaml(whole));
  const std::pair<const char*, const char*> mistakes[] = {
      {"\ncolour: red\n", "colour"},
      {"\nencoder: {bits: 41}\n", "$.encoder"},
      {"\nencoder: {bits: 20, quantum: 1e-6}\n", "$.encoder"},
      {"\ncoordinates: polar\n", "$.coordinates"},
      {"\ndetector: {bound: soon}\n", "$.detector.bound"},
      {"\nfit: {starts: 0}\n", "$.fit.starts"},
      {"\nfit: {starts: many}\n", "$.fit.starts"},
      {"\nsimulation: {duration: 1}\n", "$.simulation"},
      {"\nmodel: {load: heavy}\n", "$.model.load"},
      {"\nmodel: {effects: [{coging_torque: {}}]}\n", "$.model.effects[0]"},
      {"\nmodel: {effects: [{motor_coulomb_friction: {level: 1}}]}\n", "$.model.effects[0]"},
      {"\nmodel: {parameters: {gap: {value: 0.1, bound: [0, 1]}}}\n", "$.model.parameters.gap"},
      {"\ndiagnosis: {exclude: [nothing]}\n", "$.diagnosis.exclude[0]"},
  };
  Workplace folder;
  std::string files;
  const auto named = [&](const char* mistake) {
    return fmt::format("{:016x}/configuration.json", std::hash<std::string>()(mistake));
  };
  for (const auto& [mistake, place] : mistakes) {
    YAML::Node document = YAML::Load(whole);
    for (const auto& entry : YAML::Load(mistake)) document[entry.first.Scalar()] = entry.second;
    const std::string name = named(mistake);
    folder.file(name, as_json(YAML::Load(YAML::Dump(document))).dump());
    files += " " + name;
  }
  const std::string said = judged(folder, files);
  for (const auto& [mistake, place] : mistakes) {
    std::istringstream lines(said);
    std::string of_it;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(named(mistake) + ": ")) of_it += line + "\n";
    EXPECT_THAT(of_it, HasSubstr(place)) << mistake;
  }
}

}  // namespace
}  // namespace gapscope
