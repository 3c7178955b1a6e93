#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gapscope/report/changes_report.h"
#include "report/changes_figure.h"
#include "report/clear_texts.h"
#include "results/scratch_folder.h"
#include "support/png_file.h"
#include "support/reading.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::line_with;
using ::testing::Not;

Observation read(double value, double std) {
  return {value, std, {value - 1.96 * std, value + 1.96 * std}, ""};
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
    free.changes.push_back({0.001 * i, ci, 1e-9, ChangeVerdict::kChanged});
    fitted.changes.push_back({0.001 * i, ci, 1e-9, ChangeVerdict::kChanged});
  }
  free.observed[4] = {kNaN, kNaN, {0.0, 0.008}, "none above 0.008 rad"};
  free.changes[3] = {kNaN, {-0.019, -0.011}, 1e-9, ChangeVerdict::kChanged};
  free.observed[5] = {kNaN, kNaN, {}, "inconclusive"};
  free.changes[4] = {};
  all.quantities = {free, fitted};
  all.compared = 9;
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
    for (const char* expected : {"model-free", "reference", "model-free: none above", "recording_of_month_1"})
      EXPECT_THAT(texts, HasSubstr(expected));
    EXPECT_THAT(texts, HasSubstr(coordinates.rotational() ? "(mrad)" : "(mm)"));
    ASSERT_EQ(figure.panels.at(0).series.size(), 3u);
    EXPECT_EQ(figure.panels[0].series[0].y.size(), 6u);
    EXPECT_EQ(figure.panels[0].series[1].y, std::vector{0.008});
    EXPECT_EQ(figure.panels[0].title, "Estimates with 95 % intervals");
    all.quantities.pop_back();  // of the last report nobody tells a gap then
    EXPECT_EQ(internal::report::gap_over_recordings(all).panels.at(0).title,
              "Estimates with 95 % intervals (none of recording_of_month_6)");
  }
}

TEST(ChangesReport, IsDrawnFromTheStoredComparisonAlone) {
  ScratchFolder scratch;
  write_drive_changes(scratch.path.string(), sample_changes());
  write_changes_report(scratch.path.string());
  EXPECT_EQ(testing::picture_of((scratch.path / "gap_over_recordings.png").string()).cols, 1600);
  const std::string text = testing::text_of(scratch.path / "report.md");
  EXPECT_TOLD(line_with(text, "9 of 9 differences"));
  EXPECT_THAT(text, HasSubstr("](gap_over_recordings.png)"));
  EXPECT_TOLD(line_with(text, "| none above 8.00"));
  EXPECT_TOLD(line_with(text, "| inconclusive | cannot"));
  EXPECT_THAT(text, HasSubstr("- reports/recording_of_month_2: another excitation"));
}

TEST(ChangesReport, SeveralUnitsLieApartBesideWhatAFitDoes) {
  DriveChanges all = sample_changes();
  all.quantities.resize(1);
  all.quantities[0].observed = {read(0.010, 3e-3), read(0.018, 4e-3), {kNaN, kNaN, {0.0, 0.008}, "none"}};
  all.reports = {"out/hip", "out/knee", "out/toe"};
  const std::string text = spread_text(all);
  EXPECT_THAT(text, HasSubstr("hip                 knee                toe   "));
  EXPECT_TOLD(line_with(text, "0.01 ± 0.0059 "));
  all.reports[1] = "out/" + std::string(18, 'k') + "µµ";
  EXPECT_THAT(spread_text(all), HasSubstr(std::string(18, 'k') + "µ toe")) << "cut between letters";
  EXPECT_THAT(text, HasSubstr("0.00442     0.00354 rad"));  // sqrt(2 0.004² - 0.00354²), sqrt((3² + 4²)/2)
}

TEST(ChangesReport, OfReportsWithoutAGapHasNoFigure) {
  DriveChanges all = sample_changes();
  for (DriveQuantity& q : all.quantities) q.key = "load_damping", q.unit = "N m s/rad";
  EXPECT_THAT(internal::report::gap_over_recordings(all).missing, HasSubstr("no report tells a gap"));
  EXPECT_THAT(changes_text(all), Not(HasSubstr("mrad")));
}

}  // namespace
}  // namespace gapscope
