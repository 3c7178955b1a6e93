#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>

#include "report/clear_texts.h"
#include "report/detectable.h"
#include "report/diagnosis_figures.h"
#include "report/draw_figure.h"
#include "report/error_budget.h"
#include "report/last_resort.h"
#include "report/report.h"
#include "results/diagnosis_result.h"
#include "results/scratch_folder.h"
#include "support/png_file.h"
#include "support/reading.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::line_with;
using testing::text_of;
namespace fs = std::filesystem;

std::vector<MapShare> map_of(std::initializer_list<std::string> bins) {
  std::vector<MapShare> map;
  for (const std::string& bin : bins) map.push_back({bin, 1.0 / static_cast<double>(bins.size()), 0.5});
  return map;
}

DiagnosisResult sample(DiagnosisVerdict verdict) {
  DiagnosisResult r{"rig_p", "0.1", "", {}, {}};
  Diagnosis& d = r.diagnosis;
  d.verdict = verdict;
  d.sentence = "The model lacks cogging torque.";
  if (verdict == DiagnosisVerdict::kEffect) d.effects = d.group = {"cogging_torque"};
  d.mismatch.measure = "free run restarted every 0.5 s";
  d.mismatch.before = 2e-3, d.mismatch.after = 3e-5, d.mismatch.floor = 2e-5;
  d.mismatch.floor_of = "the quantum of the encoder in held.csv";
  d.mismatch.shrink = 0.99, d.mismatch.shrink_ci95 = {0.9, 1.0}, d.mismatch.remains = 1.5;
  if (verdict == DiagnosisVerdict::kEffect)
    d.added = {
        {"cogging_torque", true, d.group, kNaN, {{"amplitude_nm", "N m", 0.004}}, 0.99, {0.9, 1.0}, 0.01}};
  d.measures = {{"free run restarted every 0.5 s", "rad", 2e-3, 3e-5, 2e-5},
                {"residual torque", "N m", 0.1, 0.01, kNaN}};
  for (const char* name : {"cogging_torque", "torque_ripple", "input_delay"}) {
    RankedEffect e;
    e.effect = name;
    e.probability = e.rel = e.shrink = d.ranking.empty() ? 0.9 : 0.1;
    e.parameters = {{"amplitude_nm", "N m", 0.004}};
    d.ranking.push_back(e);
  }
  d.where.headline = "in engagement, periodic in the motor angle with 24 cycles per turn";
  d.where.mode = map_of({"gap", "engagement", "impact"});
  d.where.direction = {{"backward", 0.6, 0.5}, {"forward", 0.4, 0.5}};
  d.where.speed = d.where.angle = d.where.input = d.where.frequency = d.where.time =
      map_of({"0..1", "1..2", "2..3"});
  d.where.periods_per_turn = 24.0;
  d.periodic = {{24.3, 2.0 * kPi / 24.3, 0.002, 0.4, 31.0, 20, 19, true, false}};
  d.blame = {{"motor_damping", "N m s/rad", 0.08, 0.06}};
  MismatchTrace t;
  t.file = "held.csv", t.dt = 1e-3;
  for (int i = 0; i < 4000; ++i) {
    const double x = std::sin(0.006 * i);
    t.u.push_back(x), t.x1.push_back(x), t.mode.push_back(Mode::kGap);
    t.error_before.push_back(2e-3 * x), t.error_after.push_back(2e-5 * x);
    t.torque_before.push_back(0.1 * std::sin(24.0 * x)), t.torque_after.push_back(1e-3 * x);
  }
  d.traces = {t};
  return r;
}

TEST(DiagnosisReport, EveryFigureIsThereAndNotBlankAndTheTextShowsTheBlame) {
  ScratchFolder scratch;
  write_diagnosis_result(scratch.path.string(), sample(DiagnosisVerdict::kEffect));
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  for (const char* name : {"diagnosis.png", "diagnosis_traces.png", "diagnosis_ranking.png",
                           "diagnosis_where.png", "diagnosis_torque_map.png"}) {
    const cv::Mat image = testing::picture_of((scratch.path / name).string());
    ASSERT_FALSE(image.empty()) << name;
    cv::Scalar centre, spread;
    cv::meanStdDev(image, centre, spread);
    EXPECT_GT(spread[0], 10.0) << name << " is blank";
    EXPECT_NE(text.find("](" + std::string(name) + ")"), std::string::npos) << name;
  }
  EXPECT_NE(text.find("| `motor_damping` | 0.0800 N·m s/rad"), std::string::npos) << text;
  EXPECT_NE(text.find("33 % high"), std::string::npos) << text;
  EXPECT_NE(text.find("| correcting torque | 100 mN·m | 10.0 mN·m | – |"), std::string::npos) << text;
  EXPECT_NE(text.find("| 259 mrad | 24.3 | 2.00 mN·m | 31 times | 19 of 20 | yes |"), std::string::npos)
      << text;
}

