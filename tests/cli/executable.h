#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "cli/written_json.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope::testing {

/// What a command left: exit status and both streams.
struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

/// All stored files but those with wall times.
inline std::string stored(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (entry.is_regular_file() && name != "timing.json" && name != "results.sqlite")
      files.insert(entry.path());
  }
  std::string all;
  for (const auto& file : files) all += file.lexically_relative(folder).string() + "\n" + text_of(file);
  return all;
}

/// A folder with files, in which the real executable is run. What that leaves of JSON is judged in the end.
class Workplace {
 public:
  Workplace() : place_("", "mark") { std::filesystem::remove(place_.path()); }
  ~Workplace() { keep_written_json(folder(), own_); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  void file(const std::string& name, const std::string& text) {
    own_.insert(name);
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
    keep_printed_json(text_of(out));
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
  std::set<std::string> own_;  ///< files of the test itself
};

/// All effects but these, as options: a diagnosis in a second or two.
inline std::string excluding_all_but(const std::set<std::string>& kept) {
  std::istringstream names(Workplace().run("effects").out);
  std::string options;
  for (std::string name; std::getline(names, name);)
    if (!kept.contains(name)) options += " --exclude " + name;
  return options;
}

}  // namespace gapscope::testing
