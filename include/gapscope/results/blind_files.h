#pragma once

#include <string>

#include "gapscope/blind/records.h"

/// The files of a blind check. Each writer throws std::runtime_error naming what cannot be written, each
/// reader ConfigError for another schema or a damaged file.
namespace gapscope {

void write_blind_labels(const std::string& path, const BlindLabels& labels);
BlindLabels read_blind_labels(const std::string& path);

void write_blind_manifest(const std::string& path, const BlindManifest& manifest);
BlindManifest read_blind_manifest(const std::string& path);

}  // namespace gapscope
