#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "report/ticks.h"

namespace gapscope::internal::report {
namespace {

TEST(Ticks, AreRoundWithinTheRangeAndNotTooMany) {
  auto generator = random_stream(1, "ticks");
  for (int i = 0; i < 2000; ++i) {
    const double low = uniform(generator, -1.0, 1.0) * log_uniform(generator, 1e-6, 1e6);
    const double high = low + log_uniform(generator, 1e-6, 1e6);
    const int most = 2 + i % 9;
    const Ticks ticks = round_ticks(low, high, most);
    const double digit = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step * 1.0000001)));
    EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 5) < 1e-6)
        << ticks.step;
    EXPECT_LE(ticks.values.size(), static_cast<std::size_t>(most) + 2);
    EXPECT_GE(ticks.values.size(), 2u) << "a single tick tells no scale";
    for (const double v : ticks.values) {
      EXPECT_GE(v, low - 1e-9 * (high - low));
      EXPECT_LE(v, high + 1e-9 * (high - low));
      EXPECT_NEAR(std::remainder(v, ticks.step), 0.0, 1e-6 * ticks.step + 1e-9 * std::abs(v));
    }
  }
}

TEST(Ticks, AreTheFinestThatFit) {
  EXPECT_DOUBLE_EQ(round_ticks(0.0, 10.0, 11).step, 1.0);
  EXPECT_DOUBLE_EQ(round_ticks(0.0, 10.0, 10).step, 2.0);
  EXPECT_DOUBLE_EQ(round_ticks(0.0, 10.0, 5).step, 5.0);
  EXPECT_DOUBLE_EQ(round_ticks(-0.11, 0.13, 5).step, 0.05);
}

TEST(Ticks, AreMoreThanOneEvenWhereThereIsNoRoom) {
  EXPECT_EQ(round_ticks(-0.18, 0.18, 2).values.size(), 3u);
  EXPECT_DOUBLE_EQ(round_ticks(-0.18, 0.18, 2).step, 0.1);
}

TEST(Ticks, IncludeLimitsThatAreRound) {
  const Ticks ticks = round_ticks(0.1, 0.7, 7);  // neither limit is exact in binary
  EXPECT_EQ(ticks.values.size(), 7u);
  EXPECT_EQ(ticks.decimals, 1);
}

TEST(Ticks, LabelsShowTheDecimalsOfTheStepAndATrueMinus) {
  EXPECT_EQ(tick_label(-0.25, 2), "−0.25");
  EXPECT_EQ(tick_label(-1e-12, 1), "0.0") << "zero has no sign";
  EXPECT_EQ(tick_label(150.0, 0), "150");
}

TEST(AxisScale, KeepsNumbersBetweenOneAndAThousand) {
  struct Case {
    const char* unit;
    double magnitude, factor;
    const char* shown;
  };
  const Case cases[] = {{"rad", 0.126, 1e-3, "mrad"}, {"rad", 0.0009, 1e-6, "µrad"},
                        {"rad", 0.001, 1e-3, "mrad"}, {"rad", 3.0, 1.0, "rad"},
                        {"m", 2e-8, 1e-9, "nm"},      {"s", 0.05, 1e-3, "ms"},
                        {"N·m", 0.1, 1e-3, "mN·m"},   {"kg m²", 8e-4, 1.0, "kg m²"},
                        {"", 0.01, 1.0, ""},          {"rad", 0.0, 1.0, "rad"}};
  for (const Case& c : cases) {
    const AxisScale scale = axis_scale(c.unit, c.magnitude);
    EXPECT_DOUBLE_EQ(scale.factor, c.factor) << c.unit << c.magnitude;
    EXPECT_EQ(scale.unit, c.shown);
  }
}

}  // namespace
}  // namespace gapscope::internal::report
