#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gapscope::cli {

// Each adds one sub-command with its options, help and action.
void add_run(CLI::App& app);
void add_detect(CLI::App& app);
void add_fit(CLI::App& app);
void add_simulate(CLI::App& app);
void add_report(CLI::App& app);
void add_effects(CLI::App& app);
void add_blind(CLI::App& app);
void add_blind_drives(CLI::App& blind);
void add_campaign(CLI::App& app);
void add_diagnose(CLI::App& app);

/// What stands in the help of every command that takes a configuration.
inline constexpr const char* kConfigHelp = "configuration (YAML)";

/// @throws std::runtime_error naming what cannot be written
void write_text(const std::string& path, const std::string& text);

/// @throws ConfigError if something other than a folder has this name already, or it is no name
void require_folder_name(const std::string& folder);

}  // namespace gapscope::cli
