#include "cli/heartbeat.h"

#include <pthread.h>

#include <csignal>

namespace gapscope::cli {

Heartbeat::Heartbeat(std::chrono::milliseconds every, Tell tell) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // which a thread takes over from who begins it
  thread_ = std::thread([this, every, tell = std::move(tell)] { beat(every, tell); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Heartbeat::doing(const std::string& what) {
  const std::lock_guard lock(mutex_);
  doing_ = what;
}

void Heartbeat::beat(std::chrono::milliseconds every, const Tell& tell) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  std::unique_lock lock(mutex_);
  for (auto next = begin + every; !ended_.wait_until(lock, next, [this] { return ends_; }); next += every) {
    const std::string what = doing_;
    lock.unlock();
    if (!what.empty()) tell(Clock::now() - begin, what);
    lock.lock();
  }
}

}  // namespace gapscope::cli
