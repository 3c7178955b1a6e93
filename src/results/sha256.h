#pragma once

#include <string>
#include <string_view>

namespace gapscope {

/// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// Of a file's bytes.  @throws ConfigError where it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace gapscope
