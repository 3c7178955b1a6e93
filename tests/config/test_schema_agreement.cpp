// What the schema of a configuration takes is what the reader takes: of hundreds of slips either both refuse
// one, or none does.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "config/configuration.h"
#include "config/configuration_schema.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"
#include "support/yaml_as_json.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The shipped configurations and the schema, for the script.
void write_bases(const fs::path& folder) {
  std::ofstream(folder / "configuration.schema") << configuration_schema();
  for (const auto& entry : fs::directory_iterator(GAPSCOPE_CONFIGS)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string name = entry.path().stem().string();
    std::ofstream(folder / (name + ".json"))
        << testing::as_json(YAML::LoadFile(entry.path().string())).dump();
  }
}

/// "" where the reader takes it.
std::string reader_refuses_with(const std::string& text) {
  try {
    parse_configuration(text, "drive.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

/// Of the words in which the reader refuses what compares the values of two places, which no schema can: the
/// descriptions of the schema say it.
const std::set<std::string> kCompared = {
    "low < high",      "low is",
    ".value is ",  // outside its own bounds
    "a second time",   "names above, too",
    "one for each of", "uses the column",
    "rate x duration", "less than half the sampling rate",
    "lines between",   "lowest_frequency below highest_frequency",
};

/// Those of a refusal.
std::string compared_in(const std::string& refusal) {
  for (const std::string& words : kCompared)
    if (refusal.find(words) != std::string::npos) return words;
  return "";
}

TEST(ConfigurationSchema, TakesWhatTheReaderTakesAndNothingElse) {
  const testing::TemporaryFile place("");
  write_bases(place.folder());
  const std::string script = std::string(GAPSCOPE_CONFIGS) + "/../tests/config/schema_slips.py";
  const std::string slips = (place.folder() / "slips").string();
  const int status =
      std::system(fmt::format("python3 {} {} >{}", script, place.folder().string(), slips).c_str());
  if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127) GTEST_SKIP() << "no python3-jsonschema here";
  ASSERT_EQ(status, 0);
  int count = 0, refused = 0;
  std::set<std::string> compared;
  std::ifstream in(slips);
  for (std::string line; std::getline(in, line); ++count) {
    const json slip = json::parse(line);
    const std::string refusal = reader_refuses_with(slip["text"]),
                      what = slip["base"].get<std::string>() + ": " + slip["slip"].get<std::string>();
    refused += !refusal.empty();
    if (slip["valid"] == refusal.empty()) continue;
    const std::string words = compared_in(refusal);
    if (!words.empty())
      compared.insert(words);
    else
      ADD_FAILURE() << what
                    << (refusal.empty() ? ": only the reader takes it"
                                        : ": only the schema takes it\n  " + refusal);
  }
  EXPECT_GE(count, 1500);
  EXPECT_GE(refused, 1000);
  EXPECT_EQ(compared, kCompared);
}

}  // namespace
}  // namespace gapscope