TEST(DiagnosisReport, NamesTheFloorAndWhereItComesFrom) {
  ScratchFolder scratch;
  DiagnosisResult r = sample(DiagnosisVerdict::kEffect);
  r.diagnosis.outside_probability = 0.57;
  const auto written = [&] {
    write_diagnosis_result(scratch.path.string(), r);
    write_report(scratch.path.string());
    return text_of(scratch.path / "report.md");
  };
  std::string text = written();
  EXPECT_NE(text.find("is the encoder floor: the quantum of the encoder in held.csv."), std::string::npos);
  EXPECT_NE(text.find("probability 0.57 that the cause is not in the catalogue"), std::string::npos);
  EXPECT_NE(text.find("- *explained share*: "), std::string::npos);
  EXPECT_EQ(text.find("- *repeatability floor*: "), std::string::npos) << "a word that does not occur";
  r.diagnosis.mismatch.floor_from = FloorSource::kRepeatability;
  r.diagnosis.mismatch.floor_of = "3.9 periods of 6.24 s in held.csv";
  text = written();
  EXPECT_NE(text.find("is the repeatability floor: 3.9 periods of 6.24 s in held.csv."), std::string::npos);
  EXPECT_EQ(text.find("0.57"), std::string::npos) << "learned on other drives";
}

TEST(DiagnosisReport, WhereTheBudgetDecidesTheCandidatesAreToldToBeEachAlone) {
  DiagnosisResult r = sample(DiagnosisVerdict::kEffect);
  r.diagnosis.outside_probability = 0.57;
  BudgetRung rung;
  rung.law = rung.effect = "load_unbalance", rung.added = true;
  rung.before = 0.1, rung.after = 0.02;
  r.diagnosis.budget.nominal = 0.1, r.diagnosis.budget.remains = 0.02, r.diagnosis.budget.input = 1.0;
  r.diagnosis.budget.rungs = {rung};
  r.diagnosis.effects = {"load_unbalance"};
  const std::string alone = "did not decide here: the error budget did", odds = "0.57";
  std::string text = internal::report::diagnosis_text(r);
  EXPECT_NE(text.find(alone), std::string::npos);
  EXPECT_EQ(text.find(odds), std::string::npos) << "that of another question";
  EXPECT_NE(internal::report::diagnosis_ranking(r).reading.find("the error budget decides"),
            std::string::npos);
  r.diagnosis.effects = {"cogging_torque"};
  text = internal::report::diagnosis_text(r);
  EXPECT_EQ(text.find(alone), std::string::npos) << "both begin with the same";
  EXPECT_NE(text.find(odds), std::string::npos);
}

TEST(DiagnosisReport, TheCaptionKnowsOfTheLineThatTheTableLists) {
  DiagnosisResult r = sample(DiagnosisVerdict::kEffect);
  r.diagnosis.where.periods_per_turn = kNaN;
  r.coordinates = Coordinates::kTranslation;
  r.diagnosis.periodic.front().periods_per_turn = 2.0 * kPi / 2.5e-3;
  const std::string reading = internal::report::diagnosis_torque_map(r).reading;
  EXPECT_NE(
      reading.find("No cycle over the displacement stands out of what the nominal model leaves. In what "
                   "remains with cogging torque one does: every 2.50 mm."),
      std::string::npos)
      << reading;
}

