#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "signals/signal_facts.h"
#include "sliding_mode/as_stream.h"
#include "sliding_mode/verdict/pooled_flights.h"
#include "sliding_mode/verdict/pooled_reading.h"

namespace gapscope::internal::sliding_mode {
namespace {

using independent_plant::BlindCase;
using independent_plant::BlindRun;
using independent_plant::Waveform;

struct PooledSubject {
  BlindCase c;
  BlindRun run;
  MotorTrace trace;
  signals::SignalFacts facts;

  explicit PooledSubject(BlindCase drive) : c(std::move(drive)) {
    c.options.tolerance = independent_plant::kFastTolerance;
    run = independent_plant::simulate_blind(c);
    trace = run.recording.motor_trace();
    trace.quantum = c.sensor.quantum;
    facts = signals::read_facts(trace);
  }
  std::optional<GapEstimate> read() const {
    const auto evidence = read_pooled({&trace, 1}, {&facts, 1});
    return evidence ? std::optional(conclude(*evidence)) : std::nullopt;
  }
};

TEST(PooledFlights, EveryChangeOfTheTorquesSignIsATurn) {
  std::vector<double> u, x1(400, 0.0);
  for (int i = 0; i < 400; ++i) u.push_back(std::sin(2.0 * kPi * (i + 0.5) / 100.0));
  const MotorTrace trace{"u", 0.0, 1e-3, u, x1};
  const std::vector<TorqueTurn> turns = torque_turns(trace);
  ASSERT_EQ(turns.size(), 7u);  // the first rise from zero is none
  for (std::size_t k = 0; k < turns.size(); ++k) {
    EXPECT_NEAR(static_cast<double>(turns[k].zero), 50.0 * static_cast<double>(k + 1), 1.0);
    EXPECT_EQ(turns[k].direction, k % 2 == 0 ? -1 : 1);
  }
}

TEST(PooledFlights, ALightLoadThatNoSinglePassageShowsIsReadInTheirSum) {
  const PooledSubject s(independent_plant::random_drive(700250));  // 0.4 of the motor, 72 quanta of 16 bit
  EXPECT_NE(as_stream(s.trace).estimate.verdict, GapVerdict::kBacklash);  // it reads single passages only
  const GapEstimate estimate = detect_gap({&s.trace, 1});
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.04 * s.c.drive.gap);
  EXPECT_LE(estimate.ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate.ci95.high, s.c.drive.gap);
  EXPECT_GE(estimate.events.size(), 8u);
}

TEST(PooledFlights, ALoadThatCoastsIsNotReadByTheZeroOfTheTorque) {
  const PooledSubject s(independent_plant::random_drive(700283));  // 39 % too small by S5
  if (const auto estimate = s.read()) {
    EXPECT_NEAR(estimate->gap, s.c.drive.gap, 0.05 * s.c.drive.gap);
  }
}

TEST(PooledFlights, AStayAtNoTorqueBeginsWhereTheTorqueVanishes) {
  std::vector<double> u, x1(300, 0.0);
  for (int i = 0; i < 300; ++i) u.push_back(i % 100 < 40 ? 0.0 : i / 100 % 2 == 0 ? 1.0 : -1.0);
  const std::vector<TorqueTurn> turns = torque_turns({"u", 0.0, 1e-3, u, x1});
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_EQ(turns[0].quiet, 100u);
  EXPECT_NEAR(static_cast<double>(turns[0].zero), 139.0, 1.0);
  EXPECT_EQ(turns[1].quiet, 200u);
  EXPECT_NEAR(static_cast<double>(turns[1].zero), 239.0, 1.0);
}

TEST(PooledFlights, AMotorThatLeavesItsLoadWithoutTorqueIsNotReadFromWhereItCameToRest) {
  const auto trapezoid = [](std::uint64_t seed) {
    return PooledSubject(independent_plant::random_drive(seed, Waveform::kTrapezoid));
  };
  EXPECT_FALSE(
      trapezoid(3320052).read());  // thrown off the flank by the spring of the contact: 16 % too small
  EXPECT_FALSE(trapezoid(3330047).read());  // its load goes on and leaves it: 34 % too small
  EXPECT_FALSE(trapezoid(3387027).read());  // the same, more slowly: 10 % too small
}

TEST(PooledFlights, TheFrictionOfALightLoadIsToldFromItsImpact) {
  const auto trapezoid = [](std::uint64_t seed) {
    return PooledSubject(independent_plant::random_drive(seed, Waveform::kTrapezoid));
  };
  const PooledSubject lighter = trapezoid(3380026);  // 15 % too large by impacts alone
  const auto told = lighter.read();
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->gap, lighter.c.drive.gap, 0.06 * lighter.c.drive.gap);
  EXPECT_LE(told->ci95.low, lighter.c.drive.gap);
  const PooledSubject s = trapezoid(3387020);  // 0.11 of the motor
  const auto estimate = s.read();
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->gap, s.c.drive.gap, 0.02 * s.c.drive.gap);
}

