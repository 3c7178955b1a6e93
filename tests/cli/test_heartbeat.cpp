// What long work says where nobody looks.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/heartbeat.h"

namespace gapscope {
namespace {

using namespace std::chrono_literals;

struct Told {
  double seconds;
  std::string what;
};

/// What is told of work that begins and ends at these times.
std::vector<Told> told(std::chrono::milliseconds every, std::chrono::milliseconds first,
                       std::chrono::milliseconds second) {
  std::vector<Told> all;
  {
    cli::Heartbeat heartbeat(every, [&](auto so_far, const std::string& what) {
      all.push_back({so_far.count(), what});
    });
    heartbeat.doing("first");
    std::this_thread::sleep_for(first);
    heartbeat.doing("second");
    std::this_thread::sleep_for(second);
  }
  return all;
}

TEST(Heartbeat, TellsAtIntervalsWhatIsBeingDone) {
  const std::vector<Told> all = told(50ms, 175ms, 200ms);  // at 50, 100, 150, 200, ... ms
  ASSERT_GE(all.size(), 2u);
  EXPECT_EQ(all.front().what, "first");
  EXPECT_EQ(all.back().what, "second");
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_GE(all[i].seconds, 0.05 * static_cast<double>(i + 1));
}

TEST(Heartbeat, SaysNothingOfWhatIsDoneSooner) { EXPECT_TRUE(told(1h, 1ms, 1ms).empty()); }

}  // namespace
}  // namespace gapscope
