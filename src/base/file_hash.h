#pragma once

#include <string>

namespace gapscope {

/// A file and what it holds, so that two can be told to be the same.
struct FileHash {
  std::string file;    ///< its name, as whoever lists it knows it
  std::string sha256;  ///< 64 lower-case hexadecimal digits; empty: not known, or not to be held against
  bool operator==(const FileHash&) const = default;
};

}  // namespace gapscope