/// Of a sine, and of a trapezoid whose torque stays at zero for most of the flight.
TEST(PooledFlights, APassageBeginsWhereTheContactTorqueVanishesAndEndsAtTheImpact) {
  for (const auto& [seed, waveform] : {std::pair(700250, Waveform::kSine), {3387020, Waveform::kTrapezoid}}) {
    const PooledSubject s(independent_plant::random_drive(static_cast<std::uint64_t>(seed), waveform));
    const auto estimate = s.read();
    ASSERT_TRUE(estimate);
    for (const GapEvent& told : estimate->events) {
      const auto ends_nearer = [&](const auto& a, const auto& b) {
        return std::abs(a.t2 - told.t2) < std::abs(b.t2 - told.t2);
      };
      const auto& truth = *std::ranges::min_element(s.run.truth.passages, ends_nearer);
      const double flight = truth.t2 - truth.t1;
      EXPECT_NEAR(told.t1, truth.t1, 0.02 * flight) << seed;
      EXPECT_NEAR(told.t2, truth.t2, 0.02 * flight) << seed;
      EXPECT_NEAR(told.x1_t1, truth.x1_t1, 0.01 * s.c.drive.gap) << seed;
    }
  }
}

TEST(PooledFlights, WithoutAGapNoKinkStandsOut) {
  for (int kind = 0; kind < independent_plant::kGapFreeKinds; ++kind) {
    const PooledSubject s(independent_plant::random_gap_free_drive(3620001, kind));
    EXPECT_FALSE(s.read()) << s.c.kind;
  }
  constexpr int kCogging = 5;  // long windows take a kink at 0.4 of the travel
  EXPECT_FALSE(
      PooledSubject(independent_plant::random_gap_free_drive(3602002, kCogging, Waveform::kTrapezoid))
          .read());
}

TEST(PooledFlights, AWeakImpactShowsInWhatFollowsIt) {
  const PooledSubject s(independent_plant::random_drive(871002));  // 24 counts, a load of 0.74 of the motor
  const auto estimate = s.read();
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->gap, s.c.drive.gap, 0.03 * s.c.drive.gap);
  EXPECT_LE(estimate->ci95.low, s.c.drive.gap);
  EXPECT_GE(estimate->ci95.high, s.c.drive.gap);
}

TEST(PooledFlights, NothingIsToldWhereTheIntervalReachesBelowTwentyCounts) {
  const PooledSubject s(independent_plant::random_drive(4100155));  // 18 counts, read as 21
  EXPECT_LT(s.c.drive.gap, 19.0 * s.c.sensor.quantum);
  EXPECT_FALSE(s.read());
}

TEST(PooledFlights, ThatSinglePassagesSpeakOfAMovingLoadDoesNotSilenceAllOfThem) {
  const PooledSubject s(independent_plant::random_drive(871106));  // seven of 13, of a load at rest
  const GapEstimate estimate = detect_gap({&s.trace, 1});
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_NEAR(estimate.gap, s.c.drive.gap, 0.02 * s.c.drive.gap);
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
