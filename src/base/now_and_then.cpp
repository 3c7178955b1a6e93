#include "base/now_and_then.h"

#include <utility>

namespace gapscope {

NowAndThen::NowAndThen(std::chrono::milliseconds every, Tell tell)
    : thread_([this, every, tell = std::move(tell)] { work(every, tell); }) {}

NowAndThen::~NowAndThen() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  over_.notify_one();
  thread_.join();
}

void NowAndThen::begins(const std::string& what) {
  const std::lock_guard lock(mutex_);
  what_ = what;
}

void NowAndThen::work(std::chrono::milliseconds every, const Tell& tell) {
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, every, [this] { return ends_; }))
    if (!what_.empty()) tell(what_);
}

}  // namespace gapscope
