// A whole blind check, small enough for a test.
#include <gtest/gtest.h>

#include <cstdlib>

#include "blind/blind_check.h"
#include "blind/score.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

/// GAPSCOPE_BLIND_CASES sets the number of cases, 3 if it is not set.
int cases_wanted() {
  const char* given = std::getenv("GAPSCOPE_BLIND_CASES");
  return given != nullptr ? std::max(3, std::atoi(given)) : 3;
}

TEST(BlindCheck, OfSmallRecordingsNamesMostEffectsAndBlamesNothingWhereNothingIs) {
  const testing::TemporaryFile place("");
  BlindConfig c;
  c.name = "small";
  const int third = cases_wanted() / 3;
  c.report = {9010001, cases_wanted() - third, 0, third, 0};
  c.rigs = {"paper", "geared"};
  c.duration = 2.0;
  const BlindScore score = run_blind_check(c, place.folder().string(), 0);
  EXPECT_EQ(score.report_cases, cases_wanted());
  for (const BlindCount& count : score.counts) {
    if (count.name == "one effect: named") {
      EXPECT_GE(count.share(), 0.6);
    }
    if (count.name == "no effect: one blamed") {
      EXPECT_LE(count.share(), 0.1);
    }
  }
}

}  // namespace
}  // namespace gapscope
