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

void write_blind_answers(const std::string& path, const BlindAnswers& answers);
BlindAnswers read_blind_answers(const std::string& path);

/// One answer as one line of JSON, without its seal and the newline.
std::string line_of(const BlindAnswer& answer);
/// @throws ConfigError naming the file where the line is no answer.
BlindAnswer blind_answer_of(const std::string& line, const std::string& file);

}  // namespace gapscope
