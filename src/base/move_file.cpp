#include "base/move_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

/// A name in the same folder; short, whatever the other one is.
std::string beside(const std::string& path, const char* begin) {
  std::random_device random;
  const std::string name = fmt::format("{}{}-{}", begin, random(), random());
  return (std::filesystem::path(path).parent_path() / name).string();
}

/// A file system that does not know this way of renaming.
bool is_unknown(int problem) { return problem == EINVAL || problem == ENOSYS; }

std::runtime_error cannot_replace(const std::string& path, int problem) {
  return std::runtime_error(path + ": cannot be replaced: " + std::strerror(problem));
}

/// The same for two names of one file, whatever it holds.
std::string inode_of(const std::string& path) {
  struct stat s {};
  return lstat(path.c_str(), &s) == 0 ? fmt::format("{} {}", s.st_dev, s.st_ino) : "";
}

/// Gives somebody else's file a name that shows; the one that it has where it can have no other.
std::string shown_beside(const std::string& from, const std::string& to) {
  try {
    const std::string name = beside(to, "came_meanwhile_");
    if (moved_where_nothing_is(from, name)) return name;
  } catch (const std::runtime_error&) {
  }
  return from;
}

[[noreturn]] void tell_where(const std::string& from, const std::string& to) {
  throw std::runtime_error(to + ": changed more than once meanwhile; what stood there is " +
                           shown_beside(from, to));
}

void put_back(const std::string& from, const std::string& to) {
  if (!moved_where_nothing_is(from, to)) tell_where(from, to);
}

/// By two names for a moment, as some file systems have it.
bool linked_where_nothing_is(const std::string& from, const std::string& to) {
  const std::string moved = inode_of(from);
  if (link(from.c_str(), to.c_str()) != 0) {
    if (errno == EEXIST) return false;
    throw cannot_replace(to, errno);
  }
  const std::string aside = name_beside(from);
  if (rename(from.c_str(), aside.c_str()) != 0) return true;  // somebody else took that name away
  if (const std::string inode = inode_of(aside); inode == moved || inode == inode_of(to))
    unlink(aside.c_str());
  else
    put_back(aside, from);
  return true;
}

void replace_by_moves(const std::string& found, const std::string& from, const std::string& to,
                      const ConfigError& changed) {
  const std::string aside = name_beside(to);
  if (!moved_if_still(found, to, aside)) throw changed;
  bool moved = false;
  try {
    moved = moved_where_nothing_is(from, to);
  } catch (const std::runtime_error&) {
    put_back(aside, to);
    throw;
  }
  unlink(aside.c_str());
  if (!moved) throw changed;
}

void replace(const std::string& found, const std::string& from, const std::string& to) {
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
  if (!exchange()) {
    if (errno == ENOENT) throw changed;
    if (!is_unknown(errno)) throw cannot_replace(to, errno);
    return replace_by_moves(found, from, to, changed);
  }
  if (content_identity(from) != found) {
    exchange();
    if (content_identity(from) == own) throw changed;
    tell_where(from, to);
  }
  unlink(from.c_str());
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

std::string name_beside(const std::string& path) { return beside(path, ".gapscope-"); }

bool moved_where_nothing_is(const std::string& from, const std::string& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
  if (!is_unknown(errno)) throw cannot_replace(to, errno);
  return linked_where_nothing_is(from, to);
}

bool moved_if_still(const std::string& found, const std::string& from, const std::string& to) {
  if (found.empty() || content_identity(from) != found || !moved_where_nothing_is(from, to)) return false;
  if (content_identity(to) == found) return true;
  put_back(to, from);
  return false;
}

bool remove_file(const std::string& found, const std::string& path) {
  const std::string aside = name_beside(path);
  return moved_if_still(found, path, aside) && unlink(aside.c_str()) == 0;
}

void replace_file(const std::string& found, const std::string& from, const std::string& to) {
  const std::string own = content_identity(from);
  try {
    replace(found, from, to);
  } catch (...) {
    if (content_identity(from) == own) unlink(from.c_str());
    throw;
  }
}

}  // namespace gapscope
