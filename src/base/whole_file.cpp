#include "gapscope/base/whole_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "base/at_once.h"
#include "base/interrupt.h"
#include "base/move_file.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLook{50};  ///< after which a request to stop is looked for again

std::runtime_error cannot_write(const std::string& name) {
  return std::runtime_error(name + ": cannot be written, expected a writable place with room for it");
}

/// Who may read and write the file that is there may read and write the new one. Where its owner cannot be
/// given the new one, the mode stays that of any new file.
void keep_mode(const std::string& before, const std::string& aside) {
  struct stat old = {}, fresh = {};
  if (lstat(before.c_str(), &old) != 0 || lstat(aside.c_str(), &fresh) != 0) return;
  constexpr mode_t kMode = 0777;
  const bool same_owner = old.st_uid == fresh.st_uid && old.st_gid == fresh.st_gid;
  if (!same_owner && chown(aside.c_str(), old.st_uid, old.st_gid) != 0) return;
  if (old.st_mode == fresh.st_mode) return;
  if (chmod(aside.c_str(), old.st_mode & kMode) != 0) throw cannot_write(before);
}

void write_aside(const std::string& aside, const std::string& path,
                 const std::function<void(std::ostream&)>& write) {
  std::ofstream out(aside, std::ios::binary);
  keep_mode(path, aside);
  if (out) write(out);
  out.close();
  if (!out) throw cannot_write(path);
}

/// Writes to an open handle, and closes it in the end.
class HandleBuffer : public std::streambuf {
 public:
  explicit HandleBuffer(int handle) : handle_(handle) {}
  ~HandleBuffer() override { close(handle_); }
  HandleBuffer(const HandleBuffer&) = delete;
  HandleBuffer& operator=(const HandleBuffer&) = delete;

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize size) override {
    std::streamsize done = 0;
    while (done < size) {
      const ssize_t n = ::write(handle_, bytes + done, static_cast<std::size_t>(size - done));
      if (n > 0) done += n;
      if (n >= 0 || errno == EINTR) continue;
      if (errno != EAGAIN) break;
      if (stop_requested()) break;
      pollfd reader{handle_, POLLOUT, 0};  // a pipe that does not block, and is full
      poll(&reader, 1, static_cast<int>(kLook.count()));
    }
    return done;
  }
  int overflow(int byte) override {
    const char c = static_cast<char>(byte);
    return xsputn(&c, 1) == 1 ? byte : traits_type::eof();
  }

 private:
  int handle_;
};

void write_handle(int handle, const std::string& name, const std::function<void(std::ostream&)>& write) {
  if (handle < 0) throw cannot_write(name);
  HandleBuffer buffer(handle);
  std::ostream out(&buffer);
  write(out);
  if (out) return;
  stop_point();
  throw cannot_write(name);
}

/// Of what the process has open anyway, under another name; below 0: the path is none.
int open_handle(std::string_view path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    const std::string_view number = path.substr(folder.size());
    int handle = -1;
    const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), handle);
    if (problem == std::errc() && end == number.data() + number.size()) return handle;
  }
  return -1;
}

/// Waits for a pipe's reader, as whoever writes to one does, but not beyond a request to stop.
int open_special(const std::string& path) {
  for (;;) {
    const int handle = open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (handle >= 0 || errno != ENXIO) return handle;
    stop_point();
    std::this_thread::sleep_for(kLook);
  }
}

/// A pipe or a device; a file that took its place meanwhile stays as it is.
void write_special(const std::string& path, const std::function<void(std::ostream&)>& write) {
  const int handle = open_special(path);
  struct stat s {};
  if (handle >= 0 && fstat(handle, &s) == 0 && S_ISREG(s.st_mode)) {
    close(handle);
    throw ConfigError(path, "came to be there meanwhile, expected the pipe or device that was there");
  }
  write_handle(handle, path, write);
}

}  // namespace

std::string new_file_beside(const std::string& path) {
  const std::string name = name_beside(path);
  const int handle = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (handle < 0) throw cannot_write(path);
  close(handle);
  return name;
}

void write_whole_file(const std::string& path, const std::function<void(std::ostream&)>& write,
                      Replaceable found) {
  if (const int handle = open_handle(path); handle >= 0)
    return write_handle(fcntl(handle, F_DUPFD_CLOEXEC, 0), path, write);
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (fs::exists(there) && !fs::is_regular_file(there)) return write_special(path, write);
  if (fs::is_symlink(fs::symlink_status(path, problem)))
    throw ConfigError(path, "is a link to another file, expected the name of the file itself");
  if (!found) found = content_identity(path);
  const std::string aside = new_file_beside(path);
  const Unfinished unfinished([&] { return unlink(aside.c_str()) == 0 || errno == ENOENT; });
  try {
    write_aside(aside, path, write);
  } catch (...) {
    unlink(aside.c_str());
    throw;
  }
  const Moment moment;
  replace_file(*found, aside, path);
}

}  // namespace gapscope
