#pragma once

#include <span>

#include "config/configuration.h"
#include "config/schema_parts.h"
#include "config/yaml_value.h"
#include "config/yaml_writer.h"

namespace gapscope::internal::config {

inline constexpr Range kWindow = {-kInfinity, kInfinity, "s"};

/// A file, or a list whose items are a file or {file, window, mass, arm, gain, voltage}: what is known of
/// that recording alone.
/// @param before  files that are named above; none may come again, but for another window
std::vector<RecordedFile> read_files(const Value& value, const std::string& folder,
                                     std::span<const RecordedFile> before);

/// Files of which nothing but the name can be known.
std::vector<RecordedFile> read_simulated_files(const Value& value, const std::string& folder);

/// Takes what the files themselves have of these facts, where `columns:` names it and the list does not. A
/// file that is not there is left to whoever reads it.
void read_facts_of_files(RecordingConfig& recording);

/// Gives each recording the load that it has beyond that of `anchor:`. Without one the first recording's mass
/// and arm are the anchor's.
/// @throws ConfigError where a recording has a mass or an arm and not both, here or there
void settle_loads(Configuration& configuration);

void write_files(YamlWriter& out, const char* key, std::span<const RecordedFile> files);

Json recorded_files_schema(const std::string& doc);

}  // namespace gapscope::internal::config
