#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/file_list.h"

namespace gapscope::internal::results {

/// Moves fresh files over and stale ones away; results go first and come last, so that none is ever found
/// beside traces of another. What cannot be done is undone: the folder is then as it was.
/// @param aside  a folder of the same file system for what is replaced
/// @param before  what gapscope wrote there earlier; null: nothing
/// @throws std::runtime_error, ConfigError where something came or changed meanwhile
void replace_files(const std::filesystem::path& from, const std::filesystem::path& to,
                   const std::vector<std::string>& fresh, const std::vector<std::string>& stale,
                   const std::filesystem::path& aside, bool (*is_result)(const std::string&),
                   const FileList* before);

}  // namespace gapscope::internal::results
