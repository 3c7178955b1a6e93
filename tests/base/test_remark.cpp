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
  EXPECT_EQ(gap_seen().text(), "a gap of 12 mrad in 7 passages, [1.0, 2.0] by x [rad]");
  EXPECT_EQ(gap_seen().text(Coordinates::kTranslation),
            "a gap of 12 mm in 7 passages, [1.0, 2.0] by x [rad]");
  const Remark damping("damping", "{} {}", {0.5, RemarkUnit{"N m s/rad"}});
  EXPECT_EQ(damping.text(), "0.5 N·m s/rad");
  EXPECT_EQ(damping.text(Coordinates::kTranslation), "0.5 N s/m");
}

TEST(Remark, TellsALengthWithThePrefixThatItAsksFor) {
  const auto text = [](double length) { return Remark("length", "{:.3g} [rad]", {length}).text(); };
  EXPECT_EQ(text(1.5), "1.5 rad");
  EXPECT_EQ(text(0.99999), "1 rad");
  EXPECT_EQ(text(-0.00297), "-2.97 mrad");
  EXPECT_EQ(text(5.0e-8), "50 nrad");
  EXPECT_EQ(text(1.0e-12), "0.001 nrad");
  EXPECT_EQ(text(0.0), "0 rad");
  EXPECT_EQ(Remark("speed", "{:.3g} [rad/s]", {0.00297}).text(), "0.00297 rad/s");
}

TEST(Remark, WritesLargeNumbersWithoutAnExponent) {
  const auto text = [](double ratio) { return Remark("ratio", "{:.3g} times", {ratio}).text(); };
  EXPECT_EQ(text(8812.0), "8810 times");
  EXPECT_EQ(text(88.1), "88.1 times");
  EXPECT_EQ(text(3.654e6), "3.65e+06 times");
}

TEST(Remark, SpeaksOfTheForceOfASlide) {
  const Remark remark("missed", "what the [torque] does");
  EXPECT_EQ(remark.text(), "what the torque does");
  EXPECT_EQ(remark.text(Coordinates::kTranslation), "what the force does");
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
