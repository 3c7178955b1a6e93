#pragma once

#include <string>
#include <vector>

#include "commands/text_files.h"
#include "exports/export.h"
#include "results/report_folder.h"

namespace gapscope {

/// The configuration that is exported: of a report folder its fitted.yaml, else the file itself.
/// @throws ConfigError for a folder without one
std::string exported_configuration(const std::string& source);

/// @throws ConfigError for a word that no format has
ExportFormat export_format(const std::string& word);

/// What the diagnosis in the folder of the exported model found missing and did not explain, in torque and
/// per cent of the input's, on what was held out; without a diagnosis, that the fit there is rejected, and
/// why. Empty: neither is the case.
/// @param source  as exported_configuration() takes it
std::string left_unexplained(const std::string& source);

/// Says it where the eye falls first: in the head of every file that can have a comment, in the certificate.
void tell_in_head(const std::string& sentence, DriveExport& drive);

/// The model, certificate.md and certificate.json.
std::vector<TextFile> export_texts(const DriveExport& drive);

/// Writes these and commits.  @throws Interrupted, std::runtime_error for what cannot be written
void write_export(ReportFolder& report, const DriveExport& drive);

}  // namespace gapscope
