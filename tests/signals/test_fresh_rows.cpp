// Rows that are no readings of their own: held, on a line between readings, or of a slower clock.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "independent_plant/simulate.h"
#include "signals/fresh_rows.h"
#include "signals/periodic.h"

namespace gapscope::internal::signals {
namespace {

using testing::Periodic;

struct Encoder {
  const char* name;
  double quantum, noise;
};

/// From three quanta a row in the fastest motion to a hundredth, and with counts that flicker.
constexpr Encoder kEncoders[] = {{"fine", 1e-6, 0.0},
                                 {"slow", 1e-3, 0.0},
                                 {"coarse", 5e-3, 0.0},
                                 {"noisy", 1e-3, 1.5e-3},
                                 {"unquantised", 0.0, 0.0}};

std::vector<double> motion(const Encoder& e) {
  Periodic p;
  p.quantum = e.quantum, p.noise = e.noise;
  p.trace(8.0);
  return p.x1;
}

std::vector<double> held(std::vector<double> x, std::size_t n) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i - i % n];
  return x;
}

std::vector<double> on_lines(const std::vector<double>& x, std::size_t n) {
  std::vector<double> lines;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t k = 0; k < n; ++k)
      lines.push_back(x[i] + static_cast<double>(k) / static_cast<double>(n) * (x[i + 1] - x[i]));
  return lines;
}

TEST(FreshRows, OfAnEncoderThatIsReadForEachRowAreNone) {
  for (const Encoder& e : kEncoders) EXPECT_FALSE(fresh_rows(motion(e), e.quantum).are_filled()) << e.name;
  for (const Encoder& e : {kEncoders[0], kEncoders[3]})
    EXPECT_EQ(fresh_rows(motion(e), e.quantum).filling, Filling::kNone) << e.name;
  EXPECT_EQ(fresh_rows(motion(kEncoders[1]), 1e-3).filling, Filling::kCannotBeTold)
      << "all its bends are what rounding makes of lines, too";
}

/// A steady speed to and fro, without noise: the turns alone bend, at one distance.
TEST(FreshRows, OfAMotionThatRepeatsItselfToTheCountAreNotToldToBeFilled) {
  for (int k = 0; k < 40; ++k) {
    std::vector<double> x;
    for (int i = 0; i < 15000; ++i)
      x.push_back(1e-4 * std::round((1.3 + 0.0773 * k) * std::abs(i % 1000 - 500) + 0.3));
    EXPECT_EQ(fresh_rows(x, 1e-4).filling, Filling::kCannotBeTold) << k;
  }
}

TEST(FreshRows, OfHeldReadingsTellHowManyRowsEachOfThemStandsAtAnySpeed) {
  for (const Encoder& e : kEncoders)
    for (const std::size_t n : {2u, 3u, 4u, 10u}) {
      const FreshRows rows = fresh_rows(held(motion(e), n), e.quantum);
      EXPECT_EQ(rows.filling, Filling::kHeld) << e.name << " " << n;
      EXPECT_EQ(rows.every, static_cast<double>(n)) << e.name;
    }
}

TEST(FreshRows, OfLinesBetweenReadingsTellHowManyRowsEachOfThemHas) {
  for (const Encoder& e : kEncoders)
    for (const std::size_t n : {2u, 3u, 8u}) {
      const FreshRows rows = fresh_rows(on_lines(motion(e), n), e.quantum);
      EXPECT_EQ(rows.filling, Filling::kInterpolated) << e.name << " " << n;
      EXPECT_EQ(rows.every, static_cast<double>(n)) << e.name;
    }
}

/// What a filter or a driver that counts makes of lines.
std::vector<double> in_counts(std::vector<double> x, double quantum) {
  for (double& v : x) v = quantum * std::round(v / quantum);
  return x;
}

TEST(FreshRows, OnLinesThatAreRoundedToCountsAgainAreNotToldToBeFresh) {
  for (const Encoder& e : kEncoders)
    for (const std::size_t n : {2u, 4u}) {
      if (e.quantum == 0.0) continue;
      const FreshRows rows = fresh_rows(in_counts(on_lines(motion(e), n), e.quantum), e.quantum);
      EXPECT_NE(rows.filling, Filling::kNone) << e.name << " " << n;
      EXPECT_TRUE(!rows.are_filled() || rows.every == static_cast<double>(n)) << e.name << " " << rows.every;
    }
}

TEST(FreshRows, OfAClockThatIsSlowerByNoWholeNumberTellItsRate) {
  const std::vector<double> x = motion(kEncoders[0]);
  std::vector<double> slower;
  for (std::size_t i = 0; i < x.size(); ++i)
    slower.push_back(
        x[static_cast<std::size_t>(std::floor(std::floor(0.467 * static_cast<double>(i)) / 0.467))]);
  const FreshRows rows = fresh_rows(slower, 1e-6);
  EXPECT_EQ(rows.filling, Filling::kHeld);
  EXPECT_NEAR(rows.every, 1.0 / 0.467, 0.05);
}

TEST(FreshRows, WithALostRowNowAndThenAreHeldAllTheSame) {
  std::vector<double> x = held(motion(kEncoders[0]), 4);
  for (const std::size_t lost : {7000u, 4001u, 2003u, 555u}) x.erase(x.begin() + lost);
  EXPECT_EQ(fresh_rows(x, 1e-6).every, 4.0);
}

/// A tenth of held rows is lost, or the clock slower by no whole number: no number has nearly all distances,
/// none as few as chance. Where more rows are lost than x1 has steps nothing is left of it.
TEST(FreshRows, ThatAreHeldNowAndThenOrLostAreNotToldToBeFresh) {
  for (const Encoder& e : kEncoders) {
    if (e.quantum >= 5e-3) continue;
    const std::vector<double> x = motion(e);
    std::vector<double> mostly = held(x, 2), slower;
    for (std::size_t i = mostly.size() - 5; i > 10; i -= 10)
      mostly.erase(mostly.begin() + static_cast<std::ptrdiff_t>(i));
    for (std::size_t i = 0; i < x.size(); ++i)
      slower.push_back(x[static_cast<std::size_t>(0.73 * static_cast<double>(i))]);
    EXPECT_NE(fresh_rows(mostly, e.quantum).filling, Filling::kNone) << e.name;
    if (e.noise > 0.0 || e.quantum > 1e-4) continue;  // too coarse for the slower clock to show
    EXPECT_NE(fresh_rows(slower, e.quantum).filling, Filling::kNone) << e.name;
  }
}

TEST(FreshRows, OffTheCountsOfAnyEncoderCannotBeTold) {
  EXPECT_EQ(fresh_rows(motion(kEncoders[4]), 0.0).filling, Filling::kCannotBeTold);
}

TEST(FreshRows, OfASteadySpeedCannotBeTold) {
  std::vector<double> ramp;
  for (int i = 0; i < 4000; ++i) ramp.push_back(1e-3 * std::floor(0.25 * i));  // a count in every fourth row
  EXPECT_EQ(fresh_rows(ramp, 1e-3).filling, Filling::kCannotBeTold);
}

TEST(FreshRows, OfHardlyAnyMotionCannotBeTold) {
  std::vector<double> x(1000, 0.0);
  for (std::size_t i = 500; i < x.size(); ++i) x[i] = 1e-3;
  EXPECT_EQ(fresh_rows(x, 1e-3).filling, Filling::kCannotBeTold);
  EXPECT_EQ(fresh_rows({}, 1e-3).filling, Filling::kCannotBeTold);
}

}  // namespace
}  // namespace gapscope::internal::signals
