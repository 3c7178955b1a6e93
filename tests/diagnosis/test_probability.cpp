// How the probability of a step is shared out among its candidates and what the catalogue lacks.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "diagnosis/probability.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Two candidates that the data hardly tells apart, and a third one far behind.
std::vector<ScoredModel> ranked() {
  std::vector<ScoredModel> candidates(3);
  const char* names[] = {"cogging_torque", "torque_ripple", "input_delay"};
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].entry = find_effect(names[i]);
  candidates[0].score = 1.0, candidates[1].score = 1.1, candidates[2].score = 4.0;
  return candidates;
}

Decision decision(double probability) {
  Decision d;
  d.group = {find_effect("cogging_torque"), find_effect("torque_ripple")};
  d.probability = probability;
  return d;
}

TEST(Probability, IsSharedOutWithoutRest) {
  for (const double outside : {0.1, 0.5, 0.9}) {
    const Shares s = probability_shares(ranked(), decision(0.8), outside);
    EXPECT_NEAR(std::accumulate(s.candidates.begin(), s.candidates.end(), s.outside), 1.0, 1e-12);
    EXPECT_GT(s.candidates[0], s.candidates[1]);
    EXPECT_GT(s.candidates[1], s.candidates[2]);
  }
}

TEST(Probability, OfTheGroupIsAsLearnedAtEvenOddsOfTheCatalogue) {
  const Shares s = probability_shares(ranked(), decision(0.8), 0.5);
  EXPECT_NEAR(s.candidates[0] + s.candidates[1], 0.8, 1e-12);
}

TEST(Probability, FallsWithTheTrustInTheCatalogue) {
  const Shares much = probability_shares(ranked(), decision(0.8), 0.2),
               little = probability_shares(ranked(), decision(0.8), 0.8);
  EXPECT_NEAR(much.candidates[0] + much.candidates[1], 16.0 / 17.0, 1e-12);  // odds 4 times 4
  EXPECT_NEAR(little.candidates[0] + little.candidates[1], 0.5, 1e-12);      // odds 4 by 4
  EXPECT_GT(little.outside, much.outside);
}

TEST(Probability, IsUnknownWhereTheModelBeforeDiverges) {
  const Shares s = probability_shares(ranked(), decision(kNaN), 0.5);
  ASSERT_EQ(s.candidates.size(), 3u);
  EXPECT_TRUE(std::isnan(s.candidates[0]));
  EXPECT_TRUE(std::isnan(s.outside));
}

TEST(Probability, GrowsWithTheMarginAndIsNoneWithoutGain) {
  EXPECT_GT(group_probability(0.6, 2.0, 3.0), group_probability(0.6, 0.2, 3.0));
  EXPECT_EQ(group_probability(0.6, 2.0, 0.0), 0.0);
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
