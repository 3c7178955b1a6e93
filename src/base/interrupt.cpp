#include "gapscope/base/interrupt.h"

#include <atomic>

#include "gapscope/base/errors.h"

namespace gapscope {
namespace {
std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);
}  // namespace

void request_stop() noexcept { stop.store(true, std::memory_order_relaxed); }
bool stop_requested() noexcept { return stop.load(std::memory_order_relaxed); }
void clear_stop_request() noexcept { stop.store(false, std::memory_order_relaxed); }

void stop_point() {
  if (stop_requested()) throw Interrupted();
}

}  // namespace gapscope
