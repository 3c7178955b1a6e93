#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "report/budget_band.h"
#include "report/clear_texts.h"
#include "report/diagnosis_figures.h"
#include "report/draw_figure.h"
#include "report/error_budget.h"
#include "report/full_run.h"
#include "report/markdown.h"
#include "report/view_signals.h"
#include "support/told.h"

namespace gapscope {
namespace {

using internal::report::band_words;
using internal::report::diagnosis_budget;
using internal::report::diagnosis_torque_map;
using internal::report::diagnosis_traces;
using internal::report::FigureData;
using internal::report::informative_reach;
using internal::report::Panel;
using internal::report::Series;
using internal::report::within_band;
using ::testing::HasSubstr;
using testing::line_with;

/// One body with friction of 1 N m that was missing, read by an encoder whose noise is ten times that.
DiagnosisResult coarse_result() {
  DiagnosisResult r{"coarse", "0.1", "", {}, {}};
  Diagnosis& d = r.diagnosis;
  d.effects = {"motor_coulomb_friction"};
  d.budget.band_hz = 10.0, d.budget.input = 5.0, d.budget.nominal = 1.0, d.budget.remains = 0.1;
  MismatchTrace t;
  t.dt = 1e-3;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 10.0);
  for (int i = 0; i < 20000; ++i) {
    const double angle = 2.0 * kPi * 0.5 * t.dt * i, spike = i % 10000 == 5000 ? 2000.0 : 0.0,
                 n = noise(random);
    t.u.push_back(std::sin(angle)), t.x1.push_back(1.0 - std::cos(angle)),
        t.mode.push_back(Mode::kEngagementPlus);
    t.error_before.push_back(0.0), t.error_after.push_back(0.0);
    t.torque_before.push_back((std::sin(angle) > 0.0 ? 1.0 : -1.0) + n + spike);
    t.torque_after.push_back(n + spike);
  }
  d.traces = {t};
  return r;
}

/// The series of a panel that counts what lies outside; nullptr: there is none.
const Series* outside_of(const Panel& panel) {
  for (const Series& s : panel.series)
    if (s.label.find("outside") != std::string::npos) return &s;
  return nullptr;
}

TEST(ResidualScale, ReachesToAllValuesUnlessAFewLieFarAway) {
  std::vector<double> values(1000, 1.0);
  for (std::size_t i = 0; i < values.size(); i += 2) values[i] = -0.5;
  values[3] = 1.4;
  EXPECT_DOUBLE_EQ(informative_reach(values, 0.0), 1.4) << "near enough to be drawn";
  values[3] = -40.0, values[4] = kNaN;
  EXPECT_DOUBLE_EQ(informative_reach(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(informative_reach(values, 3.0), 3.0) << "the law and the band are always shown";
  EXPECT_DOUBLE_EQ(informative_reach(values, 50.0), 40.0) << "a frame without values shows nothing";
  EXPECT_DOUBLE_EQ(informative_reach({}, 2.0), 0.0);
}

TEST(ResidualScale, TheBandIsThatOfTheBudget) {
  MismatchTrace t;
  t.dt = 1e-3, t.scored_from = 100;
  t.x1.assign(8000, 0.0);
  const auto left_of = [&](double hz) {
    std::vector<double> wave(t.x1.size());
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = std::sin(2.0 * kPi * hz * t.time(i));
    wave[5000] = kNaN;
    ErrorBudget budget;
    budget.band_hz = 10.0;
    const std::vector<double> shown = within_band(budget, t, wave);
    EXPECT_TRUE(std::isnan(shown[5000]) && std::isfinite(shown[5001]));
    double power = 0.0;
    for (std::size_t i = 1000; i < 4000; ++i) power += shown[i] * shown[i] / 3000.0;
    return std::sqrt(2.0 * power);
  };
  EXPECT_GT(left_of(1.0), 0.98);
  EXPECT_NEAR(left_of(10.0), std::sqrt(0.5), 0.03);
  EXPECT_LT(left_of(100.0), 0.12);
  EXPECT_EQ(band_words({}, t), "") << "no budget";
  ErrorBudget wide;
  wide.band_hz = 900.0;
  EXPECT_EQ(band_words(wide, t), "") << "nothing is above it";
  EXPECT_EQ(within_band(wide, t, t.x1), t.x1);
}

TEST(ResidualScale, TheEndsOfTheRecordingHaveNoMeanOfTheirOwn) {
  MismatchTrace t;
  t.dt = 1e-3, t.x1.assign(2000, 0.0), t.scored_from = 500;
  std::vector<double> torque(2000, 0.005);
  torque.back() = -0.06, torque[500] = 0.06;  // what an observer at 30 Hz makes of a sample
  ErrorBudget budget;
  budget.band_hz = 23.0;
  std::vector<double> shown = within_band(budget, t, torque);
  EXPECT_TRUE(std::isnan(shown.back()) && std::isnan(shown[500]));
  for (const double v : shown) EXPECT_FALSE(std::abs(v) > 0.01) << "one sample, in a mean of 19";
  EXPECT_TRUE(std::isfinite(shown[1500]));
}

TEST(ResidualScale, TheMapShowsTheLawOfACoarseEncoderAndCountsWhatLiesOutside) {
  const DiagnosisResult r = coarse_result();
  for (const Panel& panel : diagnosis_torque_map(r).panels) {
    EXPECT_LT(panel.y.range.high, 20.0) << panel.title << ": spikes of 50 after the band";
    EXPECT_GE(panel.y.range.high, 1.0) << panel.title;
    const Series* outside = outside_of(panel);
    std::size_t beyond = 0;
    for (const Series& s : panel.series)
      for (const double y : s.y)
        if (&s != outside && std::abs(y) > panel.y.range.high) ++beyond;
    ASSERT_EQ(outside != nullptr, beyond > 0) << panel.title;
    if (outside == nullptr) continue;
    EXPECT_EQ(outside->x.size(), beyond);
    EXPECT_THAT(outside->label, HasSubstr(std::to_string(beyond) + " of "));
    for (const double y : outside->y) EXPECT_LT(std::abs(y), panel.y.range.high) << "seen at the edge";
  }
  EXPECT_TOLD(line_with(diagnosis_torque_map(r).panels[0].title, "Nominal model below 10"));
  EXPECT_THAT(diagnosis_traces(r).panels[2].title, HasSubstr("Correcting torque below 10 Hz"));
}

TEST(ResidualScale, MeansAreDrawnWhereTheSamplesWouldBeABlackBlock) {
  DiagnosisResult r = coarse_result();
  r.diagnosis.budget = {};
  const Panel means = diagnosis_traces(r).panels[2];
  EXPECT_EQ(means.title, "Correcting torque, mean of 100 ms");
  ASSERT_EQ(means.series.size(), 2u);
  for (const Series& s : means.series) EXPECT_EQ(s.y.size(), 200u);
  EXPECT_NEAR(means.series[0].x.front(), 0.0495, 1e-9) << "the middle of the first hundred samples";
  double before = 0.0, after = 0.0;
  for (std::size_t i = 1; i < 9; ++i)  // a half-wave without a spike
    before += means.series[0].y[i] / 8.0, after += means.series[1].y[i] / 8.0;
  EXPECT_NEAR(before - after, 1.0, 1e-9);

  std::vector<double>& left = r.diagnosis.traces[0].torque_after;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = std::sin(1e-3 * static_cast<double>(i));
  EXPECT_EQ(diagnosis_traces(r).panels[2].title, "Correcting torque") << "a line";
  EXPECT_EQ(diagnosis_traces(r).panels[2].series[0].y.size(), 20000u);
}

TEST(ResidualScale, TheLawIsInTheFrameAndABandBeyondTheDataIsNot) {
  DiagnosisResult r = coarse_result();
  r.diagnosis.budget.nominal = 500.0;
  for (double& torque : r.diagnosis.traces[0].torque_after)
    torque -= 100.0;  // the law takes more than there was
  const Panel panel = diagnosis_torque_map(r).panels[0];
  EXPECT_GT(panel.y.range.high, 100.0);
  EXPECT_LT(panel.y.range.high, 120.0);
}

TEST(ResidualScale, TheBudgetShowsItsFloorOrSaysThatItLiesOutside) {
  DiagnosisResult r = coarse_result();
  r.diagnosis.budget.encoder = 1.5;
  FigureData figure = diagnosis_budget(r);
  ASSERT_EQ(figure.panels[0].x_marks.size(), 1u);
  EXPECT_GE(figure.panels[0].x.range.high, 1.5);
  const auto in_legend = [&](const char* label) {
    return std::any_of(figure.panels[0].series.begin(), figure.panels[0].series.end(),
                       [&](const Series& s) { return s.label == label; });
  };
  EXPECT_TRUE(in_legend("floor: the encoder resolves no less"));
  r.diagnosis.budget.records = 1.6;
  figure = diagnosis_budget(r);
  EXPECT_TRUE(in_legend("floor: recordings disagree by this"));
  r.diagnosis.budget.records = kNaN;
  r.diagnosis.budget.encoder = 40.0;
  figure = diagnosis_budget(r);
  EXPECT_TRUE(figure.panels[0].x_marks.empty());
  EXPECT_LT(figure.panels[0].x.range.high, 1.1);
  EXPECT_TOLD(line_with(figure.reading, "The floor (encoder), 40.0"));
}

TEST(GuessedConstant, IsToldOnEveryAxisOfTorqueAndHoldsItsTextsApart) {
  DiagnosisResult r = coarse_result();
  const std::string note = "$K_m$ guessed";
  for (const bool guessed : {false, true}) {
    r.input = InputFacts{"", guessed};
    for (const FigureData& figure : {diagnosis_budget(r), diagnosis_traces(r), diagnosis_torque_map(r)}) {
      const internal::report::Drawing drawing = internal::report::draw_with_notes(figure);
      internal::report::expect_clear_texts(figure, drawing);
      for (const internal::report::PanelPlan& plan : drawing.plans)
        for (const internal::report::AxisPlan* axis : {&plan.x, &plan.y}) {
          const bool torque = axis->label.find("N·m") != std::string::npos;
          EXPECT_EQ(axis->label.find(note) != std::string::npos, torque && guessed) << axis->label;
        }
    }
  }
}

TEST(GuessedConstant, IsToldWhereARunDrawsTheTorqueOfTheMotor) {
  RunResult run = internal::report::full_run();
  const auto axis_of = [&] { return internal::report::drive_signal(internal::report::ReportView(run)).axis; };
  run.input = InputFacts{"A", false};
  EXPECT_EQ(axis_of().unit_note, "");
  run.input->constant_guessed = true;
  EXPECT_EQ(axis_of().unit_note, "$K_m$ guessed");
  FittedParameter constant;
  constant.key = "torque_constant", constant.unit = "N m", constant.value = 1.0;
  run.reference->parameters.push_back(constant);
  EXPECT_NE(internal::report::estimate_text(run, {}).find("damping and stiffness here is off by its factor"),
            std::string::npos);
  run.reference.reset();
  EXPECT_EQ(axis_of().unit_note, "") << "the input itself rests on nothing";
}

}  // namespace
}  // namespace gapscope
