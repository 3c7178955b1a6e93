#pragma once

#include <string>

#include "gapscope/base/whole_file.h"
#include "results/blind_records.h"

/// The files of a blind check. Each writer throws std::runtime_error naming what cannot be written, each
/// reader ConfigError for another schema or a damaged file. What may be replaced is told by `found`
/// (write_whole_file()).
namespace gapscope {

void write_blind_labels(const std::string& path, const BlindLabels& labels, const Replaceable& found = {});
BlindLabels read_blind_labels(const std::string& path);

void write_blind_manifest(const std::string& path, const BlindManifest& manifest,
                          const Replaceable& found = {});
BlindManifest read_blind_manifest(const std::string& path);

/// A manifest and what it is known by, of one reading.
struct ReadManifest {
  BlindManifest manifest;
  std::string sha256;  ///< of the file
};
ReadManifest read_manifest_once(const std::string& path);

void write_blind_answers(const std::string& path, const BlindAnswers& answers, const Replaceable& found = {});
BlindAnswers read_blind_answers(const std::string& path);

/// Whether a file is a blind check's own: labels of that name and configuration, answers to that manifest.
/// False for anything else.
bool is_labels_file(const std::string& path, const std::string& name, const std::string& configuration);
bool is_answers_file(const std::string& path, const std::string& manifest_sha256);
bool is_manifest_file(const std::string& path);

// Each as one line of JSON, without the newline.
std::string line_of(const BlindAnswer& answer);     ///< without its seal
std::string head_line_of(const BlindAnswers& all);  ///< name, version, manifest
std::string line_of(const BlindLabel& label);
std::string head_line_of(const BlindLabels& all);  ///< name, configuration, salts
/// @throws ConfigError naming the file where the line is no answer.
BlindAnswer blind_answer_of(const std::string& line, const std::string& file);

}  // namespace gapscope