TEST(DiagnosisReport, ALawOfLastResortIsDrawnThroughTheResidualAndItsTableIsNamed) {
  DiagnosisResult r = sample(DiagnosisVerdict::kUnknown);
  LastResortLaw law;
  law.law = "friction_curve", law.variable = "speed";
  law.shrink = 0.8, law.shrink_ci95 = {0.7, 0.9}, law.before_torque = 0.02, law.after_torque = 0.004;
  for (const int side : {-1, 1})
    for (int k = 0; k < 7; ++k) {
      const double at = side < 0 ? -3.0 + 0.5 * k : 0.5 * k;
      law.curve.push_back({at, side, 0.01 * side, {0.01 * side - 0.002, 0.01 * side + 0.002}});
      law.residual.push_back({at, side, 50, 0.011 * side, 0.001});
    }
  r.diagnosis.laws = {law};
  const internal::report::FigureData figure = internal::report::diagnosis_law(r);
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[0].series.size(), 2u);
  ASSERT_EQ(figure.panels[1].series.size(), 3u);                 // both directions and the law
  EXPECT_DOUBLE_EQ(figure.panels[1].series[1].y.back(), 0.011);  // the law and what it leaves
  EXPECT_EQ(figure.panels[1].series[2].x.size(), 15u) << "interrupted at standstill";
  EXPECT_EQ(figure.panels[0].y.range.high, figure.panels[1].y.range.high);
  const std::string table = internal::report::law_table(r);
  EXPECT_NE(table.find("as a function of speed"), std::string::npos) << table;
  EXPECT_NE(table.find("`compensation_friction_curve.csv`"), std::string::npos) << table;
  r.diagnosis.laws.clear();
  EXPECT_FALSE(internal::report::diagnosis_law(r).missing.empty());
  EXPECT_TRUE(internal::report::law_table(r).empty());
}

TEST(DiagnosisReport, TheTorqueMapShowsWhatRemainsBesideWhatTheNominalModelLeaves) {
  DiagnosisResult r = sample(DiagnosisVerdict::kEffect);
  const auto both = internal::report::diagnosis_torque_map(r);
  ASSERT_EQ(both.panels.size(), 6u);
  EXPECT_EQ(both.panels[0].title, "Nominal model, over the motor angle");
  EXPECT_TRUE(both.panels[1].title.starts_with("With cogging torque, over the motor angle"));
  EXPECT_EQ(both.panels[2].title, "Nominal model, over the speed");
  EXPECT_EQ(both.panels[0].series.back().label, "");
  const auto& over_speed = both.panels[2].series;
  const auto law = std::find_if(over_speed.begin(), over_speed.end(),
                                [](const auto& s) { return s.label == "taken by what was added"; });
  ASSERT_NE(law, over_speed.end());
  for (const double speed : law->x)
    EXPECT_GT(speed, 0.0) << "that of the other direction is a line of its own";
  for (const double speed : over_speed.back().x) EXPECT_LT(speed, 0.0);
  EXPECT_NE(both.panels[0].series[0].y, both.panels[1].series[0].y);
  EXPECT_EQ(both.panels[0].series[0].x, both.panels[1].series[0].x);
  r.diagnosis.effects.clear();
  EXPECT_EQ(internal::report::diagnosis_torque_map(r).panels.size(), 3u);
  r.diagnosis.where.follows = {ResidualPattern::kDirection, ResidualPattern::kSpeed};
  EXPECT_EQ(internal::report::diagnosis_torque_map(r).panels[0].title, "Nominal model, over the speed");
}

TEST(DiagnosisReport, AMapOfAnErrorThatIsAlikeEverywhereIsLeftOut) {
  DiagnosisResult r = sample(DiagnosisVerdict::kUnknown);
  r.diagnosis.where.direction = {{"backward", 0.51, 0.5}, {"forward", 0.49, 0.5}};
  for (const auto& panel : internal::report::diagnosis_where(r).panels)
    EXPECT_NE(panel.title, "Direction of motion");
}

TEST(DiagnosisReport, AMapOfOnePlaceIsLeftOutAndSoAreNoCandidatesInSilence) {
  DiagnosisResult r = sample(DiagnosisVerdict::kUnknown);
  r.diagnosis.where.mode = {{"gap", 0.0, 0.0}, {"engagement", 1.0, 1.0}, {"impact", 0.0, 0.0}};
  const auto where = internal::report::diagnosis_where(r);
  ASSERT_EQ(where.panels.size(), 6u);
  EXPECT_EQ(where.panels.front().title, "Direction of motion");
  while (r.diagnosis.ranking.size() < 18) r.diagnosis.ranking.push_back(r.diagnosis.ranking.back());
  EXPECT_TRUE(internal::report::diagnosis_ranking(r).panels[0].title.ends_with("step: 12 of 18"));
}

TEST(DiagnosisReport, WithoutCandidatesTheRankingIsLeftOutWithItsReason) {
  DiagnosisResult none = sample(DiagnosisVerdict::kNone);
  none.diagnosis.ranking.clear();
  const auto figure = internal::report::diagnosis_ranking(none);
  EXPECT_NE(figure.missing.find("at the floor"), std::string::npos);
}

