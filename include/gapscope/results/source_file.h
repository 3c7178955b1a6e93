#pragma once

#include <string>
#include <vector>

namespace gapscope {

/// What a result was made from, so that two results can be told to be of one drive.
struct SourceFile {
  std::string file;    ///< name of a recording; "configuration"
  std::string sha256;  ///< empty: it could not be read
  bool operator==(const SourceFile&) const = default;
};

}  // namespace gapscope
