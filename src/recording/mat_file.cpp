#include "recording/mat_file.h"

#include <array>

#include "gapscope/base/errors.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

/// Version 5 says so in the last four bytes of its header.
bool is_version_5(const std::string& path) {
  std::array<char, 128> header{};
  open_recording_file(path).read(header.data(), header.size());
  const std::string end(header.end() - 4, header.end());
  return end == std::string("\x00\x01IM", 4) || end == std::string("\x01\x00MI", 4);
}

}  // namespace

std::unique_ptr<ArrayFile> open_mat(const std::string& path) {
  auto content = is_version_5(path) ? open_version_5(path) : open_by_matio(path);
  if (content) return content;
  throw ConfigError(path,
                    "is no .mat file that can be read, expected MATLAB's format, version 4, 5 or 7.3, whole");
}

}  // namespace gapscope::internal::recording
