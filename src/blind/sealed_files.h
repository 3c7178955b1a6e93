#pragma once

#include <string>

#include "results/blind_records.h"

namespace gapscope::blind {

/// @throws ConfigError naming `file` unless a check's name can be that of a folder.
void require_plain_name(const std::string& name, const std::string& file);

/// @throws ConfigError naming `file` unless a path that it gives stays in the folder that is handed out.
void require_inside(const std::string& path, const std::string& file);

/// @param found  SHA-256 of what is at `path`  @throws ConfigError unless it is what was sealed of that case
void verify_file(const std::string& path, const std::string& found, const std::string& name,
                 const FileHash& sealed);

}  // namespace gapscope::blind
