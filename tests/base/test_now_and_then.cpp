#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "base/now_and_then.h"

namespace gapscope {
namespace {

TEST(NowAndThen, SaysTheLatestStepUntilItIsGone) {
  std::atomic<int> first = 0, second = 0;
  {
    NowAndThen told(std::chrono::milliseconds(1),
                    [&](const std::string& what) { (what == "first" ? first : second)++; });
    told.begins("first");
    while (first < 2) std::this_thread::yield();
    told.begins("second");
    while (second < 1) std::this_thread::yield();
  }
  const int so_far = first + second;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(first + second, so_far);
}

TEST(NowAndThen, OfWorkThatIsSoonOverNothingIsSaid) {
  bool said = false;
  {
    NowAndThen told(std::chrono::hours(1), [&](const std::string&) { said = true; });
    told.begins("short work");
  }
  EXPECT_FALSE(said);
}

}  // namespace
}  // namespace gapscope
