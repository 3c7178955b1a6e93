// What the simulated plant did, beside what was read of it.
#include <gtest/gtest.h>

#include <cmath>

#include "report/figures.h"
#include "report/full_run.h"
#include "report/sample_run.h"
#include "report/true_passages.h"

namespace gapscope::internal::report {
namespace {

/// The sample, whose events are its true passages, with the modes that a simulation records.
RunResult simulated() {
  RunResult run = sample_run({.samples = 7500});
  Recording& r = run.recordings[0];
  r.mode.assign(r.size(), Mode::kEngagementPlus);
  const auto sample = [&](double t) { return static_cast<std::size_t>(std::lround((t - r.start) / r.dt)); };
  for (const GapEvent& e : run.model_free->events)
    for (std::size_t i = sample(e.t1); i < sample(e.t2); ++i) r.mode[i] = Mode::kGap;
  return run;
}

TEST(TruePassages, AreFromTheLastContactWithOneFlankToTheFirstWithTheOther) {
  const RunResult run = simulated();
  const ReportView view(run);
  const auto found = true_passages(view, view.window);
  ASSERT_EQ(found.size(), view.events.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].released, view.events[i].t1, 1e-9);
    EXPECT_NEAR(found[i].impact, view.events[i].t2, 1e-9);
    EXPECT_EQ(found[i].x1_released, view.events[i].x1_t1);
    EXPECT_EQ(found[i].x1_impact, view.events[i].x1_t2);
  }
}

TEST(TruePassages, ABounceOffTheSameFlankIsNone) {
  RunResult run = simulated();
  const ReportView before(run);
  const std::size_t impact = before.index(before.events[1].t2);
  for (std::size_t i = 5; i < 15; ++i) run.recordings[0].mode[impact + i] = Mode::kGap;
  const ReportView view(run);
  EXPECT_EQ(true_passages(view, view.window).size(), view.events.size());
}

TEST(TruePassages, AreMarkedWhereTheDriveIsSimulatedAndNowhereElse) {
  const RunResult run = simulated();
  const ReportView view(run);
  const FigureData fig5 = fig5_displacement_and_error(view), fig6 = fig6_one_period(view);
  EXPECT_EQ(labelled(fig5.panels[0], kTrueRelease).x.size(), view.events.size());
  EXPECT_EQ(labelled(fig5.panels[0], kTrueImpact).x.size(), view.events.size());
  EXPECT_EQ(fig6.panels[1].x_marks.front().label, kTrueRelease);
  EXPECT_NE(fig6.reading.find("in the simulation contact was lost"), std::string::npos);
  const RunResult recorded = sample_run({.samples = 7500});
  const ReportView other(recorded);
  EXPECT_TRUE(true_passages(other, other.window).empty());
  EXPECT_EQ(fig6_one_period(other).reading.find("in the simulation"), std::string::npos);
}

TEST(DrawnError, SaysWhichBoundItHasAndWhy) {
  RunResult run = sample_run({.samples = 7500});
  GapEstimate& g = *run.model_free;
  g.bound_t1 = 3.0;
  const auto caption = [&] { return fig5_displacement_and_error(ReportView(run)).reading; };
  EXPECT_NE(caption().find("L = 3 rad/s² is the smallest bound of the bank that slides just before t1"),
            std::string::npos);
  for (GapEvent& e : g.events) e.accepted = false;
  EXPECT_NE(caption().find("the smallest bound of the bank that slides over the recording"),
            std::string::npos);
  g.method = GapMethod::kLiteral, g.bound_t1 = kNaN;
  EXPECT_NE(caption().find("L = 4.1 rad/s² was given"), std::string::npos);
}

}  // namespace
}  // namespace gapscope::internal::report
