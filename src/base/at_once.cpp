#include "base/at_once.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace gapscope {
namespace {

std::recursive_mutex& moments() {
  static auto* const mutex = new std::recursive_mutex;  // held while the process ends
  return *mutex;
}

std::vector<Unfinished*>& unfinished() {
  static auto* const all = new std::vector<Unfinished*>;
  return *all;
}

}  // namespace

Unfinished::Unfinished(std::function<bool()> remove) : remove_(std::move(remove)) {
  const Moment moment;
  unfinished().push_back(this);
}

Unfinished::~Unfinished() {
  const Moment moment;
  std::erase(unfinished(), this);
}

Moment::Moment() : lock_(moments()) {}

void end_at_once(int status) {
  constexpr int kAttempts = 20;  // an owner may write once more what is just being removed
  constexpr std::chrono::milliseconds kPause{5};
  const Moment last;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto is_gone = [](const Unfinished* one) { return one->remove_(); };
    std::erase_if(unfinished(), is_gone);
    if (unfinished().empty()) break;
    std::this_thread::sleep_for(kPause);
  }
  _exit(status);
}

}  // namespace gapscope
