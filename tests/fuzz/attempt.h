#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gapscope/base/errors.h"
#include "results/scratch_folder.h"

namespace gapscope::testing {

/// A file in a folder of its own, filled anew for every input.
class GivenFile {
 public:
  explicit GivenFile(const std::string& name) : path_((folder_.path / name).string()) {
    std::filesystem::create_directories(std::filesystem::path(path_).parent_path());
  }
  const std::string& path() const { return path_; }
  std::string folder() const { return folder_.path.string(); }
  void fill(std::string_view bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

 private:
  ScratchFolder folder_;
  std::string path_;
};

inline void require(bool truth, const std::string& what) {
  if (!truth) throw std::logic_error(what);
}

/// What users see when an input is refused: of a length that they read. (Control characters in it are shown
/// as
/// '?' by the command.)
inline void require_helpful(const std::string& message) {
  require(message.size() < 1500 && message.find(", expected ") != message.npos,
          "no message that helps: " + message);
}

/// @returns 1 if the reader took its input, else 0
template <class Action>
int attempt(Action action) {
  try {
    action();
    return 1;
  } catch (const ConfigError& refusal) {
    require_helpful(refusal.what());
    return 0;
  }
}

}  // namespace gapscope::testing
