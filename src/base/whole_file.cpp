#include "gapscope/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string_view>

#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& name,
                const std::function<void(std::ostream&)>& write) {
  std::ofstream out(path, std::ios::binary);
  if (out) write(out);
  out.close();
  if (!out)
    throw std::runtime_error(name + ": cannot be written, expected a writable place with room for it");
}

/// Another name of what the process writes to anyway, whatever that is.
bool is_stream(const std::string& path) {
  const std::string_view name = path;
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/self/fd/");
}

/// Gives a file that came in the place of ours a name that shows.
std::string kept_beside(const std::string& from, const std::string& to) {
  constexpr int kMost = 100;
  for (int number = 1; number <= kMost; ++number) {
    const std::string name = fmt::format("{}.meanwhile{}", to, number);
    if (moved_where_nothing_is(from, name)) return name;
  }
  return from;
}

}  // namespace

std::string identity_of(const std::string& path) {
  struct stat s {};
  if (stat(path.c_str(), &s) != 0) return "";
  return fmt::format("{} {} {} {}.{} {}.{}", s.st_dev, s.st_ino, s.st_size, s.st_mtim.tv_sec,
                     s.st_mtim.tv_nsec, s.st_ctim.tv_sec, s.st_ctim.tv_nsec);
}

std::string content_identity(const std::string& path) {
  struct stat s {};
  if (lstat(path.c_str(), &s) != 0) return "";
  return fmt::format("{} {} {} {}.{}", s.st_dev, s.st_ino, s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec);
}

void replace_file(const std::string& found, const std::string& from, const std::string& to) {
  const ConfigError changed(to, found.empty() ? "came to be there meanwhile, expected that it stays free"
                                              : "changed meanwhile, expected it as it was");
  if (content_identity(to) != found) throw changed;
  if (found.empty()) {
    if (!moved_where_nothing_is(from, to)) throw changed;
    return;
  }
  const std::string own = content_identity(from);
  const auto exchange = [&] {
    return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0;
  };
  if (!exchange()) {  // a file system that cannot: the last look was a moment ago
    std::error_code problem;
    fs::rename(from, to, problem);
    if (problem) throw std::runtime_error(to + ": cannot be written: " + problem.message());
    return;
  }
  if (content_identity(from) != found) {
    exchange();
    if (content_identity(from) == own) throw changed;
    throw std::runtime_error(to + ": changed more than once meanwhile; what stood there last is " +
                             kept_beside(from, to));
  }
  unlink(from.c_str());
}

bool moved_where_nothing_is(const std::string& from, const std::string& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
  const auto fail = [&]() -> std::runtime_error {
    return std::runtime_error(to + ": cannot be replaced: " + std::strerror(errno));
  };
  if (errno != EINVAL && errno != ENOSYS) throw fail();
  if (link(from.c_str(), to.c_str()) != 0) {  // a file system that does not know the other way
    if (errno == EEXIST) return false;
    throw fail();
  }
  unlink(from.c_str());
  return true;
}

std::string new_file_beside(const std::string& path) {
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const std::string name = ".gapscope-" + std::to_string(random()) + "-" + std::to_string(random());
    const fs::path file = fs::path(path).parent_path() / name;
    const int handle = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (handle >= 0) return close(handle), file.string();
    if (errno != EEXIST) break;
  }
  throw std::runtime_error(path + ": cannot be written, expected a writable place with room for it");
}

void write_whole_file(const std::string& path, const std::function<void(std::ostream&)>& write,
                      Replaceable found) {
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (is_stream(path) || (fs::exists(there) && !fs::is_regular_file(there)))
    return write_file(path, path, write);
  if (fs::is_symlink(fs::symlink_status(path, problem)))
    throw ConfigError(path, "is a link to another file, expected the name of the file itself");
  if (!found) found = content_identity(path);
  const fs::path aside = new_file_beside(path);
  try {
    write_file(aside, path, write);
    replace_file(*found, aside, path);
  } catch (...) {
    fs::remove(aside, problem);
    throw;
  }
}

}  // namespace gapscope
