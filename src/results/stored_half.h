#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/report_folder.h"

/// The halves of a drive's report, result.json and diagnosis.json: what each was made from.
namespace gapscope::internal::results {

/// Why what is stored under a name is not of these sources; empty where it is, or is not there.
std::string why_not_together(const std::filesystem::path& folder, const char* result,
                             const std::string& version, const std::vector<FileHash>& sources);

/// @throws ConfigError where a half that is stored there is of other data: it would be lost
void require_same_data(const std::filesystem::path& folder, const ReportedData& data);

}  // namespace gapscope::internal::results
