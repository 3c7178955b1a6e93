#include <gtest/gtest.h>

#include <cmath>

#include "report/legend_placement.h"

namespace gapscope::internal {
namespace {

constexpr Box kFrameBox{0.0, 0.0, 1000.0, 400.0};

TEST(Crosses, FindsSegmentsThatPassThroughWithoutAnEndInside) {
  const Box box{100.0, 100.0, 50.0, 50.0};
  EXPECT_TRUE(crosses(box, {0.0, 125.0}, {500.0, 125.0}));
  EXPECT_TRUE(crosses(box, {90.0, 90.0}, {160.0, 160.0}));
  EXPECT_TRUE(crosses(box, {120.0, 120.0}, {120.0, 120.0})) << "a point inside";
  EXPECT_FALSE(crosses(box, {0.0, 0.0}, {500.0, 90.0}));
  EXPECT_FALSE(crosses(box, {90.0, 160.0}, {99.0, 0.0}));
  EXPECT_FALSE(crosses(box, {0.0, 125.0}, {99.0, 125.0})) << "ends before the box";
}

TEST(EmptyPlace, HidesNoData) {
  for (const double level : {0.1, 0.5, 0.9}) {  // a line that bends away at the right end
    Polyline line;
    for (int x = 0; x <= 1000; x += 5) line.push_back({1.0 * x, 400.0 * (x < 700 ? level : 1.0 - level)});
    const auto box = empty_place(kFrameBox, 200.0, 100.0, 10.0, {line});
    ASSERT_TRUE(box.has_value()) << level;
    EXPECT_TRUE(kFrameBox.holds(*box));
    for (std::size_t i = 1; i < line.size(); ++i) EXPECT_FALSE(crosses(*box, line[i - 1], line[i]));
  }
}

TEST(EmptyPlace, IsNowhereWhenDataFillTheFrame) {
  Polyline zigzag;
  for (int x = 0; x <= 1000; x += 20) zigzag.push_back({1.0 * x, x % 40 ? 400.0 : 0.0});
  EXPECT_FALSE(empty_place(kFrameBox, 200.0, 100.0, 10.0, {zigzag}).has_value());
  EXPECT_FALSE(empty_place(kFrameBox, 2000.0, 100.0, 10.0, {}).has_value()) << "larger than the frame";
}

TEST(EmptyPlace, SeesASinglePoint) {
  const auto free = empty_place(kFrameBox, 200.0, 100.0, 10.0, {});
  const auto moved = empty_place(kFrameBox, 200.0, 100.0, 10.0, {{free->centre()}});
  ASSERT_TRUE(moved.has_value());
  EXPECT_FALSE(overlap(*free, *moved));
}

}  // namespace
}  // namespace gapscope::internal
