#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "changes/series.h"

namespace gapscope {
namespace {

using internal::changes::courses;
using internal::changes::odd_units;
using ::testing::IsEmpty;

/// Reports of one quantity, each known to a standard error.
DriveChanges reports_of(const std::vector<double>& values, double std) {
  DriveChanges all;
  DriveQuantity q;
  q.key = "gap", q.from = "model_free", q.unit = "rad";
  for (const double v : values) {
    Observation o;
    o.value = v, o.std = std, o.ci95 = {v - 1.96 * std, v + 1.96 * std};
    q.observed.push_back(o);
    all.reports.push_back("r" + std::to_string(all.reports.size()));
  }
  all.quantities = {q};
  return all;
}

TEST(Courses, AStepIsFoundWhereItIs) {
  const std::vector<double> values = {19.1, 18.9, 19.0, 19.2, 18.8, 19.1, 24.0, 24.2, 23.9, 24.1};
  const std::vector<QuantityCourse> all = courses(reports_of(values, 0.2));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].since, 6);
  EXPECT_NEAR(all[0].before, 19.0, 0.05);
  EXPECT_NEAR(all[0].after, 24.05, 1e-6);
  EXPECT_LT(all[0].step_ci95.low, 5.03);
  EXPECT_GT(all[0].step_ci95.high, 5.03);
}

TEST(Courses, OfFewReportsThereIsNone) {
  EXPECT_THAT(courses(reports_of({19.0, 24.0, 24.0}, 0.2)), IsEmpty());
}

TEST(Courses, OfADriveThatStaysAsItIsAreCalledChangedInAtMostOneSeriesOfTwenty) {
  std::mt19937_64 random = random_stream(10, "series without a change");
  int alarms = 0;
  for (int series = 0; series < 400; ++series) {
    std::vector<double> values;
    for (int i = 0; i < 10; ++i) values.push_back(19.0 + 0.2 * normal(random));
    alarms += courses(reports_of(values, 0.2)).front().since >= 0;
  }
  EXPECT_LE(alarms, 20 + 3 * 4.4);
}

TEST(OddUnits, TheOneUnlikeTheOthersIsNamedAndNoneWhereNoneIs) {
  const std::vector<OddUnit> odd =
      odd_units(reports_of({19.0, 18.5, 19.4, 18.9, 19.2, 27.0, 18.7, 19.1, 18.8, 19.3}, 0.2));
  ASSERT_EQ(odd.size(), 1u);
  EXPECT_EQ(odd[0].report, 5);
  std::mt19937_64 random = random_stream(11, "units alike");
  int alarms = 0;
  for (int fleet = 0; fleet < 400; ++fleet) {
    std::vector<double> values;
    for (int i = 0; i < 10; ++i) values.push_back(19.0 + 1.0 * normal(random));
    alarms += !odd_units(reports_of(values, 0.2)).empty();
  }
  EXPECT_LE(alarms, 20 + 3 * 4.4);
  EXPECT_GE(alarms, 1);
}

}  // namespace
}  // namespace gapscope
