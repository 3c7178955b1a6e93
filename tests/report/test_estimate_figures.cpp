#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "report/fig6_one_period.h"
#include "report/figures.h"
#include "report/full_run.h"
#include "report/sample_run.h"
#include "report/signals.h"
#include "report/view_signals.h"

namespace gapscope::internal::report {
namespace {

TEST(Estimates, ShowsEveryEstimateWithItsInterval) {
  const FigureData figure = estimates(ReportView(full_run()));
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(panel.y.categories,
            (std::vector<std::string>{"model-free", "fitted model", "$x_1$–$x_2$ map", "simulated"}));
  EXPECT_EQ(panel.series[0].x[0], full_run().model_free->gap);
  EXPECT_EQ(panel.series[0].x_intervals[0].low, full_run().model_free->ci95.low);
  EXPECT_EQ(panel.series[1].x_intervals[0].high, full_run().reference->parameters[4].ci95.high);
  EXPECT_EQ(panel.x_marks[0].at, kSampleGap);
}

TEST(Estimates, OfARejectedModelIsACrossWithoutAnInterval) {
  RunResult run = full_run();
  run.reference->trust = FitTrust::kRejected;
  const Panel panel = estimates(ReportView(run)).panels[0];
  EXPECT_TRUE(panel.series[1].x_intervals.empty());
  EXPECT_EQ(panel.series[1].marker, Marker::kCross);
  EXPECT_EQ(panel.y.remarks[1], "18.8 mrad, model rejected");
}

TEST(Estimates, SplitsThePassagesByDirectionAndCountsWhatIsBeyondTheScale) {
  const FigureData figure = estimates(ReportView(full_run()));
  std::size_t up = 0, down = 0, aside = 0;
  for (const GapEvent& e : full_run().model_free->events)
    ++(!e.accepted ? aside : e.direction > 0 ? up : down);
  EXPECT_EQ(labelled(figure.panels[1], "rising").x.size(), up);
  EXPECT_EQ(labelled(figure.panels[1], "falling").x.size(), down);
  EXPECT_NE(figure.reading.find("set aside: " + std::to_string(aside)), std::string::npos);
  EXPECT_NE(figure.reading.find(std::to_string(aside) + " of them beyond the scale"), std::string::npos);
  EXPECT_THROW(labelled(figure.panels[1], "set aside"), std::runtime_error) << "nothing of it is in view";
}

TEST(Residuals, AreRecordedMinusFitted) {
  const FigureData figure = residuals(ReportView(full_run()));
  ASSERT_EQ(figure.panels.size(), 5u);
  EXPECT_EQ(labelled(figure.panels[0], "recorded").y, full_run().recordings[0].x1);
  EXPECT_EQ(labelled(figure.panels[0], "free run of the fitted model").y, full_run().reference->traces[0].x1);
  const Series& whole = figure.panels[1].series[0];
  ASSERT_EQ(whole.y.size(), full_run().recordings[0].size());
  for (std::size_t i = 0; i < whole.y.size(); i += 501)
    EXPECT_EQ(whole.y[i], full_run().recordings[0].x1[i] - full_run().reference->traces[0].x1[i]);
  const Series& r = figure.panels[3].series[0];
  const double dt = full_run().recordings[0].dt;
  const auto step = static_cast<std::size_t>(std::lround((r.x[1] - r.x[0]) / dt));
  const std::vector<double> expected = autocorrelation(whole.y, r.y.size() * step, step);
  EXPECT_EQ(r.y, std::vector<double>(expected.begin() + 1, expected.end())) << "from lag 1 on";
  EXPECT_NEAR(figure.panels[3].y_bands[0].range.high, 1.96 / std::sqrt(25000.0), 1e-12);
  const Series& with_input = figure.panels[4].series[0];
  EXPECT_EQ(with_input.y, correlation(full_run().recordings[0].u, whole.y, r.y.size() * step, step));
  EXPECT_GE(figure.panels[4].y_bands[0].range.high, figure.panels[3].y_bands[0].range.high);
  EXPECT_NE(figure.reading.find("is not white"), std::string::npos);
}

/// A line through four samples of each pixel and more is a block where they are noise.
TEST(Residuals, OfManySamplesHaveMeanAndDeviationOfStretches) {
  RunResult run = sample_run({.samples = 30000});
  EXPECT_EQ(residuals(ReportView(run)).panels[1].series.size(), 1u) << "a smooth line is none";
  auto noise = random_stream(1, "residuals");
  for (double& x : run.recordings[0].x1) x += 1e-2 * normal(noise);
  const ReportView view(run);
  const FigureData figure = residuals(view);
  const Panel& whole = figure.panels[1];
  ASSERT_EQ(whole.title, "Residual of the whole recording");
  ASSERT_EQ(whole.series.size(), 4u);
  const Series &middle = whole.series[1], &above = whole.series[2], &below = whole.series[3];
  EXPECT_EQ(middle.x.size(), 200u);
  const auto r = difference_of(view.recording->x1, view.fit->x1);
  EXPECT_NEAR(mean(middle.y), mean(r), 1e-12);
  for (std::size_t i = 0; i < middle.x.size(); ++i) {
    const std::span<const double> part(r.data() + 150 * i, 150);
    EXPECT_NEAR(middle.y[i], mean(part), 1e-12);
    EXPECT_NEAR(0.5 * (above.y[i] - below.y[i]),
                std::sqrt(std::max(0.0, rms(part) * rms(part) - mean(part) * mean(part))), 1e-9);
  }
  const RunResult few = sample_run({.samples = 5000});
  EXPECT_EQ(residuals(ReportView(few)).panels[1].series.size(), 1u);
}

TEST(Residuals, ShadeTheGapModeOfTheFit) {
  const ReportView view(full_run());
  const FigureData figure = residuals(view);
  const auto& mode = full_run().reference->traces[0].mode;
  double shaded = 0.0, counted = 0.0;
  for (const Band& band : figure.panels[2].x_bands) shaded += band.range.high - band.range.low;
  for (std::size_t i = view.index(view.window.low); i <= view.index(view.window.high); ++i)
    counted += mode[i] == Mode::kGap ? full_run().recordings[0].dt : 0.0;
  EXPECT_NEAR(shaded, counted, 1e-9);
}

TEST(Residuals, OfADriveWithoutAGapHaveNoModes) {
  const RunResult run =
      sample_run({.samples = 7500, .load_recorded = false, .detected = false, .one_inertia = true});
  for (const Panel& panel : residuals(ReportView(run)).panels) EXPECT_TRUE(panel.x_bands.empty());
}

TEST(Estimates, AGapThatWasDeniedIsDrawnAgainstTheOneThatWouldHaveShown) {
  RunResult run =
      sample_run({.samples = 7500, .load_recorded = false, .fitted = false, .verdict = GapVerdict::kNone});
  run.model_free->smallest_visible_gap = 0.03;
  const ReportView view(run);
  const Panel passages = estimates(view).panels.back();
  ASSERT_EQ(passages.y_marks.size(), 1u);
  EXPECT_DOUBLE_EQ(passages.y_marks[0].at, 0.03);
  EXPECT_LE(passages.y.range.low, 0.0);
  EXPECT_GE(passages.y.range.high, 0.03);
  run.model_free->lost_motion.gap_limit = 0.01;
  EXPECT_DOUBLE_EQ(estimates(ReportView(run)).panels.back().y_marks[0].at, 0.01) << "the loop binds more";
}

TEST(Residuals, OfWhiteNoiseAreCalledWhite) {
  RunResult run = sample_run({.samples = 6000});
  // Deterministic and white enough: the fractional parts of i² √2.
  for (std::size_t i = 0; i < 6000; ++i)
    run.recordings[0].x1[i] =
        run.reference->traces[0].x1[i] +
        1e-6 * std::fmod(std::sqrt(2.0) * static_cast<double>(i) * static_cast<double>(i), 1.0);
  EXPECT_NE(residuals(ReportView(run)).reading.find("looks white"), std::string::npos);
}

/// Ramps of two amplitudes with 5 mrad between the branches, about 1 mrad.
RunResult with_loops() {
  RunResult run = full_run();
  Recording& r = run.recordings[0];
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double phase = std::fmod(4.0 * static_cast<double>(i) / static_cast<double>(r.size()), 1.0);
    const double triangle = phase < 0.25 ? 4.0 * phase : phase < 0.75 ? 2.0 - 4.0 * phase : 4.0 * phase - 4.0;
    const bool falls = phase >= 0.25 && phase < 0.75;
    r.u[i] = (i < r.size() / 2 ? 1.0 : 4.0) * triangle;
    r.x1[i] = 1e-3 + (falls ? 2.5e-3 : -2.5e-3) + 1e-4 * r.u[i];
  }
  LostMotion& m = run.model_free->lost_motion;
  m.value = 5e-3, m.ci95 = {4.9e-3, 5.1e-3}, m.cause = LostMotionCause::kOpen;
  m.levels = {{1.0, 5e-3, {4.9e-3, 5.1e-3}, 4, 0.0, 1e-4}, {4.0, 5.2e-3, {5e-3, 5.4e-3}, 4, 0.0, 1e-4}};
  return run;
}

TEST(LostMotionLoop, MarksThePlayAtZeroTorqueWhateverTheVerdict) {
  EXPECT_FALSE(lost_motion_loop(ReportView(full_run())).missing.empty());
  RunResult run = with_loops();
  run.model_free->verdict = GapVerdict::kInconclusive;
  run.model_free->gap = kNaN;
  const Panel panel = lost_motion_loop(ReportView(run)).panels[0];
  ASSERT_EQ(panel.dimensions.size(), 1u);
  EXPECT_NEAR(panel.dimensions[0].range.low, -1.5e-3, 1e-5);
  EXPECT_NEAR(panel.dimensions[0].range.high, 3.5e-3, 1e-5);
  EXPECT_NE(panel.dimensions[0].label.find("5.00 mrad"), std::string::npos) << panel.dimensions[0].label;
}

TEST(ReversalShelf, IsTheInputAlongTheMotionOverTheWayBehindATurn) {
  EXPECT_FALSE(reversal_shelf(ReportView(full_run())).missing.empty());
  RunResult run = full_run();
  GapEstimate& g = *run.model_free;
  g.method = GapMethod::kReversal;
  const Recording& r = run.recordings.front();
  GapEvent turn;
  turn.file = r.file, turn.direction = -1;
  turn.t1 = r.start, turn.x1_t1 = r.x1.front();
  g.events = {turn};
  const Panel panel = reversal_shelf(ReportView(run)).panels[0];
  ASSERT_EQ(panel.series.size(), 2u);
  EXPECT_TRUE(panel.series[0].x.empty()) << "no rising stroke";
  ASSERT_FALSE(panel.series[1].x.empty());
  EXPECT_DOUBLE_EQ(panel.series[1].x[0], 0.0);
  ASSERT_EQ(panel.x_bands.size(), 1u);
  EXPECT_DOUBLE_EQ(panel.x_bands[0].range.low, g.ci95.low);
}

TEST(LostMotionLoop, HasAColourAndAFlankForEachTorqueLevel) {
  const RunResult run = with_loops();
  const Panel panel = lost_motion_loop(ReportView(run)).panels[0];
  ASSERT_EQ(panel.series.size(), 6u) << "two loops, and a flank to either side of each";
  const auto grey = [](const Colour& c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; };
  EXPECT_GT(std::abs(grey(panel.series[0].style.colour) - grey(panel.series[1].style.colour)), 50.0);
  for (const std::size_t level : {0u, 1u})
    EXPECT_NE(panel.series[level].label.find("flank"), std::string::npos) << panel.series[level].label;
  for (std::size_t i = 2; i < 6; ++i) {
    const Series& flank = panel.series[i];
    const double constant = flank.x[1] / (i < 4 ? 1.0 : 4.0) * (i % 2 == 0 ? 1.0 : -1.0);  // axis over u
    EXPECT_NEAR((flank.y[1] - flank.y[0]) / (flank.x[1] - flank.x[0]), 1e-4 / constant, 1e-7);
  }
}

TEST(LostMotionLoop, FlanksLieOnTheLoopThoughTheTorqueIsNoisy) {
  RunResult run = with_loops();
  Recording& r = run.recordings[0];
  for (std::size_t i = 0; i < r.size(); ++i) r.u[i] += 0.1 * std::sin(static_cast<double>(i) * 2.0);
  const Panel panel = lost_motion_loop(ReportView(run)).panels[0];
  ASSERT_EQ(panel.series.size(), 6u);
  for (std::size_t i = 4; i < 6; ++i) {  // the level of 4 units of u, which it reaches without the noise, too
    const Series& flank = panel.series[i];
    const double constant = flank.x[1] / (i == 4 ? 4.0 : -4.0), side = i == 4 ? 1.0 : -1.0;
    for (std::size_t end = 0; end < 2; ++end)
      EXPECT_NEAR(flank.y[end], 1e-3 - side * 2.5e-3 + 1e-4 * flank.x[end] / constant, 3e-5);
  }
}

TEST(LostMotionLoop, AFlankThatTheLoopDoesNotShowIsNotDrawn) {
  RunResult run = with_loops();
  for (LostMotionLevel& level : run.model_free->lost_motion.levels) level.flank = 1e-3;  // ten times as soft
  EXPECT_EQ(lost_motion_loop(ReportView(run)).panels[0].series.size(), 2u);
}

TEST(Estimates, ALostMotionIsShownWhereThereIsNoGap) {
  RunResult run = with_loops();
  run.model_free->verdict = GapVerdict::kInconclusive;
  run.model_free->gap = kNaN;
  run.model_free->ci95 = {};
  const Panel panel = estimates(ReportView(run)).panels[0];
  ASSERT_EQ(panel.y.categories.front(), "model-free");
  EXPECT_NE(panel.y.remarks.front().find("lost motion"), std::string::npos);
  EXPECT_DOUBLE_EQ(panel.series.front().x.front(), 5e-3);
}

TEST(BoundTimeMap, ShowsEveryBoundAtItsLogarithmAndMarksThoseThatMatter) {
  const ReportView view(full_run());
  const FigureData figure = bound_time_map(view);
  ASSERT_EQ(figure.panels.size(), 3u);
  const Panel& map = figure.panels[1];
  EXPECT_NEAR(map.x.range.high - map.x.range.low, 1.0, 1e-9);
  EXPECT_LT(map.y.range.low, 0.0);
  EXPECT_GT(map.y.range.high, std::log10(30.0));
  std::vector<double> marked;
  for (const Mark& mark : map.y_marks) marked.push_back(std::pow(10.0, mark.at));
  ASSERT_EQ(marked.size(), 2u);
  EXPECT_NEAR(marked[0], 4.1, 1e-9) << "decides t2";
  EXPECT_NEAR(marked[1], 20.0, 1e-9) << "bound (13)";
  double covered = 0.0;
  for (const Tile& tile : map.tiles) covered += (tile.x.high - tile.x.low) * (tile.y.high - tile.y.low);
  EXPECT_NEAR(covered, map.y.range.high - map.y.range.low, 1e-9) << "no place is left white";
  EXPECT_NE(figure.reading.find("bound (13) is 20"), std::string::npos) << figure.reading;
}

TEST(BoundTimeMap, GetsDarkerWithEveryDecadeAlsoInGrey) {
  const FigureData figure = bound_time_map(ReportView(full_run()));
  double last = 256.0;
  for (const Tile& tile : figure.panels[2].tiles) {
    const double grey = 0.299 * tile.colour.red + 0.587 * tile.colour.green + 0.114 * tile.colour.blue;
    EXPECT_LT(grey, last);
    last = grey;
  }
  EXPECT_LT(last, 60.0);
}

TEST(BoundTimeMap, IsMissingWithoutABank) {
  RunResult run = full_run();
  run.model_free->map.reset();
  EXPECT_FALSE(bound_time_map(ReportView(run)).missing.empty());
}

}  // namespace
}  // namespace gapscope::internal::report
