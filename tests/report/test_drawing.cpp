#include <gtest/gtest.h>

#include "report/clear_texts.h"
#include "report/draw_figure.h"
#include "report/figures.h"
#include "report/sample_run.h"

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kKinds = 7;

RunResult kind_of_run(std::size_t kind) {
  const SampleOptions options[kKinds] = {
      {.samples = 15000},
      {.samples = 60000, .rate = 5000.0, .frequency = 3.0},
      {.samples = 6000, .coordinates = Coordinates::kTranslation},
      {.samples = 9000, .load_recorded = false, .verdict = GapVerdict::kInconclusive},
      {.samples = 9000, .load_recorded = false, .fitted = false},
      {.samples = 9000, .load_recorded = false, .detected = false, .one_inertia = true},
      {.samples = 9000, .load_recorded = false, .verdict = GapVerdict::kNone}};
  RunResult run = sample_run(options[kind]);
  if (kind == 2) run.model_free->method = GapMethod::kLostMotion;
  if (kind == 2) run.name = "screw $ axis";
  if (kind == 3) run.name = "a_rather_long_name_that_someone_gave_to_the_third_rig_in_the_cellar";
  return run;
}

class DrawnFigures : public ::testing::TestWithParam<std::size_t> {};

TEST_P(DrawnFigures, HaveNoTextsThatMeetOrAreCutAndNoneWithinAFrame) {
  const RunResult run = kind_of_run(GetParam());
  const ReportView view(run);
  for (const FigureData& figure : all_figures(view)) {
    if (!figure.missing.empty()) continue;
    const Drawing drawing = draw_with_notes(figure);
    const Box paper{0.0, 0.0, static_cast<double>(drawing.image.cols),
                    static_cast<double>(drawing.image.rows)};
    expect_clear_texts(figure, drawing);
    for (std::size_t i = 0; i < drawing.frames.size(); ++i) {
      EXPECT_TRUE(paper.holds(drawing.frames[i])) << figure.file;
      for (const auto& text : drawing.texts)
        EXPECT_FALSE(overlap(text.box, drawing.frames[i])) << figure.file << ": " << text.markup;
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(overlap(drawing.frames[i], drawing.frames[k])) << figure.file;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(KindsOfRuns, DrawnFigures, ::testing::Range(std::size_t{0}, kKinds));

TEST(Drawing, IsTheSameEveryTime) {
  const RunResult run = sample_run({.samples = 6000});
  const FigureData figure = fig5_displacement_and_error(ReportView(run));
  EXPECT_EQ(cv::norm(draw(figure), draw(figure), cv::NORM_INF), 0.0);
}

/// Corners beside a straight line are left out; of a frame that ends where it began, and of a spike that
/// returns within its column, the line from end to end says nothing.
TEST(Drawing, LeavesOutNoSideOfAFrameAndNoSpikeOfAColumn) {
  const Typesetter typesetter;
  PixelCanvas canvas(200.0, 100.0, typesetter);
  canvas.line({{10.0, 10.0}, {90.0, 10.0}, {90.0, 90.0}, {10.0, 90.0}, {10.0, 10.0}}, {kInk, 2.0, {}});
  Polyline trace;
  for (int i = 0; i < 9000; ++i) trace.push_back({100.0 + 0.01 * i, i == 5000 ? 20.0 : 80.0});
  canvas.line(trace, {kInk, 2.0, {}});
  const cv::Mat image = canvas.image();
  const auto dark = [&](int x, int y) { return image.at<cv::Vec3b>(y, x)[0] < 128; };
  for (int at = 15; at < 90; at += 10) {
    EXPECT_TRUE(dark(at, 10) && dark(at, 90) && dark(10, at) && dark(90, at)) << at;
    EXPECT_TRUE(dark(95 + at, 80)) << at;
  }
  EXPECT_TRUE(dark(150, 30));
  EXPECT_FALSE(dark(140, 30) || dark(50, 50));
}

/// As of a torque whose unit rests on a guess, in panels that stand close above each other.
TEST(Drawing, BreaksALabelOrATitleThatIsTooLong) {
  FigureData figure;
  figure.title =
      "A title of a figure in one column that goes on and on, over the angle, the speed and the input";
  for (int i = 0; i < 2; ++i) {
    Panel& panel = figure.panels.emplace_back();
    panel.height = 330.0, panel.x_labels = i == 1;
    panel.x = {"time $t$", "s", {0.0, 1.0}, {}, {}};
    panel.y = {"torque $K_m u$", "N·m", {-5.0, 5.0}, {}, {}, {}, "$K_m$ guessed"};
    if (i == 1)
      panel.title = "A title of a panel that goes on, over the angle, the speed and the input, and on";
  }
  const Drawing drawing = draw_with_notes(figure);
  expect_clear_texts(figure, drawing);
  EXPECT_EQ(drawing.plans[1].title.size(), 2u);
  EXPECT_EQ(drawing.plans[0].y.lines, (std::vector<std::string>{"torque $K_m u$", "(N·m, $K_m$ guessed)"}));
  figure.panels[0].height = figure.panels[1].height = 600.0;
  EXPECT_EQ(draw_with_notes(figure).plans[0].y.lines.size(), 1u);
}

/// Names of categories below a panel do not push its label towards the panel at its left.
TEST(Drawing, KeepsALabelNearerToItsNumbersThanToItsNeighbour) {
  FigureData figure;
  figure.width = 3200.0, figure.columns = 2;
  for (int i = 0; i < 4; ++i) {
    Panel& panel = figure.panels.emplace_back();
    panel.height = 460.0;
    panel.x = {"time $t$", "s", {0.0, 1.0}, {}, {}};
    if (i == 3)
      panel.y.categories = {"backward", "forward"};
    else
      panel.y = {"correcting torque", "N·m", {-0.05, 0.05}, {}, {}};
  }
  const Drawing drawing = draw_with_notes(figure);
  expect_clear_texts(figure, drawing);
  EXPECT_EQ(drawing.plans[1].y.lines.size(), 1u);
  int labels = 0;
  for (const DrawnText& text : drawing.texts) {
    if (!text.markup.starts_with("correcting torque") || text.box.x < drawing.frames[0].right()) continue;
    ++labels;
    EXPECT_LT(drawing.frames[1].x - text.box.right(), 130.0) << "the numbers and two spaces";
    EXPECT_GT(text.box.x - drawing.frames[0].right(), 110.0);
  }
  EXPECT_EQ(labels, 1);
}

/// The room above the frame is as wide as the frame and what stands at its right.
TEST(Drawing, BreaksNoTitleThatHasRoomBesideTheFrame) {
  FigureData figure;
  figure.title = "t";
  Panel& panel = figure.panels.emplace_back();
  panel.title = "Estimates of the gap with their intervals";
  panel.x = {"x", "", {0.0, 1.0}, {}, {}};
  panel.y.categories = {"one"}, panel.y.range = {-1.0, 1.0};
  panel.y.remarks = {"a remark that takes a half of all the width"};
  const Drawing drawing = draw_with_notes(figure);
  expect_clear_texts(figure, drawing);
  EXPECT_EQ(drawing.plans[0].title.size(), 1u);
}

TEST(Drawing, PutsDataWhereTheAxesSay) {
  // One black disc in the middle of the axes must be in the middle of the frame.
  FigureData figure;
  figure.title = "t";
  Panel panel;
  panel.x = {"x", "", {-1.0, 1.0}, {}, {}};
  panel.y = {"y", "", {10.0, 30.0}, {}, {}};
  panel.series.push_back({"", {kBlack, 4.0, {}}, {0.0}, {20.0}, false, Marker::kDisc, {}, {}});
  figure.panels.push_back(panel);
  const Drawing drawing = draw_with_notes(figure);
  const Point middle = drawing.frames[0].centre();
  const auto dark = [&](double dx, double dy) {
    return drawing.image.at<cv::Vec3b>(cvRound(middle.y + dy), cvRound(middle.x + dx))[0] < 60;
  };
  EXPECT_TRUE(dark(0.0, 0.0) && dark(8.0, 0.0) && dark(-8.0, 0.0) && dark(0.0, 8.0) && dark(0.0, -8.0));
  EXPECT_FALSE(dark(16.0, 0.0) || dark(-16.0, 0.0) || dark(0.0, 16.0) || dark(0.0, -16.0));
}

TEST(Drawing, DoesNotDrawMarksBeyondTheAxes) {
  FigureData figure;
  figure.title = "t";
  Panel panel;
  panel.x = {"x", "", {0.0, 1.0}, {}, {}};
  panel.y = {"y", "", {0.0, 1.0}, {}, {}};
  const Series inside{"", {kVermillion, 4.0, {}}, {0.5}, {0.5}, false, Marker::kDisc, {}, {}};
  Series outside = inside;
  outside.y[0] = 1.1;
  panel.series = {inside};
  figure.panels = {panel};
  const cv::Mat with_one = draw(figure);
  figure.panels[0].series.push_back(outside);
  EXPECT_EQ(cv::norm(with_one, draw(figure), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace gapscope::internal::report
