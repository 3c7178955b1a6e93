#include <gtest/gtest.h>

#include <stdexcept>

#include "gapscope/recording/recording.h"

namespace gapscope {
namespace {

Recording counting(int count) {
  Recording r;
  r.file = "r.csv";
  r.start = 1.0;
  r.dt = 0.5;
  r.quantum = 0.1;
  for (int i = 0; i < count; ++i) {
    r.u.push_back(i);
    r.x1.push_back(10 * i);
  }
  return r;
}

TEST(Recording, APartKeepsItsTimesAndWhatIsKnown) {
  const Recording r = counting(10), p = part(r, 4, 3);
  EXPECT_EQ(p.size(), 3u);
  EXPECT_EQ(p.time(0), r.time(4));
  EXPECT_EQ(p.u, (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(p.x1, (std::vector<double>{40, 50, 60}));
  EXPECT_TRUE(p.x2.empty());
  EXPECT_EQ(p.quantum, 0.1);
}

TEST(Recording, StampsAreTheTimesOfUnevenSamplesAndOfTheirParts) {
  Recording r = counting(5);
  r.stamps = {1.0, 1.4, 2.1, 2.4, 3.0};
  EXPECT_FALSE(r.even());
  EXPECT_EQ(r.time(2), 2.1);
  const MotorTrace whole = r.motor_trace(), p = part(whole, 1, 3);
  EXPECT_EQ(whole.step(1), 2.1 - 1.4);
  EXPECT_EQ(whole.step(4), r.dt);  // nobody knows how long the last input was held
  EXPECT_EQ(whole.elapsed(2), 2.1 - 1.0);
  EXPECT_EQ(p.start, 1.4);
  EXPECT_EQ(p.time(2), 2.4);
  EXPECT_EQ(p.dt, r.dt);
  EXPECT_EQ(part(r, 1, 3).stamps, (std::vector<double>{1.4, 2.1, 2.4}));
  EXPECT_EQ(counting(5).motor_trace().step(2), 0.5);
}

TEST(Recording, APartOfTheViewLooksAtTheSameSamples) {
  const Recording r = counting(10);
  const MotorTrace p = part(r.motor_trace(), 4, 3);
  EXPECT_EQ(p.x1.data(), r.x1.data() + 4);
  EXPECT_EQ(p.u.size(), 3u);
  EXPECT_EQ(p.time(0), r.time(4));
}

TEST(Recording, APartBeyondTheEndIsACallersBug) {
  const Recording r = counting(10);
  EXPECT_THROW(part(r, 8, 3), std::logic_error);
  EXPECT_THROW(part(r.motor_trace(), 11, 0), std::logic_error);
  EXPECT_EQ(part(r, 10, 0).size(), 0u);
}

TEST(Recording, ModesAreCalledByTheWordsOfTheModeColumn) {
  EXPECT_STREQ(to_string(Mode::kEngagementMinus), "engagement-");
  EXPECT_STREQ(to_string(Mode::kImpact), "impact");
}

}  // namespace
}  // namespace gapscope
