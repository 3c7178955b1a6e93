#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/changes_figure.h"
#include "report/changes_report.h"
#include "report/clear_texts.h"
#include "results/scratch_folder.h"
#include "support/png_file.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Observation read(double value, double std) {
  return {value, std, {value - 1.96 * std, value + 1.96 * std}, ""};
}

Observation at_most(double limit) {
  Observation o;
  o.at_most = limit, o.remark = "none is seen";
  return o;
}

Change changed(double difference, Interval ci95) {
  Change c;
  c.difference = difference, c.ci95 = c.together = ci95, c.p = 1e-9;
  c.verdict = ChangeVerdict::kChanged, c.reason = ChangeReason::kBeyondError;
  return c;
}

/// Six reports of which the last but one denies the gap and the last tells none.
DriveChanges sample_changes() {
  DriveChanges all;
  all.version = "1.2.3";
  DriveQuantity free{"gap", "model_free", "rad", {}, {}}, fitted{"gap", "reference", "rad", {}, {}};
  for (int i = 0; i < 6; ++i) {
    all.reports.push_back("reports/recording_of_month_" + std::to_string(i + 1));
    free.observed.push_back(read(0.019 + 0.001 * i, 2e-4));
    fitted.observed.push_back(read(0.0192 + 0.001 * i, 5e-5));
    if (i == 0) continue;
    const Interval ci{0.001 * i - 5e-4, 0.001 * i + 5e-4};
    free.changes.push_back(changed(0.001 * i, ci));
    fitted.changes.push_back(changed(0.001 * i, ci));
  }
  free.observed[4] = at_most(0.008);
  free.changes[3] = changed(kNaN, {-0.019, -0.011});
  free.observed[5] = {kNaN, kNaN, {}, "inconclusive"};
  free.changes[4] = {};
  all.quantities = {free, fitted};
  all.compared = 9;
  all.quantile = 2.77;
  all.lead = 1;
  all.codes = {"changed.reference.gap.rose"};
  all.warnings = {"reports/recording_of_month_2: another excitation"};
  return all;
}

TEST(ChangesReport, TheFigureShowsEveryReadingAndHoldsItsTextsApart) {
  for (const Coordinates coordinates : {Coordinates::kRotation, Coordinates::kTranslation}) {
    DriveChanges all = sample_changes();
    all.coordinates = coordinates;
    const internal::report::FigureData figure = internal::report::gap_over_recordings(all);
    const internal::report::Drawing drawing = internal::report::draw_with_notes(figure);
    internal::report::expect_clear_texts(figure, drawing);
    std::string texts;
    for (const internal::report::DrawnText& t : drawing.texts) texts += t.markup + "\n";
    for (const char* expected :
         {"gap (model-free)", "gap (fitted)", "gap (model-free): at most", "recording_of_month_1"})
      EXPECT_THAT(texts, HasSubstr(expected));
    EXPECT_THAT(texts, HasSubstr(coordinates.rotational() ? "(mrad)" : "(mm)"));
    ASSERT_EQ(figure.panels.at(0).series.size(), 3u);
    EXPECT_EQ(figure.panels[0].series[0].y.size(), 6u);
    EXPECT_EQ(figure.panels[0].series[1].y, std::vector{0.008});
    EXPECT_EQ(figure.panels[0].title, "Estimates with 95 % intervals");
    all.quantities.pop_back(), all.lead = 0;  // of the last report nobody tells a gap then
    EXPECT_EQ(internal::report::gap_over_recordings(all).panels.at(0).title,
              "Estimates with 95 % intervals (none of recording_of_month_6)");
  }
}

TEST(ChangesReport, LoopsOfOneTorqueLieOverOneAnother) {
  DriveChanges all = sample_changes();
  for (const int report : {0, 2, 5})
    all.loops.push_back({report, 4.0, {-4.0, 0.0, 4.0, 0.0, -4.0}, {-0.01, -0.005, 0.01, 0.005, -0.01}});
  all.loops.push_back({0, 25.0, {-25.0, 25.0, -25.0}, {-0.02, 0.02, -0.02}});
  const internal::report::FigureData figure = internal::report::gap_over_recordings(all);
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[1].series.size(), 3u);
  internal::report::expect_clear_texts(figure, internal::report::draw_with_notes(figure));
}

TEST(ChangesReport, IsDrawnFromTheStoredComparisonAlone) {
  ScratchFolder scratch;
  write_drive_changes(scratch.path.string(), sample_changes());
  write_changes_report(scratch.path.string());
  EXPECT_EQ(testing::picture_of((scratch.path / "gap_over_recordings.png").string()).cols, 1600);
  const std::string text = testing::text_of(scratch.path / "report.md");
  EXPECT_THAT(text,
              HasSubstr("9 changed, 0 same, 0 open, of 9 differences from reports/recording_of_month_1"));
  EXPECT_THAT(
      text,
      HasSubstr("**Changed: gap (fitted) rose from 19.200 ± 0.098 mrad to 24.200 ± 0.098 mrad, by 4.50 to "
                "5.50 mrad.**"));
  EXPECT_THAT(testing::text_of(scratch.path / "report.html"), HasSubstr("Changed: gap (fitted) rose"));
  EXPECT_THAT(text, HasSubstr("](gap_over_recordings.png)"));
  EXPECT_THAT(text, HasSubstr("| at most 8.00 mrad | −19.0 to −11.0 mrad, changed |"));
  EXPECT_THAT(text, HasSubstr("| inconclusive | open: not in both |"));
  EXPECT_THAT(text, HasSubstr("- reports/recording_of_month_2: another excitation"));
}

TEST(ChangesReport, SeveralUnitsLieApartBesideWhatAFitDoes) {
  DriveChanges all = sample_changes();
  all.quantities.resize(1);
  all.quantities[0].observed = {read(0.010, 3e-3), read(0.018, 4e-3), at_most(0.008)};
  all.reports = {"out/hip", "out/knee", "out/toe"};
  const std::string text = spread_text(all);
  EXPECT_THAT(text, HasSubstr("hip                 knee                toe   "));
  EXPECT_THAT(text, HasSubstr("0.01 ± 0.0059       0.018 ± 0.0078      < 0.008             0.014 "));
  all.reports[1] = "out/" + std::string(18, 'k') + "µµ";
  EXPECT_THAT(spread_text(all), HasSubstr(std::string(18, 'k') + "µ toe")) << "cut between letters";
  EXPECT_THAT(text, HasSubstr("0.00442     0.00354 rad"));  // sqrt(2 0.004² - 0.00354²), sqrt((3² + 4²)/2)
}

TEST(ChangesReport, OfReportsWithoutAGapHasNoFigure) {
  DriveChanges all = sample_changes();
  for (DriveQuantity& q : all.quantities) q.key = "load_damping", q.unit = "N m s/rad";
  EXPECT_THAT(internal::report::gap_over_recordings(all).missing, HasSubstr("no report gives a gap"));
  all.lead = -1;
  EXPECT_THAT(changes_text(all), Not(HasSubstr("mrad")));
}

}  // namespace
}  // namespace gapscope
