// The options of the commands that are given a recording itself, before there is a configuration.
#include <filesystem>

#include "cli/commands.h"
#include "gapscope/base/errors.h"

namespace gapscope::cli {

CsvOptions RecordingArguments::options() const {
  CsvOptions o;
  o.columns.time = time;
  o.columns.input = input;
  o.columns.position = position;
  if (!window.empty()) o.window = {window[0], window[1]};
  if (o.window && !(o.window->first < o.window->second))
    throw ConfigError("gapscope: --window goes backwards, expected FROM before TO [s]");
  if (resample > 0.0) o.resample_rate = resample;
  return o;
}

void add_recording_arguments(CLI::App& command, RecordingArguments& a) {
  command.add_option("FILE", a.file, "recording (CSV)")->required();
  command.add_option("--time", a.time, "column of the time [s] (default: t)")->type_name("NAME");
  command.add_option("--input", a.input, "column of the input (default: u)")->type_name("NAME");
  command.add_option("--position", a.position, "column of the position (default: x1)")->type_name("NAME");
  command.add_option("--window", a.window, "part of the file that is used [s]")
      ->type_name("FROM TO")
      ->expected(2);
  command.add_option("--resample", a.resample, "rate that it is brought to [Hz]")
      ->type_name("RATE")
      ->check(CLI::Range(1e-3, 1e7));
  command.add_flag("--translation", a.translation, "positions in m and forces in N instead of rad and N m");
}

void require_file_name(const std::string& file, const std::string& source) {
  namespace fs = std::filesystem;
  if (fs::is_directory(file)) throw ConfigError(file, "is a folder, expected the name of a file to write");
  if (fs::exists(file) && fs::exists(source) && fs::equivalent(file, source))
    throw ConfigError(file, "is the input itself, expected another file to write");
  const fs::path parent = fs::path(file).parent_path();
  if (!parent.empty() && !fs::is_directory(parent))
    throw ConfigError(file, "cannot be written there, expected a folder that exists");
}

}  // namespace gapscope::cli
