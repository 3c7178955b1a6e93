#include "gapscope/base/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "gapscope/base/errors.h"
#include "gapscope/base/move_file.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path &path, const std::string &name,
                const std::function<void(std::ostream &)> &write) {
  std::ofstream out(path, std::ios::binary);
  if (out)
    write(out);
  out.close();
  if (!out)
    throw std::runtime_error(
        name +
        ": cannot be written, expected a writable place with room for it");
}

/// Another name of what the process writes to anyway, whatever that is.
bool is_stream(const std::string &path) {
  const std::string_view name = path;
  return name == "/dev/stdout" || name == "/dev/stderr" ||
         name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

} // namespace

std::string new_file_beside(const std::string &path) {
  const std::string name = name_beside(path);
  const int handle = open(
      name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (handle < 0)
    throw std::runtime_error(
        path +
        ": cannot be written, expected a writable place with room for it");
  close(handle);
  return name;
}

void write_whole_file(const std::string &path,
                      const std::function<void(std::ostream &)> &write,
                      Replaceable found) {
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (is_stream(path) || (fs::exists(there) && !fs::is_regular_file(there)))
    return write_file(path, path, write);
  if (fs::is_symlink(fs::symlink_status(path, problem)))
    throw ConfigError(
        path,
        "is a link to another file, expected the name of the file itself");
  if (!found)
    found = content_identity(path);
  const std::string aside = new_file_beside(path);
  try {
    write_file(aside, path, write);
  } catch (...) {
    fs::remove(aside, problem);
    throw;
  }
  replace_file(*found, aside, path);
}

} // namespace gapscope
