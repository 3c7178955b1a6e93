#include <gtest/gtest.h>

#include <cmath>

#include "signals/periodic.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::signals {
namespace {

using testing::Periodic;

TEST(SignalFacts, ADriftFromPeriodToPeriodIsNoPartOfTheMotion) {
  Periodic still, drifting;
  const SignalFacts expected = read_facts(still.trace(6.0)), facts = read_facts(drifting.trace(6.0, 0.4));
  EXPECT_EQ(facts.defect, Remark());
  EXPECT_EQ(facts.half_periods, expected.half_periods);
  EXPECT_NEAR(facts.half_period, expected.half_period, 0.01 * expected.half_period);
  EXPECT_NEAR(facts.travel, expected.travel, 0.02 * expected.travel);
}

TEST(SignalFacts, AMotionThatSettlesFarFromWhereItBeganIsPeriodicAllTheSame) {
  Periodic still;
  const SignalFacts expected = read_facts(still.trace(6.0));
  for (const double off : {0.0, 0.02}) {  // of u from period to period
    Periodic settling;
    const MotorTrace trace = settling.trace(6.0);
    for (std::size_t i = 0; i < trace.size(); ++i) {
      settling.x1[i] -= 0.4 * std::exp(-trace.dt * static_cast<double>(i) / 0.5);
      settling.u[i] += off * std::sin(static_cast<double>(i * i % 7919));
    }
    const SignalFacts facts =
        read_facts({trace.file, trace.start, trace.dt, settling.u, settling.x1, trace.quantum});
    EXPECT_EQ(facts.defect, Remark()) << off;
    EXPECT_NEAR(static_cast<double>(facts.half_periods), static_cast<double>(expected.half_periods), 1.0);
    EXPECT_NEAR(facts.half_period, expected.half_period, 0.01 * expected.half_period);
  }
}

}  // namespace
}  // namespace gapscope::internal::signals
