#pragma once

#include <span>
#include <string>
#include <vector>

#include "gapscope/results/certificate.h"

namespace gapscope {

enum class ExportFormat { kMjcf, kC, kSdf, kUrdf, kIsaac, kBam };

/// The word by which a format is asked for, and one line of what it is.
struct ExportFormatSpec {
  ExportFormat format;
  const char* name;
  const char* doc;
};
std::span<const ExportFormatSpec> export_formats();

struct ExportedFile {
  std::string name;
  std::string text;
};

/// A drive in the format of a simulator, with what that format can say of it.
struct DriveExport {
  std::vector<ExportedFile> files;
  Certificate certificate;
};

/// The drive of a configuration file as a simulator takes it: of `simulation:` the plant under its excitation
/// (fitted.yaml of a report), of `recording:` the model under the recorded input.
/// @throws ConfigError where a number of the model is not known, or a file cannot be read; Interrupted
DriveExport export_drive(const std::string& configuration_file, ExportFormat format);

}  // namespace gapscope
