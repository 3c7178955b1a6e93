// What stands out of the floors of a bank, found as its errors come.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "sliding_mode/marks/bank_marks.h"
#include "test_drive.h"

namespace gapscope::internal::sliding_mode {
namespace {

BankErrors one_bound(std::vector<double> errors, double floor) {
  BankErrors run;
  run.bounds = {1.0}, run.floor = {floor}, run.errors = std::move(errors);
  return run;
}

TEST(BankMarks, AnExcursionLeavesTheFloorPeaksAndFallsBelowHalfOfIt) {
  //                                    0    1    2    3    4    5     6     7     8    9
  const BankErrors run = one_bound({0.2, 1.5, 3.0, 2.5, 0.6, 0.4, -2.1, -4.0, -0.3, 2.2}, 1.0);
  const std::vector<Excursion> found = find_excursions(run, 0);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(std::tie(found[0].sign, found[0].start, found[0].peak, found[0].end), std::tuple(1, 0u, 2u, 5u));
  EXPECT_EQ(std::tie(found[1].sign, found[1].start, found[1].peak, found[1].end), std::tuple(-1, 5u, 7u, 8u));
  EXPECT_EQ(std::tie(found[2].sign, found[2].start, found[2].peak, found[2].end), std::tuple(1, 8u, 9u, 10u));
  EXPECT_EQ(found[1].height, 4.0);
}

TEST(BankMarks, OneExcursionBeginsNoEarlierThanTheOneBeforeItEnded) {
  const std::vector<Excursion> found =
      find_excursions(one_bound({3.0, 2.0, -3.0, std::nan(""), 3.0}, 1.0), 0);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].start, 0u);
  EXPECT_EQ(found[1].start, 1u);  // the last sample of the first one
  EXPECT_EQ(found[1].end, 3u);    // what is no number ends it
  EXPECT_EQ(found[2].start, 3u);
}

TEST(BankMarks, ALongRecordingIsMarkedAsItsErrorSignalsWouldBe) {
  TestEncoder encoder;
  encoder.duration = 3.0;  // several pieces, the last one not whole
  const TestRecording recording = record({}, sine(0.5814, 1.0), encoder);
  const MotorTrace trace = recording.trace();
  const signals::SignalFacts facts = signals::read_facts(trace);
  ASSERT_TRUE(facts.defect.empty());
  const std::vector<double> bounds = bound_grid(facts, trace.dt);
  const BankErrors run = run_bank(trace, facts, bounds, Discretisation::kMatched);
  const BankMarks marks = mark_bank(trace, facts, bounds);
  EXPECT_EQ(marks.floor, run.floor);
  EXPECT_EQ(marks.quiet, run.quiet);
  ASSERT_EQ(marks.loud.size(), trace.size());
  std::size_t excursions = 0;
  for (std::size_t j = 0; j < bounds.size(); ++j) {
    for (std::size_t i = 0; i < trace.size(); ++i)
      ASSERT_EQ(marks.is_loud(i, j), std::abs(run.error(i, j)) > 2.0 * run.floor[j]) << i << " " << j;
    const std::vector<Excursion> whole = find_excursions(run, j);
    ASSERT_EQ(marks.excursions[j].size(), whole.size());
    for (std::size_t k = 0; k < whole.size(); ++k) {
      const Excursion &a = marks.excursions[j][k], &b = whole[k];
      EXPECT_EQ(std::tie(a.bound, a.sign, a.start, a.peak, a.end, a.height),
                std::tie(b.bound, b.sign, b.start, b.peak, b.end, b.height));
    }
    excursions += whole.size();
  }
  EXPECT_GT(excursions, 24u);
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
