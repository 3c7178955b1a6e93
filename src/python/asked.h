#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/configuration.h"

namespace gapscope::internal::python {

/// A column of a recording that is given as arrays.
struct GivenColumn {
  std::string key;  ///< of recording: columns: "time", "input", "position", ...
  std::span<const double> values;
};

/// A recording that is given as arrays; it stands in the place of a file of this name.
struct GivenRecording {
  std::string name;
  std::vector<GivenColumn> columns;
};

/// What a configuration is made from.
struct Asked {
  std::string text;  ///< YAML; empty: that of the file
  std::string file;  ///< names it in messages; paths in it are relative to its folder
  std::vector<Setting> settings = {};
  std::vector<GivenRecording> recordings = {}, held_out = {}, simulated = {};
  std::string folder = {};  ///< for recordings that are given as arrays
  std::string axis = {};    ///< of a machine with several; empty: it has one
};

/// What is laid over the configuration, with which it names the arrays as its recordings.
std::vector<Setting> settings_of(const Asked& asked);

/// Reads the configuration and writes what is given as arrays where it will be read: a CSV with the columns
/// that the configuration names, numbers at their shortest.
/// @throws ConfigError as load_configuration() does; std::runtime_error where the folder cannot be written
Configuration configuration_of(const Asked& asked);

}  // namespace gapscope::internal::python
