#pragma once

#include <fstream>
#include <string>

namespace gapscope {

// Every file that is read is opened here. A pipe or a device would let the program wait for whoever writes to
// it, or read without end, and has other bytes when it is read again.

/// @param expected  "a recording as CSV"
/// @throws ConfigError where nothing is there, or no regular file
void require_input_file(const std::string& path, const std::string& expected);

/// @throws ConfigError as above, or where it may not be read; MachineError where that is no fault of the file
std::ifstream open_input_file(const std::string& path, const std::string& expected);

/// For those who only look whether there is something of theirs: not open where open_input_file() would
/// throw.
std::ifstream try_input_file(const std::string& path);

}  // namespace gapscope
