#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "report/blind_figures.h"
#include "report/blind_report.h"
#include "report/clear_texts.h"
#include "report/draw_figure.h"
#include "report/implant_report.h"
#include "support/temporary_file.h"
#include "support/told.h"

namespace gapscope::internal::report {
namespace {

using ::testing::HasSubstr;
using testing::line_with;
using ::testing::Not;

BlindScore sample_score() {
  BlindScore s;
  s.name = "sample", s.version = "1";
  s.report_cases = 60, s.calibration_cases = 20;
  s.counts = {{"one effect: named", 17, 20, 0.9, false}, {"no effect: one blamed", 0, 20, 0.01, true}};
  s.confusion = {{"input_delay", "input_delay", 17}, {"input_delay", "quadratic_drag", 1},
                 {"input_delay", "unknown", 2},      {"outside", "unknown", 18},
                 {"outside", "input_delay", 2},      {"none", "none", 20}};
  s.slices = {{"rig", "paper", 25, 20, 18, 17, 1, 0.98}, {"effect", "input_delay", 25, 20, 18, 15, 1, 0.98}};
  s.calibration.judged_on = 60, s.calibration.learnt_on = 50, s.calibration.weights = {0, 1, 2, 3};
  s.calibration.bins = {{20, 0.1, 1}, {0, kNaN, 0}, {40, 0.9, 37}};
  s.abstention = {{0.0, 60, 38}, {0.5, 40, 37}, {0.95, 0, 0}};
  s.cases = {
      {"case_001", "report", "paper", "input_delay", "effect", "quadratic_drag", 0.4, 12.0, 0.5, 0.7, false},
      {"case_002", "report", "paper", "input_delay", "effect", "input_delay", 0.4, 12.0, 0.9, 0.7, true}};
  return s;
}

const FigureData& named(const std::vector<FigureData>& figures, const std::string& file) {
  return *std::find_if(figures.begin(), figures.end(), [&](const FigureData& f) { return f.file == file; });
}

TEST(BlindFigures, HaveNoTextsThatMeetOrAreCut) {
  std::set<std::string> not_drawn;
  for (const FigureData& figure : blind_figures(sample_score())) {
    if (!figure.missing.empty()) {
      not_drawn.insert(figure.file);
      continue;
    }
    const Drawing drawing = draw_with_notes(figure);
    expect_clear_texts(figure, drawing);
  }
  EXPECT_THAT(not_drawn, ::testing::ElementsAre("by_severity.png")) << "of which the sample has no slice";
}

TEST(BlindFigures, ConfusionMarksWrongNamesAndNoneThatClaimNothing) {
  const auto figures = blind_figures(sample_score());
  const FigureData& figure = named(figures, "confusion.png");
  ASSERT_EQ(figure.panels[0].tiles.size(), 6u);
  const auto red = [&](std::size_t i) { return figure.panels[0].tiles[i].colour.red; };
  EXPECT_EQ(red(1), red(4));  // another effect blamed
  EXPECT_NE(red(0), red(1));
  EXPECT_NE(red(2), red(1));
  EXPECT_EQ(red(0), red(5));
  EXPECT_TOLD(line_with(figure.reading, "Right in 55 of"));
}

TEST(BlindFigures, CalibrationLeavesOutBinsWithoutCases) {
  const auto figures = blind_figures(sample_score());
  const FigureData& figure = named(figures, "calibration.png");
  EXPECT_EQ(figure.panels[0].series[1].x.size(), 2u);
  EXPECT_DOUBLE_EQ(figure.panels[0].series[1].y[1], 92.5);
  EXPECT_EQ(figure.panels[1].series[0].x.size(), 2u);
}

TEST(BlindReport, SaysWhatWasMissedAndListsEveryWrongAnswer) {
  const testing::TemporaryFile place("");
  write_blind_score(place.folder().string(), sample_score());
  write_blind_report(place.folder().string());
  std::ostringstream text;
  text << std::ifstream(place.folder() / "report.md").rdbuf();
  EXPECT_TOLD(line_with(text.str(), "- one effect: named:"));
  EXPECT_TOLD(line_with(text.str(), "- input_delay is named"));
  EXPECT_THAT(text.str(), Not(HasSubstr("- no effect")));
  EXPECT_TOLD(line_with(text.str(), "| case_001 | paper"));
  EXPECT_THAT(text.str(), Not(HasSubstr("case_002")));
}

BlindScore implanted_score() {
  BlindScore s;
  s.name = "axis", s.version = "1", s.report_cases = 4;
  s.counts = {{"implant with a foretold share of 0.3 or more: named or in the group", 1, 2, 0.85, false}};
  const auto add = [&](const char* truth, const char* verdict, const char* named, ScoredImplant implant) {
    ScoredCase c{"case_001", "report", "axis", truth, verdict, named, 0.1, kNaN, kNaN, kNaN, false, implant};
    s.cases.push_back(c);
  };
  add("input_delay", "effect", "input_delay", {0.1, 0.84, "delay_s", "s", 0.0029, true, false});
  add("quadratic_drag", "effect", "input_delay",
      {0.1, 0.32, "coefficient_nms2", "N m s^2", 0.4, false, true});
  add("knocks", "unknown", "", {0.1, 0.93, "peak_nm", "N m", 73.0, false, false});
  add("none", "none", "", {});
  return s;
}

TEST(ImplantFigure, HasNoTextsThatMeetOrAreCut) {
  const FigureData figure = implant_figure(implanted_score());
  ASSERT_TRUE(figure.missing.empty());
  expect_clear_texts(figure, draw_with_notes(figure));
}

TEST(ImplantFigure, DrawsEachCaseAtItsForetoldShareAndCountsWhatWasNamed) {
  const FigureData figure = implant_figure(implanted_score());
  ASSERT_EQ(figure.panels.size(), 1u);
  const Panel& p = figure.panels.front();
  EXPECT_THAT(p.y.categories, ::testing::SizeIs(3));
  EXPECT_THAT(p.y.remarks, ::testing::ElementsAre("1/1", "0/1", "0/1"));
  ASSERT_EQ(p.series.size(), 3u);
  EXPECT_THAT(p.series[0].x, ::testing::ElementsAre(84.0));
  EXPECT_THAT(p.series[2].x, ::testing::ElementsAre(32.0));
  BlindScore contact = implanted_score();
  for (ScoredCase& c : contact.cases) c.implant->foretold_share = kNaN;
  EXPECT_THAT(implant_figure(contact).missing, HasSubstr("foretold"));
}

TEST(ImplantReport, SaysOfEveryCaseWhatWasPutInAndWhatWasMadeOfIt) {
  const testing::TemporaryFile place("");
  write_blind_score(place.folder().string(), implanted_score());
  write_blind_report(place.folder().string());
  std::ifstream in(place.folder() / "report.md");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TOLD(line_with(text, "| input_delay | 0.0029"));
  EXPECT_THAT(text, HasSubstr("**another one**"));
  EXPECT_THAT(text, HasSubstr("1 of 2"));
  EXPECT_THAT(text, Not(HasSubstr("shares no code")));
}

}  // namespace
}  // namespace gapscope::internal::report
