#pragma once

#include <memory>
#include <string>

#include "gapscope/recording/recording_file.h"
#include "recording/array_file.h"

namespace gapscope::internal::recording {

/// What a recording is stored as; its name says it.
struct FileKind {
  std::string ending;  ///< of the name, in lower case: ".npz"
  const char* called;  ///< in messages
  /// How to open it; none: a CSV, or what is not read.
  std::unique_ptr<ArrayFile> (*open)(const std::string& path, const RecordingColumns& columns) = nullptr;
  const char* convert = nullptr;  ///< of a kind that is not read: how to make one of it that is
};

/// By the ending of the name; every one that is not known is a CSV.
const FileKind& kind_of(const std::string& path);

/// Opens one that is no CSV.  @throws ConfigError for a kind that is not read, with what to do, and as
/// open_*()
std::unique_ptr<ArrayFile> open_arrays(const std::string& path, const RecordingColumns& columns);

}  // namespace gapscope::internal::recording
