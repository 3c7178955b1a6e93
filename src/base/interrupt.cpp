#include "base/interrupt.h"

#include <atomic>

#include "base/cut_short.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {
std::atomic<bool> stop{false}, finish{false}, finish_first{false};
std::atomic<int> cut_short{0};  ///< how many of these live
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
}  // namespace

void request_stop() noexcept { stop.store(true, std::memory_order_relaxed); }
bool stop_requested() noexcept { return stop.load(std::memory_order_relaxed); }
void clear_stop_request() noexcept { stop.store(false, std::memory_order_relaxed); }

void request_finish() noexcept { finish.store(true, std::memory_order_relaxed); }
bool finish_requested() noexcept { return finish.load(std::memory_order_relaxed); }

FinishFirst::FinishFirst() noexcept { finish_first.store(true, std::memory_order_relaxed); }
FinishFirst::~FinishFirst() {
  finish_first.store(false, std::memory_order_relaxed);
  finish.store(false, std::memory_order_relaxed);
}
bool may_finish_first() noexcept {
  return finish_first.load(std::memory_order_relaxed) && !finish_requested();
}

CutShort::CutShort() noexcept { cut_short.fetch_add(1, std::memory_order_relaxed); }
CutShort::~CutShort() { cut_short.fetch_sub(1, std::memory_order_relaxed); }

bool is_to_end() noexcept {
  return stop_requested() || (finish_requested() && cut_short.load(std::memory_order_relaxed) > 0);
}

void stop_point() {
  if (is_to_end()) throw Interrupted();
}

}  // namespace gapscope
