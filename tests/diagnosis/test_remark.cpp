#include <gtest/gtest.h>

#include "diagnosis/ranking.h"

namespace gapscope::internal::diagnosis {
namespace {

ScoredModel model(double innovation, double free) {
  ScoredModel j;
  j.score = 1.0;
  j.windows.innovation = {innovation, innovation};
  j.windows.free = {free, free};
  return j;
}

TEST(Remark, TellsWhatHelpsInOneMeasureOnlyAndWhatChangesNothing) {
  const ScoredModel before = model(10.0, 10.0);
  EXPECT_EQ(remark_on(model(5.0, 5.0), before), "");
  EXPECT_EQ(remark_on(model(5.0, 20.0), before), "flatters the predictions, spoils the free runs");
  EXPECT_EQ(remark_on(model(20.0, 5.0), before), "flatters the free runs, spoils the predictions");
  EXPECT_EQ(remark_on(model(9.999, 9.999), before), "as without it");
  EXPECT_EQ(remark_on(ScoredModel{}, before), "the motion with it diverges");
}

TEST(Remark, NamesParametersAtABound) {
  const ScoredModel before = model(10.0, 10.0);
  ScoredModel after = model(5.0, 5.0);
  after.fitted.at_bound = {"stiction_ratio"};
  EXPECT_EQ(remark_on(after, before), "stiction ratio at a bound");
  after = before;
  after.fitted.at_bound = {"width", "knee"};
  EXPECT_EQ(remark_on(after, before), "as without it; width, knee at a bound");
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
