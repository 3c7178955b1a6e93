#include "campaign/recorded_data.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "base/move_file.h"
#include "gapscope/base/errors.h"
#include "results/sha256.h"

namespace gapscope::internal::campaign {
namespace {

/// Only what is sure is said: a store that begins with a passing trouble could never be gone on with.
std::string line_for(const RecordedFile& file) {
  std::error_code problem;
  const auto there = std::filesystem::status(file.path, problem);
  if (there.type() == std::filesystem::file_type::not_found)
    return fmt::format("recording {}: not there\n", file.given);
  if (problem) throw MachineError(file.path + ": cannot be read: " + problem.message());
  try {
    return fmt::format("recording {}: SHA-256 {}\n", file.given, sha256_of_file(file.path));
  } catch (const ConfigError& error) {
    throw MachineError(error.what());
  }
}

/// The first run, and for every value of an axis over recordings a run that has it.
std::vector<std::uint64_t> runs_to_look_at(const CampaignConfig& c) {
  std::vector<std::uint64_t> runs = {0};
  std::uint64_t stride = c.runs();
  for (const CampaignAxis& axis : c.axes) {
    const bool counts = !c.hypercube && axis.path.starts_with("recording");
    if (!c.hypercube) stride /= axis.values.size();
    for (std::size_t k = 1; counts && k < axis.values.size(); ++k) runs.push_back(k * stride);
  }
  return runs;
}

/// A run that cannot be made has none: that is told in its row.
std::vector<RecordedFile> files_of(const CampaignConfig& c, std::uint64_t run) try {
  const Configuration configuration = campaign_run(c, run);
  return configuration.recording ? configuration.recording->files : std::vector<RecordedFile>{};
} catch (const ConfigError&) {
  return {};
}

}  // namespace

std::string recorded_data(const CampaignConfig& c) {
  std::set<std::string> lines;
  for (const std::uint64_t run : runs_to_look_at(c)) {
    for (const RecordedFile& file : files_of(c, run)) lines.insert(line_for(file));
  }
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

std::vector<std::string> recorded_files(const CampaignConfig& c) {
  std::set<std::string> paths;
  for (const std::uint64_t run : runs_to_look_at(c))
    for (const RecordedFile& file : files_of(c, run)) paths.insert(file.path);
  return {paths.begin(), paths.end()};
}

std::string state_of(const std::vector<std::string>& files) {
  std::string state;
  for (const std::string& path : files) state += identity_of(path) + "\n";
  return state;
}

}  // namespace gapscope::internal::campaign
