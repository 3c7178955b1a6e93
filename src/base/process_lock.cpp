#include "base/process_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace gapscope {

ProcessLock::ProcessLock(const std::string& path)
    : handle_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (handle_ >= 0) held_by_another_ = flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

ProcessLock::~ProcessLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace gapscope
