#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "results/report_folder.h"
#include "support/reading.h"

namespace gapscope::test {

using Names = std::set<std::string>;

inline void put(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

inline Names files_in(const std::filesystem::path& folder) {
  Names names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

inline void write(const std::filesystem::path& target, const Names& names, const std::string& text,
                  FolderKind kind = FolderKind::kDrive) {
  ReportFolder folder(target.string(), kind);
  for (const std::string& name : names) put(std::filesystem::path(folder.path()) / name, text);
  folder.commit();
}

inline std::string refused(const std::filesystem::path& target, FolderKind kind = FolderKind::kDrive,
                           const std::vector<std::string>& inputs = {}) {
  return testing::refusal([&] { ReportFolder folder(target.string(), kind, inputs); });
}

}  // namespace gapscope::test
