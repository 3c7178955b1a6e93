#include "results/stored_half.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "results/folder_content.h"
#include "results/json_document.h"
#include "results/shared_fields.h"

namespace gapscope::internal::results {
namespace {

namespace fs = std::filesystem;

struct Half {
  std::string name, version;
  std::vector<FileHash> sources;
};

Half read_half(const fs::path& path) {
  const Json json = load_json(path.string());
  JsonReader reader(json, path.string(), "");
  Half half;
  reader.added("name", half.name);
  reader("version", half.version);
  reader.added_list("sources", half.sources);
  return half;
}

std::string half_difference(const Half& a, const Half& b) {
  if (a.version != b.version) return "another version of gapscope";
  const auto is_in = [](const FileHash& s, const std::vector<FileHash>& all) {
    return std::find(all.begin(), all.end(), s) != all.end();
  };
  for (const Half* h : {&a, &b})
    for (const FileHash& s : h->sources)
      if (!is_in(s, a.sources) || !is_in(s, b.sources)) return "another " + printable(s.file, 100);
  return "";
}

/// Nothing where there is none, or one that another version wrote in its own way.
std::optional<Half> readable_half(const fs::path& path) try {
  return is_there(path) ? std::optional(read_half(path)) : std::nullopt;
} catch (const ConfigError&) {
  return std::nullopt;
}

/// What was recorded, or drives a simulation; without what is not there.
std::vector<FileHash> files_of(std::vector<FileHash> sources) {
  std::erase_if(sources, [](const FileHash& s) { return s.file == "configuration" || s.sha256.empty(); });
  return sources;
}

bool share_one(const std::vector<FileHash>& a, const std::vector<FileHash>& b) {
  return std::any_of(a.begin(), a.end(), [&](const FileHash& f) {
    return std::any_of(b.begin(), b.end(), [&](const FileHash& g) { return f.sha256 == g.sha256; });
  });
}

/// Recordings are the same by what they hold, whatever they are called; a simulation by its name. What cannot
/// be told is no other.
bool are_other(const Half& stored, const ReportedData& data) {
  const std::vector<FileHash> before = files_of(stored.sources), now = files_of(data.sources);
  if (stored.sources.empty() || (!data.simulated && now.empty())) return false;
  if (data.simulated && stored.name != data.name) return true;
  if (before.empty() && now.empty()) return false;
  return !share_one(before, now);
}

/// "rig, of train.csv", "rig, simulated"
std::string held_words(const Half& stored) {
  const std::vector<FileHash> files = files_of(stored.sources);
  return printable(stored.name, 100) +
         (files.empty() ? ", simulated" : ", of " + printable(files.front().file, 100));
}

}  // namespace

std::string why_not_together(const fs::path& folder, const char* result, const std::string& version,
                             const std::vector<FileHash>& sources) {
  if (!is_there(folder / result)) return "";
  std::string what;
  try {
    what = half_difference(read_half(folder / result), {"", version, sources});
  } catch (const ConfigError&) {
    what = "a file that cannot be read";
  }
  if (what.empty()) return "";
  const bool diagnosis = std::string_view(result) == "diagnosis.json";
  return std::string("The ") + (diagnosis ? "diagnosis" : "estimate") +
         " in this folder was dropped, as it was made from " + what + ".";
}

void require_same_data(const fs::path& folder, const ReportedData& data) {
  for (const char* result : {"result.json", "diagnosis.json"}) {
    const std::optional<Half> stored = readable_half(folder / result);
    if (stored && are_other(*stored, data))
      throw ConfigError(folder.string(),
                        fmt::format("holds the report of other data ({}), expected another folder for the "
                                    "new one (-o), or the old one removed first",
                                    held_words(*stored)));
  }
}

}  // namespace gapscope::internal::results
