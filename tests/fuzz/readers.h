#pragma once

#include <string_view>

namespace gapscope::testing {

/// Each gives the bytes to the readers of one kind of file, as the files that they open. They are taken, or
/// refused by a ConfigError that says what was expected; anything else is another exception or
/// the end of the program.  @returns how many of the readers took them
int read_recording(std::string_view bytes);      ///< CSV: whole, resampled, as a stream
int read_mat(std::string_view bytes);            ///< .mat, version 4, 5 or 7.3
int read_arrays(std::string_view bytes);         ///< .npz and HDF5
int read_logs(std::string_view bytes);           ///< MCAP, a bag of ROS 2, JSON
int read_configuration(std::string_view bytes);  ///< YAML: a configuration, a campaign, a blind check
int read_result(std::string_view bytes);         ///< JSON of every schema, a trace, a map, a line of answers
int read_stream(std::string_view bytes);         ///< a motion, changed, sample by sample through the detector
int read_store(std::string_view bytes);          ///< SQLite, or the cells of a store, a line each

}  // namespace gapscope::testing