TEST(DiagnosisReport, BarsEndAtTheShares) {
  const auto figure = internal::report::diagnosis_where(sample(DiagnosisVerdict::kUnknown));
  ASSERT_EQ(figure.panels.size(), 7u);
  const auto& series = figure.panels[0].series.front();
  ASSERT_EQ(series.x.size(), 3u);
  EXPECT_DOUBLE_EQ(series.x_intervals[0].high, 1.0 / 3.0);
}

/// A drive of one body whose budget has an effect of the model and a law that the catalogue lacks.
DiagnosisResult with_budget() {
  DiagnosisResult r = sample(DiagnosisVerdict::kEffect);
  ErrorBudget& b = r.diagnosis.budget;
  b.band_hz = 64.0, b.input = 1.0, b.nominal = 0.1, b.with_effects = 0.05, b.remains = 0.02,
  b.encoder = 0.004;
  BudgetRung cogging{"cogging_torque", "cogging_torque", true, 0.1, 0.05, 0.75, {0.6, 0.9}, 0.75, 0.8,
                     2.0 * kPi / 24.0};
  BudgetRung friction{"load_friction", "", false, 0.05, 0.02, 0.84, {0.7, 0.9}, 0.2, 0.84, kNaN};
  b.rungs = {cogging, friction};
  return r;
}

TEST(ErrorBudgetReport, TellsEachLawWithItsShareAndTheFloor) {
  const std::string text = internal::report::budget_table(with_budget());
  EXPECT_TOLD(line_with(text, "| cogging torque, 24"));
  EXPECT_TOLD(line_with(text, "| load friction (not"));
  EXPECT_TOLD(line_with(text, "Floors, which no model"));
  EXPECT_EQ(internal::report::budget_table(sample(DiagnosisVerdict::kEffect)), "");
}

TEST(ErrorBudgetReport, TheFigureShowsTheFallAndHoldsItsTextsApart) {
  const internal::report::FigureData figure = internal::report::diagnosis_budget(with_budget());
  ASSERT_EQ(figure.panels.size(), 1u);
  EXPECT_EQ(figure.panels[0].tiles.size(), 4u);  // before, two laws, what remains
  EXPECT_EQ(figure.panels[0].title, "Rms below 64 Hz (% of the input's)")
      << "the figure has its title already";
  const internal::report::Drawing drawing = internal::report::draw_with_notes(figure);
  internal::report::expect_clear_texts(figure, drawing);
  EXPECT_FALSE(internal::report::diagnosis_budget(sample(DiagnosisVerdict::kEffect)).missing.empty());
}

/// One that can be shown, one that another hides.
DiagnosisResult with_detectable() {
  DiagnosisResult r = with_budget();
  r.diagnosis.mismatch.input_torque = 1.0, r.diagnosis.mismatch.after_torque = 0.02;
  r.diagnosis.detectable = {
      {"actuator_lag", {"time_constant_s", "s", kNaN}, {}, "input_delay", "it acts as a delay does", kNaN},
      {"input_delay", {"delay_s", "s", 3e-4}, {}, "", "", 0.004},
      {"torque_ripple", {"ratio", "-", 0.02}, {{"periods_per_turn", "1/rev", 24.0}}, "", "", 0.014}};
  return r;
}

TEST(DetectableReport, TellsTheAmountsInAPlainSentenceAndATable) {
  const std::string text = internal::report::detectable_table(with_detectable());
  EXPECT_TOLD(line_with(text, "Input delay of more"));
  EXPECT_TOLD(line_with(text, "| `torque_ripple` | 2"));
  EXPECT_TOLD(line_with(text, "| `actuator_lag` | –"));
  EXPECT_EQ(internal::report::detectable_table(with_budget()), "");
}

TEST(DetectableReport, TheFigureDrawsWhatCanBeShownAndHoldsItsTextsApart) {
  const internal::report::FigureData figure = internal::report::diagnosis_detectable(with_detectable());
  ASSERT_EQ(figure.panels.size(), 1u);
  ASSERT_EQ(figure.panels[0].tiles.size(), 2u);
  EXPECT_NEAR(figure.panels[0].tiles[0].x.high, std::log10(0.4), 1e-12);
  const internal::report::Drawing drawing = internal::report::draw_with_notes(figure);
  internal::report::expect_clear_texts(figure, drawing);
  EXPECT_FALSE(internal::report::diagnosis_detectable(with_budget()).missing.empty());
}

}  // namespace
}  // namespace gapscope
