#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace gapscope {
namespace {

TEST(Parallel, EveryPieceIsDoneOnceForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> done(1000);
    parallel_for(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
}

TEST(Parallel, NoMoreThreadsWorkThanWereAskedFor) {
  std::mutex mutex;
  std::set<std::thread::id> workers;
  parallel_for(200, 3, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    workers.insert(std::this_thread::get_id());
  });
  EXPECT_LE(workers.size(), 3u);
}

TEST(Parallel, AnExceptionOfAPieceComesBackToTheCaller) {
  for (const int threads : {1, 4})
    EXPECT_THROW(parallel_for(100, threads,
                              [](std::size_t i) {
                                if (i == 17) throw std::runtime_error("17");
                              }),
                 std::runtime_error);
}

TEST(Parallel, NothingToDoIsDone) {
  EXPECT_NO_THROW(parallel_for(0, 2, [](std::size_t) { FAIL(); }));
}

}  // namespace
}  // namespace gapscope
