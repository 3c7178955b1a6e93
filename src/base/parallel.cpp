#include "base/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/require.h"

namespace gapscope {
namespace {

namespace tbb = oneapi::tbb;

using Work = std::function<void(std::size_t)>;

#ifdef __SANITIZE_THREAD__

/// ThreadSanitizer does not see how TBB, which is not compiled with it, hands work from thread to thread.
void share_out(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr problem;
  const auto serve = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!problem) problem = std::current_exception();
    }
  };
  std::vector<std::thread> helpers;
  for (int k = 1; k < threads; ++k) helpers.emplace_back(serve);
  serve();
  for (std::thread& helper : helpers) helper.join();
  if (problem) std::rethrow_exception(problem);
}

#else

void share_out(std::size_t count, int threads, const Work& work) {
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& part) {
          for (std::size_t i = part.begin(); i != part.end(); ++i) work(i);
        },
        tbb::simple_partitioner());
  });
}

#endif

}  // namespace

int thread_count(int threads) {
  GAPSCOPE_REQUIRE(threads >= 0);
  return threads > 0 ? threads : tbb::info::default_concurrency();
}

void parallel_for(std::size_t count, int threads, const Work& work) {
  if (thread_count(threads) > 1) return share_out(count, thread_count(threads), work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

}  // namespace gapscope
