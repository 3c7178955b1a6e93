#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/error_scale.h"
#include "report/fig6_one_period.h"
#include "report/figures.h"
#include "report/sample_run.h"
#include "report/signals.h"

namespace gapscope::internal::report {
namespace {

const RunResult& full_run() {
  static const RunResult run = sample_run();
  return run;
}

const Series& labelled(const Panel& panel, const std::string& part) {
  for (const Series& s : panel.series)
    if (s.label.find(part) != std::string::npos) return s;
  throw std::runtime_error("no series " + part);
}

TEST(ReportView, ShowsAFewPeriodsOfALongRecordingAndAllOfAShortOne) {
  const ReportView long_view(full_run());
  EXPECT_FALSE(long_view.whole);
  EXPECT_NEAR(long_view.half_period, 0.5, 0.01) << "of the sine of 1 Hz";
  EXPECT_NEAR(long_view.window.high - long_view.window.low, 4.0, 0.05) << "eight half periods";
  const RunResult run = sample_run({.samples = 7500});
  const ReportView short_view(run);
  EXPECT_TRUE(short_view.whole);
  EXPECT_EQ(short_view.window.high, run.recordings[0].time(7499));
}

TEST(ReportView, ShowsTheRecordingWithMostAcceptedPassages) {
  RunResult run = sample_run({.samples = 7500});
  run.recordings.insert(run.recordings.begin(), run.recordings[0]);
  run.recordings[0].file = "other.csv";
  EXPECT_EQ(ReportView(run).recording->file, "train.csv");
  run.model_free.reset();
  EXPECT_EQ(ReportView(run).recording->file, "other.csv");
}

TEST(ReportView, PutsTheStateOfTwoEncodersAroundZero) {
  const ReportView view(full_run());
  EXPECT_EQ(view.source, StateSource::kRecorded);
  EXPECT_NEAR(view.state_offset, -0.7, 1e-3) << "the zero of the second encoder, within the elastic wind-up";
  EXPECT_NEAR(robust_middle(view.state), 0.0, 1e-12);
}

TEST(Fig2, ShowsTheDataThemselvesInTheWindow) {
  const ReportView view(full_run());
  const FigureData figure = fig2_input_and_displacement(view);
  ASSERT_EQ(figure.panels.size(), 3u);
  const Series& x1 = figure.panels[1].series[0];
  const std::size_t first = view.index(view.window.low);
  for (std::size_t i = 0; i < x1.x.size(); i += 97) {
    EXPECT_EQ(x1.x[i], full_run().recordings[0].time(first + i));
    EXPECT_EQ(x1.y[i], full_run().recordings[0].x1[first + i]);
  }
  EXPECT_GE(x1.x.back(), view.window.high - full_run().recordings[0].dt);
}

TEST(Fig2, ScalesTheErrorBesideTheBacklashStateAndSaysTheFactor) {
  const ReportView view(full_run());
  const FigureData figure = fig2_input_and_displacement(view);
  const Series& error = labelled(figure.panels[2], "e_x");
  EXPECT_EQ(error.label, "$2 × e_x$");
  const std::size_t first = view.index(view.window.low);
  EXPECT_EQ(error.y[1000], 2.0 * full_run().model_free->traces[0].error[first + 1000]);
  const double size = largest_magnitude(error.y), state = largest_magnitude(figure.panels[2].series[0].y);
  EXPECT_GT(size, 0.15 * state);
  EXPECT_LT(size, 1.3 * state);
}

TEST(ErrorFactor, IsTheDetectorsOwnWhereThatShowsTheErrorWell) {
  const ReportView view(full_run());
  const double peak = largest_magnitude(view.over_time("", {}, view.error->error, view.window).y);
  EXPECT_EQ(error_factor(view, view.window, 50.0 * peak), full_run().model_free->scale);
  EXPECT_EQ(error_factor(view, view.window, 6.0 * peak), 5.0) << "50 would be far too much";
}

TEST(Fig3, MarksTheGapReadOffTheMapAroundTheFlanks) {
  const FigureData figure = fig3_backlash_map(ReportView(full_run()));
  const Dimension& gap = figure.panels[1].dimensions.at(0);
  EXPECT_NEAR(gap.range.high - gap.range.low, full_run().comparison->map_width, 1e-12);
  EXPECT_NEAR(gap.range.high + gap.range.low, 0.0, 1e-6);
  EXPECT_NE(figure.reading.find("from flank to flank the map is 19.0 mrad wide"), std::string::npos)
      << figure.reading;
}

TEST(Fig4, UsesTheFittedStateAndSaysSoWhereX2IsNotRecorded) {
  const RunResult run = sample_run({.samples = 7500, .load_recorded = false});
  const ReportView view(run);
  const FigureData figure = fig4_backlash_state_and_input(view);
  EXPECT_NE(figure.panels[1].y.name.find("fitted"), std::string::npos);
  EXPECT_NE(figure.reading.find("x2 was not recorded"), std::string::npos);
  const FitTrace& fit = run.reference->traces[0];
  EXPECT_EQ(figure.panels[1].series[0].y[500], fit.x1[500] - fit.x2[500]);
  EXPECT_NEAR(largest_magnitude(figure.panels[0].series[0].y), 0.172 * 0.5814, 1e-6) << "torque, not u";
}

TEST(Fig4, ReadsHowLateTheGapClosesAfterTheInputTurns) {
  const FigureData figure = fig4_backlash_state_and_input(ReportView(full_run()));
  std::vector<double> lags;  // the torque crosses zero every half second
  for (const GapEvent& e : full_run().model_free->events)
    if (e.accepted) lags.push_back(std::fmod(e.t2, 0.5));
  char expected[64];
  std::snprintf(expected, sizeof expected, "closed %.1f ms", 1e3 * median(lags));
  EXPECT_NE(figure.reading.find(expected), std::string::npos) << figure.reading << expected;
}

TEST(Fig6, PicksThePassageNearestToTheMedian) {
  const ReportView view(full_run());
  const auto passage = typical_passage(view);
  ASSERT_TRUE(passage.has_value());
  std::vector<double> gaps, distances;
  for (const GapEvent& e : view.accepted()) gaps.push_back(e.gap);
  for (const double g : gaps) distances.push_back(std::abs(g - median(gaps)));
  EXPECT_EQ(std::abs(passage->event.gap - median(gaps)),
            *std::min_element(distances.begin(), distances.end()));
  EXPECT_LT(passage->window.low, passage->event.t1);
  EXPECT_GT(passage->window.high, passage->event.t2);
}

TEST(Fig6, CallsTheErrorConvergedOnlyWhileItIsQuiet) {
  const ReportView view(full_run());
  const auto passage = typical_passage(view);
  ASSERT_TRUE(std::isfinite(passage->converged));
  const double peak = largest_magnitude(
      std::span(view.error->error).subspan(view.index(passage->event.t1), 400));  // 2 flights of 73 ms
  for (std::size_t i = view.index(passage->converged); i < view.index(passage->event.t1); ++i)
    EXPECT_LE(std::abs(view.error->error[i]), 0.05 * peak);
  EXPECT_GT(std::abs(view.error->error[view.index(passage->converged) - 1]), 0.049 * peak);
}

TEST(Fig6, LeavesOutTcWhereTheErrorWasNeverQuiet) {
  RunResult run = full_run();
  for (double& e : run.model_free->traces[0].error) e += 1.0;
  EXPECT_TRUE(std::isnan(typical_passage(ReportView(run))->converged));
  EXPECT_NE(fig6_one_period(ReportView(run)).reading.find("t_c is not drawn"), std::string::npos);
}

TEST(Fig6, NamesTheCorrectionWhereS5IsNotTheEstimate) {
  RunResult run = full_run();
  for (GapEvent& e : run.model_free->events) e.gap *= 0.5;
  const FigureData figure = fig6_one_period(ReportView(run));
  EXPECT_EQ(figure.panels[0].dimensions[0].label.find("$|x_1(t_2)"), 0u);
  EXPECT_NE(figure.reading.find("travel of the load"), std::string::npos);
}

TEST(Estimates, ShowsEveryEstimateWithItsInterval) {
  const FigureData figure = estimates(ReportView(full_run()));
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(panel.y.categories,
            (std::vector<std::string>{"model-free", "reference", "$x_1$–$x_2$ map", "simulated"}));
  EXPECT_EQ(panel.series[0].x[0], full_run().model_free->gap);
  EXPECT_EQ(panel.series[0].x_intervals[0].low, full_run().model_free->ci95.low);
  EXPECT_EQ(panel.series[1].x_intervals[0].high, full_run().reference->parameters[4].ci95.high);
  EXPECT_EQ(panel.x_marks[0].at, kSampleGap);
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
  ASSERT_EQ(figure.panels.size(), 3u);
  const Series& whole = figure.panels[0].series[0];
  ASSERT_EQ(whole.y.size(), full_run().recordings[0].size());
  for (std::size_t i = 0; i < whole.y.size(); i += 501)
    EXPECT_EQ(whole.y[i], full_run().recordings[0].x1[i] - full_run().reference->traces[0].x1[i]);
  const Series& r = figure.panels[2].series[0];
  const std::vector<double> expected = autocorrelation(whole.y, r.y.size());
  EXPECT_EQ(r.y, std::vector<double>(expected.begin() + 1, expected.end())) << "from lag 1 on";
  EXPECT_NEAR(figure.panels[2].y_bands[0].range.high, 1.96 / std::sqrt(25000.0), 1e-12);
  EXPECT_NE(figure.reading.find("is not white"), std::string::npos);
}

TEST(Residuals, ShadeTheGapModeOfTheFit) {
  const ReportView view(full_run());
  const FigureData figure = residuals(view);
  const auto& mode = full_run().reference->traces[0].mode;
  double shaded = 0.0, counted = 0.0;
  for (const Band& band : figure.panels[1].x_bands) shaded += band.range.high - band.range.low;
  for (std::size_t i = view.index(view.window.low); i <= view.index(view.window.high); ++i)
    counted += mode[i] == Mode::kGap ? full_run().recordings[0].dt : 0.0;
  EXPECT_NEAR(shaded, counted, 1e-9);
}

TEST(Residuals, OfADriveWithoutAGapHaveNoModes) {
  const RunResult run =
      sample_run({.samples = 7500, .load_recorded = false, .detected = false, .one_inertia = true});
  EXPECT_TRUE(residuals(ReportView(run)).panels[0].x_bands.empty());
}

TEST(Overview, KeepsTheTitlesOfThePanelsThatItBorrows) {
  // No estimate of a gap, but passages that were set aside: there is one panel only.
  RunResult run =
      sample_run({.samples = 7500, .load_recorded = false, .fitted = false, .verdict = GapVerdict::kNone});
  const ReportView view(run);
  const FigureData sheet = all_figures(view)[0];
  EXPECT_TRUE(std::any_of(sheet.panels.begin(), sheet.panels.end(),
                          [](const Panel& p) { return p.title == "Passage by passage"; }));
  EXPECT_FALSE(std::any_of(sheet.panels.begin(), sheet.panels.end(),
                           [](const Panel& p) { return p.title == "Estimates with 95 % intervals"; }));
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

TEST(LostMotionLoop, MeasuresThePlayBetweenTheBranchesAtZeroInput) {
  RunResult run = full_run();
  EXPECT_FALSE(lost_motion_loop(ReportView(run)).missing.empty());
  run.model_free->method = GapMethod::kLostMotion;
  run.model_free->quantity = GapQuantity::kPlayAtZeroTorque;
  run.model_free->events.clear();
  for (const double t : {1.0, 2.0, 3.0})  // loops of 5 mrad, up and down
    for (const int direction : {1, -1})
      run.model_free->events.push_back({run.recordings[0].file, t, t + 0.5, -2.5e-3 * direction + 1e-3,
                                        2.5e-3 * direction + 1e-3, 5e-3, 5e-3, 1e-5, direction, true, ""});
  const ReportView view(run);
  const FigureData figure = lost_motion_loop(view);
  ASSERT_EQ(figure.panels[0].dimensions.size(), 1u);
  EXPECT_NEAR(figure.panels[0].dimensions[0].range.low, -1.5e-3, 1e-12);
  EXPECT_NEAR(figure.panels[0].dimensions[0].range.high, 3.5e-3, 1e-12);
  EXPECT_FALSE(fig6_one_period(view).missing.empty()) << "a loop has no t1 and t2";
  EXPECT_EQ(estimates(view).panels[1].title, "Loop by loop");
  run.model_free->verdict = GapVerdict::kInconclusive;
  run.model_free->gap = kNaN;
  EXPECT_TRUE(lost_motion_loop(ReportView(run)).panels[0].dimensions.empty())
      << "levels that disagree have no play";
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

TEST(MissingFigures, SayWhy) {
  const RunResult detect = sample_run({.samples = 7500, .load_recorded = false, .fitted = false});
  const ReportView view(detect);
  EXPECT_EQ(fig3_backlash_map(view).missing, "the recording has no load position x2");
  EXPECT_NE(residuals(view).missing.find("was not asked for"), std::string::npos);
  EXPECT_FALSE(fig4_backlash_state_and_input(view).missing.empty());
  EXPECT_TRUE(fig6_one_period(view).missing.empty());
  const RunResult fit =
      sample_run({.samples = 7500, .load_recorded = false, .detected = false, .one_inertia = true});
  EXPECT_NE(fig5_displacement_and_error(ReportView(fit)).missing.find("was not asked for"),
            std::string::npos);
  EXPECT_EQ(estimates(ReportView(fit)).missing, "there is no estimate of a gap");
  RunResult empty;
  for (const FigureData& figure : all_figures(ReportView(empty)))
    EXPECT_FALSE(figure.missing.empty()) << figure.file;
}

}  // namespace
}  // namespace gapscope::internal::report
