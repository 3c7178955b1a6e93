#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file_hash.h"

namespace gapscope::internal::results {

inline constexpr const char* kFileList = "files.json";

/// What gapscope wrote into a folder, and so may replace or remove there; nothing else.
struct FileList {
  std::string version;          ///< of gapscope
  std::string kind;             ///< of report: "drive", "campaign", ...
  std::string dropped;          ///< what an earlier report had that does not go with this one; empty: nothing
  std::vector<FileHash> files;  ///< below the folder; without a hash where the content varies

  bool holds(const std::string& file) const;
  /// Whether a file of the folder is as gapscope wrote it: in the list, no link, of that content.
  bool wrote(const std::filesystem::path& folder, const std::string& file) const;
};

/// Nothing where there is none.  @throws ConfigError for one that gapscope did not write
std::optional<FileList> read_file_list(const std::filesystem::path& folder);
void write_file_list(const std::filesystem::path& folder, const FileList& list);

}  // namespace gapscope::internal::results
