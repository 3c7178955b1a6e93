#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace gapscope::testing {

/// Keeps every JSON document (*.json, *.jsonl) below a folder until the test program ends. Then all that was
/// kept is judged at once: by the schemas of docs/schemas, and each result for its version and its
/// configuration with the right SHA-256. Without a validator nothing is judged.
/// @param except  paths relative to the folder that no command wrote
void keep_written_json(const std::filesystem::path& folder, const std::set<std::string>& except);

/// The same of what a command printed, where it is a document.
void keep_printed_json(const std::string& text);

}  // namespace gapscope::testing
