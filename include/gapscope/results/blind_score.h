#pragma once

#include <string>

#include "gapscope/blind/score.h"

namespace gapscope {

/// Writes blind.json into an existing folder.  @throws std::runtime_error naming what cannot be written.
void write_blind_score(const std::string& folder, const BlindScore& score);

/// Reads back exactly what was written.  @throws ConfigError for another schema or a damaged file.
BlindScore read_blind_score(const std::string& folder);

bool has_blind_score(const std::string& folder);

}  // namespace gapscope
