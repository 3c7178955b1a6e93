// What of a log is fitted whose drive was let go.
#include <gtest/gtest.h>

#include "run/closed_loop.h"

namespace gapscope::internal::run {
namespace {

/// Two hundred rows at 100 Hz, of which the controller was at work in the first ones.
Recording let_go_after(double seconds, const char* file) {
  Recording r;
  r.file = file, r.dt = 0.01;
  r.u.assign(200, 0.0), r.x1.assign(200, 0.0);
  auto rows = std::make_shared<CommandRows>();
  for (int i = 0; i < 200; ++i) rows->t.push_back(0.01 * i);
  rows->target = rows->position = r.x1, rows->supply.assign(200, 1.0);
  rows->off_from = seconds;
  r.command = std::move(rows);
  return r;
}

TEST(SwitchedOn, IsThePartAtWorkAndALogWithoutOneIsNamed) {
  std::vector<std::string> too_short;
  const std::vector<Recording> on =
      switched_on({let_go_after(1.005, "long.csv"), let_go_after(0.305, "short.csv")}, too_short);
  ASSERT_EQ(on.size(), 1u);
  EXPECT_EQ(on[0].file, "long.csv");
  EXPECT_EQ(on[0].size(), 101u);
  EXPECT_EQ(too_short, std::vector<std::string>{"short.csv"});
}

}  // namespace
}  // namespace gapscope::internal::run
