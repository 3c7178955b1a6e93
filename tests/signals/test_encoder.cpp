#include <gtest/gtest.h>

#include <cmath>

#include "independent_plant/simulate.h"
#include "signals/encoder.h"
#include "signals/periodic.h"

namespace gapscope::internal::signals {
namespace {

using testing::Periodic;

Recording rig(const independent_plant::BlindSensor& sensor) {
  return independent_plant::simulate_blind({}, {}, sensor, {1000.0, 4.0, 1, 1e-10}).recording;
}

TEST(Encoder, TheFloorIsTheQuantisersOrTheNoisesWhicheverIsLarger) {
  auto sensor = independent_plant::BlindSensor::with_bits(20);
  const Recording clean = rig(sensor);
  EXPECT_NEAR(encoder_floor(clean.motor_trace()), rounding_noise(clean.quantum), 0.3 * clean.quantum);
  sensor.noise = 1e-4;  // fourth differences of white noise: their robust deviation is its rms
  EXPECT_NEAR(encoder_floor(rig(sensor).motor_trace()), 1e-4, 5e-6);
}

TEST(Encoder, TheQuantumIsThatOfTheSheetElseTheOneThatShows) {
  Periodic p;
  MotorTrace trace = p.trace(6.0);
  trace.quantum = 0.0;
  EXPECT_NEAR(encoder_quantum(trace), 1e-3, 1e-12);
  trace.quantum = 2e-3;
  EXPECT_EQ(encoder_quantum(trace), 2e-3);
}

TEST(Encoder, AWayOfOneCountIsNotMoreThanThatAndOneOfTwoIsEitherWay) {
  constexpr double kQuantum = 3.7e-4;
  const double floor = rounding_noise(kQuantum);
  EXPECT_FALSE(exceeds_a_count(0.0, floor));
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(exceeds_a_count(sign * kQuantum, floor));
    EXPECT_TRUE(exceeds_a_count(sign * 2.0 * kQuantum, floor));
  }
}

TEST(Encoder, OfAPositionThatHardlyMovesTheSmallestStepIsTheQuantum) {
  std::vector<double> x1(2000, 0.0);
  for (std::size_t i = 0; i < x1.size(); ++i)  // twenty places, each at a distance of its own from the last
    for (std::size_t step = 1; step < 20; ++step)
      if (i >= 100 * step) x1[i] += 0.01 * std::sqrt(static_cast<double>(step));
  EXPECT_EQ(seen_quantum(x1), 0.0);
  EXPECT_NEAR(quantum_or_least_step(x1), 0.01, 1e-12);
}

TEST(Encoder, TheFloorIsNoneOfTheMotionHoweverSeldomItIsRead) {
  const auto sensor = independent_plant::BlindSensor::with_bits(16);
  Recording r = rig(sensor);
  for (const std::size_t n : {1u, 2u, 4u}) {
    Recording seldom = r;
    seldom.x1.clear(), seldom.u.clear(), seldom.dt = r.dt * static_cast<double>(n);
    for (std::size_t i = 0; i < r.size(); i += n) seldom.x1.push_back(r.x1[i]), seldom.u.push_back(r.u[i]);
    EXPECT_NEAR(encoder_floor(seldom.motor_trace()), rounding_noise(r.quantum), 0.02 * r.quantum) << n;
  }
}

}  // namespace
}  // namespace gapscope::internal::signals
