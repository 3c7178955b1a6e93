#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/look_alikes.h"
#include "gapscope/telling/card.h"

namespace gapscope {
namespace {

ExperimentLimits short_limits() {
  ExperimentLimits limits;
  limits.duration = 2.0;
  limits.highest_frequency = 20.0;
  limits.input = 0.9;
  return limits;
}

struct Asked {
  test::LookAlikes pair;
  NextExperiment next;
  std::vector<std::string> progress = {};
};

test::LookAlikes delay_and_lag() { return test::look_alikes("input_delay", "actuator_lag", 510001); }

void expect_separated(const Asked& a) {
  ASSERT_TRUE(a.next.separates());
  EXPECT_LT(test::seen_excess(a.pair, a.pair.recording), 0.5);  // why one asks
  EXPECT_GE(test::seen_excess(a.pair, test::played(a.pair, a.next)), 1.0);
}

void expect_every_input_told(const Asked& a) {
  const std::vector<std::string>& said = a.progress;
  ASSERT_GE(said.size(), a.next.tried.size());
  EXPECT_EQ(said.front(), fmt::format("looking for the experiment that would decide, 1 of {}", said.size()));
}

void expect_within_limits(const Asked& a) {
  const auto [low, high] = std::minmax_element(a.pair.recording.x1.begin(), a.pair.recording.x1.end());
  EXPECT_EQ(a.next.u.size(), 2000u);
  for (const double u : a.next.u) EXPECT_LE(std::abs(u), 0.9 * (1.0 + 1e-9));
  for (const TriedInput& t : a.next.tried) EXPECT_LE(t.travel, *high - *low);
  std::set<std::string> inputs;
  for (const TriedInput& t : a.next.tried) EXPECT_TRUE(inputs.insert(t.input).second) << "twice: " << t.input;
}

void expect_ranked_by_the_worse_direction(const NextExperiment& next) {
  for (const TriedInput& t : next.tried) {
    ASSERT_EQ(t.separations.size(), 2u);
    EXPECT_EQ(t.worst, std::min(t.separations[0].excess, t.separations[1].excess));
    EXPECT_LE(t.worst, next.tried.front().worst);
  }
}

// One test: the search takes longer than all that is asked of it.
TEST(NextExperiment, SeparatesADelayFromALagOnTheIndependentPlantWithinItsLimits) {
  Asked a{delay_and_lag(), {}};
  a.next = next_experiment(a.pair.rivals, a.pair.recording.motor_trace(), short_limits(), 3.0, 0,
                           [&](const std::string& what) { a.progress.push_back(what); });
  expect_separated(a);
  if (HasFatalFailure()) return;
  expect_every_input_told(a);
  expect_within_limits(a);
  expect_ranked_by_the_worse_direction(a.next);
  EXPECT_THROW(next_experiment({a.pair.rivals.data(), 1}, a.pair.recording.motor_trace(), {}, 3.0),
               std::logic_error)
      << "it needs two rivals";
}

TEST(NextExperiment, SaysThatNothingTellsALawFromOneThatContainsIt) {
  const test::LookAlikes pair = test::look_alikes("stribeck_friction", "motor_coulomb_friction", 510002);
  const NextExperiment next = next_experiment(pair.rivals, pair.recording.motor_trace(), short_limits(), 3.0);
  ASSERT_TRUE(next.proposes());
  EXPECT_TRUE(has_code(experiment_of(next, pair.rivals, false), "next.experiment.contained"));
}

TEST(NextExperiment, ProposesNothingThatWouldNotSeparate) {
  const test::LookAlikes pair = delay_and_lag();
  ExperimentLimits weak = short_limits();
  weak.input = 1e-3;
  const NextExperiment next = next_experiment(pair.rivals, pair.recording.motor_trace(), weak, 3.0);
  ASSERT_FALSE(next.separates());
  EXPECT_EQ(experiment_of(next, pair.rivals, false).front().code, "next.experiment.none");
}

}  // namespace
}  // namespace gapscope
