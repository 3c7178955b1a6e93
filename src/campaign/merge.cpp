#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <map>

#include "base/interrupt.h"
#include "campaign/store.h"
#include "campaign/store_header.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

struct Sameness {
  std::string text;
  void operator()(const std::string&, std::string& value) { text += value + '\n'; }
  void operator()(const std::string&, double& value) { text += fmt::format("{}\n", value); }
  void operator()(const std::string&, std::optional<bool>& value) {
    text += !value ? "-\n" : *value ? "1\n" : "0\n";
  }
};

/// A number for everything in a row.
std::size_t digest(CampaignRow& row) {
  Sameness all;
  fields(all, row);
  return std::hash<std::string>()(all.text);
}

/// Copies what is not there yet; what is there must be the same.
void copy_rows(const CampaignStore& from, const std::string& folder, CampaignStore& to,
               std::map<std::uint64_t, std::size_t>& seen) {
  from.each(
      [&](CampaignRow& row, const CampaignTiming& timing) {
        stop_point();
        const std::size_t content = digest(row);
        const auto [before, is_new] = seen.emplace(row.run, content);
        if (is_new) return to.add(row, timing);
        if (before->second != content)
          throw ConfigError(folder,
                            fmt::format("has another result for run {} than a store before it, expected the "
                                        "same from the same campaign",
                                        row.run + 1));
      },
      true);
}

}  // namespace

std::uint64_t merge_campaigns(const std::vector<std::string>& folders, const std::string& target) {
  CampaignHeader header = CampaignStore(folders.front()).header();
  header.shard = {};
  for (const std::string& folder : folders) {
    const CampaignHeader other = CampaignStore(folder).header();
    if (const std::string what = internal::campaign::header_difference(other, header); !what.empty())
      throw ConfigError(folder, fmt::format("{} (as in {})", what, folders.front()));
    if (fs::exists(target) && fs::equivalent(folder, target))
      throw ConfigError(target, "is one of the folders to merge, expected another one to merge into");
  }
  if (fs::exists(fs::path(target) / "results.sqlite"))
    throw ConfigError(target, "has a store already, expected a folder without one to merge into");
  CampaignStore whole_store(target, header);
  std::map<std::uint64_t, std::size_t> seen;
  for (const std::string& folder : folders) copy_rows(CampaignStore(folder), folder, whole_store, seen);
  return seen.size();
}

}  // namespace gapscope
