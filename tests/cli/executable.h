#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope::testing {

/// What a command left: exit status and both streams.
struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

/// A folder with files, in which the real executable is run.
class Workplace {
 public:
  Workplace() : place_("", "mark") { std::filesystem::remove(place_.path()); }

  void file(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name, std::ios::binary) << text;
  }

  /// @param arguments  as one would type them
  Outcome run(const std::string& arguments, const std::string& before = "") const {
    const TemporaryFile streams("");
    const auto out = streams.folder() / "out", err = streams.folder() / "err";
    const std::string command = "cd " + folder().string() + " && " + before + " " + GAPSCOPE_EXECUTABLE +
                                " " + arguments + " >" + out.string() + " 2>" + err.string() + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
  }

  /// Every path below the folder.
  std::set<std::string> content() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder()))
      all.insert(std::filesystem::relative(entry.path(), folder()).string());
    return all;
  }

  const std::filesystem::path& folder() const { return place_.folder(); }

 private:
  TemporaryFile place_;
};

}  // namespace gapscope::testing
