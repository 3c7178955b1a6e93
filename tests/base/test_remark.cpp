#include <gtest/gtest.h>

#include "gapscope/base/remark.h"

namespace gapscope {
namespace {

Remark gap_seen() {
  return {"gap_seen",
          "a gap of {:.2g} [rad] in {} passages, [{:.1f}, {:.1f}] by {}",
          {0.0123, 7L, 1.0, 2.0, std::string("x [rad]")}};
}

TEST(Remark, IsPutTogetherWithTheUnitsOfTheAxis) {
  EXPECT_EQ(gap_seen().text(), "a gap of 0.012 rad in 7 passages, [1.0, 2.0] by x [rad]");
  EXPECT_EQ(gap_seen().text(Coordinates::kTranslation),
            "a gap of 0.012 m in 7 passages, [1.0, 2.0] by x [rad]");
  const Remark damping("damping", "{} {}", {0.5, RemarkUnit{"N m s/rad"}});
  EXPECT_EQ(damping.text(), "0.5 N m s/rad");
  EXPECT_EQ(damping.text(Coordinates::kTranslation), "0.5 N s/m");
}

TEST(Remark, KeepsItsCodeAndItsNumbers) {
  const Remark both = gap_seen() + Remark("more", "; {:.0f} [rad/s]", {3.0});
  EXPECT_EQ(both.code(), "gap_seen");
  ASSERT_EQ(both.values().size(), 6u);
  EXPECT_EQ(std::get<double>(both.values().front()), 0.0123);
  EXPECT_TRUE(both.text(Coordinates::kTranslation).ends_with("; 3 m/s"));
}

TEST(Remark, OfTheSameKindHasTheSameCodesWhateverItsNumbersAre) {
  const auto levels = [](int count) {
    Remark all("play", "play: ");
    for (int i = 0; i < count; ++i) all += Remark("level", "{} ", {static_cast<long>(i)});
    return all + Remark("advice", "ramp");
  };
  EXPECT_EQ(levels(1).codes(), "play/level/advice");
  EXPECT_EQ(levels(3).codes(), levels(1).codes());
  EXPECT_NE(levels(3), levels(1));
  EXPECT_EQ(Remark::said("stored").codes(), "");
}

TEST(Remark, StaysAsItWasPutIntoWords) {
  Remark metres = gap_seen();
  metres.put_into_words(Coordinates::kTranslation);
  EXPECT_EQ(metres.text(Coordinates::kRotation), gap_seen().text(Coordinates::kTranslation));
  EXPECT_EQ(metres.code(), "gap_seen");
  Remark both = gap_seen() + Remark("more", "; {:.0f} [rad/s]", {3.0});
  const std::string codes = both.codes();
  both.put_into_words({});
  EXPECT_EQ(both.codes(), codes);
  EXPECT_EQ(Remark::said("as [rad] {} stored").text(Coordinates::kTranslation), "as [rad] {} stored");
  EXPECT_TRUE(Remark::said("").empty());
  EXPECT_EQ(Remark().text(), "");
}

}  // namespace
}  // namespace gapscope
