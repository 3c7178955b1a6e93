#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/fig6_one_period.h"
#include "report/figures.h"
#include "report/full_run.h"
#include "report/sample_run.h"
#include "report/signals.h"
#include "report/view_signals.h"

namespace gapscope::internal::report {
namespace {

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

TEST(Fig5, MarksTheImpactsOfOneBoundThatShowNoBegin) {
  RunResult run = sample_run({.samples = 7500});
  run.model_free->method = GapMethod::kPaper;
  for (GapEvent& e : run.model_free->events) e.accepted = false, e.t1 = e.x1_t1 = e.gap = kNaN;
  const FigureData figure = fig5_displacement_and_error(ReportView(run));
  const Series& impacts = labelled(figure.panels[0], "impact");
  EXPECT_FALSE(impacts.joined);
  EXPECT_EQ(impacts.x.size(), run.model_free->events.size());
  EXPECT_EQ(impacts.y.front(), run.model_free->events.front().x1_t2);
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
    EXPECT_LE(std::abs(view.error->error[i]), 0.01 * peak);
  EXPECT_GT(std::abs(view.error->error[view.index(passage->converged) - 1]), 0.0099 * peak);
}

TEST(Fig6, LeavesOutTcWhereTheErrorWasNeverQuiet) {
  RunResult run = full_run();
  for (GapEvent& e : run.model_free->events) e.t_c = kNaN;
  EXPECT_TRUE(std::isnan(typical_passage(ReportView(run))->converged));
  EXPECT_NE(fig6_one_period(ReportView(run)).reading.find("t_c is not drawn"), std::string::npos);
}

TEST(Fig6, CallsNothingAnEstimateThatTheVerdictDoesNot) {
  RunResult run = full_run();
  run.model_free->verdict = GapVerdict::kInconclusive;
  const FigureData figure = fig6_one_period(ReportView(run));
  ASSERT_FALSE(figure.panels.empty());
  EXPECT_EQ(figure.panels[0].dimensions[0].label.find("hat"), std::string::npos);
  EXPECT_NE(figure.reading.find("no estimate of a gap"), std::string::npos);
}

TEST(Figures, OfTheErrorTellTheBoundOfItsDifferentiator) {
  RunResult run = full_run();
  run.model_free->bound_t1 = 6.0;
  const ReportView view(run);
  EXPECT_EQ(fig5_displacement_and_error(view).panels[1].title, "Estimation error, $L$ = 6 rad/s²");
  EXPECT_NE(fig6_one_period(view).panels[1].title.find("$L$ = 6 rad/s²"), std::string::npos);
  EXPECT_NE(fig2_input_and_displacement(view).panels.back().title.find("$L$ = 6"), std::string::npos);
}

TEST(Fig6, NamesTheCorrectionWhereS5IsNotTheEstimate) {
  RunResult run = full_run();
  for (GapEvent& e : run.model_free->events) e.gap *= 0.5;
  const FigureData figure = fig6_one_period(ReportView(run));
  EXPECT_EQ(figure.panels[0].dimensions[0].label.find("$|x_1(t_2)"), 0u);
  EXPECT_NE(figure.reading.find("travel of the load"), std::string::npos);
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

/// Where nothing is read and nothing is denied, marks of what was set aside would look like estimates.
TEST(Overview, ShowsNoPassagesWithoutAVerdict) {
  RunResult run = sample_run(
      {.samples = 7500, .load_recorded = false, .fitted = false, .verdict = GapVerdict::kInconclusive});
  for (GapEvent& e : run.model_free->events) e.accepted = false;
  const std::vector<FigureData> figures = all_figures(ReportView(run));
  for (const Panel& p : figures[0].panels) EXPECT_NE(p.title, "Passage by passage");
}

TEST(Overview, BeginsWithWhatTheCardSaysOfTheGap) {
  RunResult run = sample_run({.samples = 7500});
  run.answer.emplace().sentence = "The gap is not known (for many reasons).";
  run.answer->card.brief.gap = "The gap is not known.";
  EXPECT_EQ(all_figures(ReportView(run))[0].lines.front(), "The gap is not known.");
}

TEST(MissingFigures, SayWhy) {
  const RunResult detect = sample_run({.samples = 7500, .load_recorded = false, .fitted = false});
  const ReportView view(detect);
  EXPECT_EQ(fig3_backlash_map(view).missing, "the recording has no load position x2");
  EXPECT_EQ(residuals(view).missing, "no model was fitted");
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
