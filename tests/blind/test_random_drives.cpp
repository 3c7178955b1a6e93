#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "blind/random_drives.h"
#include "config/configuration.h"
#include "gapscope/recording/recording_file.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> files_of(RandomDriveKind kind, std::uint64_t first, std::uint64_t last) {
  const testing::TemporaryFile place("");
  const fs::path folder = place.folder() / "drives";
  write_random_drives(kind, first, last, folder.string());
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    files[entry.path().filename()] = text.str();
  }
  return files;
}

TEST(RandomDrives, AreAFunctionOfTheirSeedAlone) {
  const auto alone = files_of(RandomDriveKind::kGap, 12, 12);
  const auto among = files_of(RandomDriveKind::kGap, 11, 12);
  EXPECT_EQ(alone.at("gap_12.csv"), among.at("gap_12.csv"));
  EXPECT_EQ(alone.at("gap_12.yaml"), among.at("gap_12.yaml"));
  EXPECT_NE(among.at("gap_11.csv"), among.at("gap_12.csv"));
}

TEST(RandomDrives, TellTheEstimatorsNothingButInputMotorPositionAndASheet) {
  for (const RandomDriveKind kind : {RandomDriveKind::kGap, RandomDriveKind::kGapFree})
    for (const auto& [name, text] : files_of(kind, 3, 6)) {
      if (name.ends_with(".csv") && name != "truth.csv") {
        EXPECT_EQ(text.substr(0, text.find('\n')), "t,u,x1") << name;
      }
      if (name.ends_with(".yaml")) {
        EXPECT_NO_THROW(parse_configuration(text, name)) << text;
      }
    }
}

TEST(RandomDrives, TruthHasOneRowADrive) {
  const std::string truth = files_of(RandomDriveKind::kGapFree, 1, 5).at("truth.csv");
  EXPECT_EQ(std::count(truth.begin(), truth.end(), '\n'), 6);
}

}  // namespace
}  // namespace gapscope
