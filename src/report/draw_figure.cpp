#include "report/draw_figure.h"

#include <fmt/format.h>

#include "report/rich_text.h"
#include "report/svg_canvas.h"

namespace gapscope::internal::report {
namespace {

constexpr double kBetween = 34.0;         // rows
constexpr double kBetweenColumns = 90.0;  // an upright label is nearer to its own numbers than to a neighbour
constexpr double kFarFromTicks = 120.0;

/// Everything in its place: the frames of a column begin at one line, those of a row share their upper edge.
struct FigurePlan {
  std::vector<std::string> title;  // in lines
  std::vector<std::string> lines;
  std::vector<Margins> margins;  // of each panel
  std::vector<PanelPlan> panels;
  std::vector<Point> corners;
  double height = 0.0;
};

constexpr double kTitleRow = 1.25;  // of its letters

double title_height(const FigurePlan& plan) {
  if (plan.title.empty()) return 0.0;
  return kTitleSize * (1.0 + kTitleRow * (static_cast<double>(plan.title.size()) - 1.0));
}

std::string panel_title(const FigureData& figure, std::size_t i) {
  const std::string& title = figure.panels[i].title;
  if (figure.panels.size() == 1) return title;
  const std::string letter = std::string("(") + static_cast<char>('a' + i) + ")";
  return title.empty() ? letter : letter + " " + title;
}

/// One left margin for a column; one right margin for panels that share their x axis.
std::vector<Margins> panel_margins(const FigureData& figure, const Typesetter& typesetter) {
  std::vector<Margins> margins;
  for (const Panel& panel : figure.panels) margins.push_back(side_margins(panel, typesetter));
  const auto columns = static_cast<std::size_t>(figure.columns);
  const auto share = [](double& a, double& b) { a = b = std::max(a, b); };
  for (int pass = 0; pass < 2; ++pass)  // down and up again, so that the largest reaches all
    for (std::size_t k = columns; k < margins.size(); ++k) {
      const std::size_t i = pass == 0 ? k : margins.size() - 1 - (k - columns);
      share(margins[i].left, margins[i - columns].left);
      if (!figure.panels[i - columns].x_labels) share(margins[i].right, margins[i - columns].right);
    }
  return margins;
}

/// Where a panel's y label stands, from its frame: in line with those of its column, unless that is far from
/// its ticks. Names of categories, which no label stands beside, move none.
double label_margin(const FigureData& figure, std::size_t of, const Typesetter& typesetter) {
  const auto columns = static_cast<std::size_t>(figure.columns);
  const double own = side_margins(figure.panels[of], typesetter).left;
  double of_column = own;
  for (std::size_t i = of % columns; i < figure.panels.size(); i += columns)
    if (figure.panels[i].y.categories.empty())
      of_column = std::max(of_column, side_margins(figure.panels[i], typesetter).left);
  return of_column - own > kFarFromTicks ? own : of_column;
}

FigurePlan plan_figure(const FigureData& figure, const Typesetter& typesetter) {
  FigurePlan plan;
  plan.margins = panel_margins(figure, typesetter);
  const auto columns = static_cast<std::size_t>(figure.columns);
  const double column_width = (figure.width - 2 * kRim - kBetweenColumns * static_cast<double>(columns - 1)) /
                              static_cast<double>(columns);
  for (const std::string& line : figure.lines)
    for (std::string& part : typesetter.wrapped(line, figure.width - 2 * kRim, kTextSize))
      plan.lines.push_back(part);
  if (!figure.title.empty())
    plan.title = typesetter.wrapped(figure.title, figure.width - 2 * kRim, kTitleSize, true);
  double y = kRim + title_height(plan) + 0.65 * kTitleSize +
             1.35 * kTextSize * static_cast<double>(plan.lines.size());
  if (!plan.lines.empty()) y += kBetween;
  for (std::size_t first = 0; first < figure.panels.size(); first += columns) {
    double above = 0.0, below = 0.0;
    const std::size_t end = std::min(first + columns, figure.panels.size());
    for (std::size_t i = first; i < end; ++i) {
      plan.panels.push_back(plan_panel(figure.panels[i], panel_title(figure, i),
                                       column_width - plan.margins[i].left - plan.margins[i].right,
                                       column_width - plan.margins[i].left, typesetter));
      above = std::max(above, plan.panels[i].above);
      below = std::max(below, plan.panels[i].height + plan.panels[i].below);
    }
    for (std::size_t i = first; i < end; ++i)
      plan.corners.push_back(
          {kRim + static_cast<double>(i % columns) * (column_width + kBetweenColumns) + plan.margins[i].left,
           y + above});
    y += above + below + kBetween;
  }
  plan.height = y - kBetween + kRim;
  return plan;
}

void paint(Canvas& canvas, const FigureData& figure, const FigurePlan& plan, const Typesetter& typesetter) {
  for (std::size_t i = 0; i < plan.title.size(); ++i)
    canvas.text({kRim, kRim + kTitleSize * (1.0 + kTitleRow * static_cast<double>(i))}, plan.title[i],
                {kTitleSize, Align::kLeft, kInk, true});
  for (std::size_t i = 0; i < plan.lines.size(); ++i)
    canvas.text({kRim, kRim + title_height(plan) + 0.5 * kTitleSize +
                           (0.9 + 1.35 * static_cast<double>(i)) * kTextSize},
                plan.lines[i], {kTextSize});
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    draw_panel(canvas, figure.panels[i], plan.panels[i], plan.corners[i], label_margin(figure, i, typesetter),
               typesetter);
}

}  // namespace

Drawing draw_with_notes(const FigureData& figure) {
  const Typesetter typesetter;
  const FigurePlan plan = plan_figure(figure, typesetter);
  PixelCanvas canvas(figure.width, plan.height, typesetter, figure.scale);
  paint(canvas, figure, plan, typesetter);
  Drawing drawing;
  for (std::size_t i = 0; i < plan.panels.size(); ++i) {
    const Box frame{plan.corners[i].x, plan.corners[i].y, plan.panels[i].width, plan.panels[i].height};
    drawing.frames.push_back(frame.scaled(figure.scale));
  }
  drawing.image = canvas.image();
  drawing.texts = canvas.texts();
  for (DrawnText& text : drawing.texts) text.box = text.box.scaled(figure.scale);
  drawing.plans = plan.panels;
  return drawing;
}

cv::Mat draw(const FigureData& figure) { return draw_with_notes(figure).image; }

std::string draw_as_svg(const FigureData& figure) {
  const Typesetter typesetter;
  const FigurePlan plan = plan_figure(figure, typesetter);
  SvgCanvas canvas(typesetter);
  paint(canvas, figure, plan, typesetter);
  return canvas.document(figure.width, plan.height, kColumnWidth / figure.column, plain_text(figure.title),
                         plain_text(figure.reading));
}

std::string draw_for_page(const FigureData& figure) {
  const Typesetter typesetter;
  const FigurePlan plan = plan_figure(figure, typesetter);
  SvgCanvas canvas(typesetter, figure.file.substr(0, figure.file.find('.')) + "_");
  paint(canvas, figure, plan, typesetter);
  for (std::size_t i = 0; i < plan.panels.size(); ++i) {
    const PanelPlan& p = plan.panels[i];
    const bool numbers = figure.panels[i].x.categories.empty() && figure.panels[i].y.categories.empty();
    if (numbers) canvas.plot({plan.corners[i].x, plan.corners[i].y, p.width, p.height}, p.x, p.y);
  }
  return canvas.element(figure.width, plan.height, plain_text(figure.title),
                        fmt::format(" style=\"--columns:{:.4g}\"", figure.width / figure.column));
}

}  // namespace gapscope::internal::report
