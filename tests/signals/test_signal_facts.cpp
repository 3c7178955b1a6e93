#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gapscope::internal::signals
