#include "report/recording_picture.h"

#include <numeric>

#include "report/decimate.h"
#include "report/report_files.h"
#include "report/rich_text.h"

namespace gapscope {
namespace internal::report {
namespace {

constexpr std::size_t kPictureColumns = 1500;  ///< a sample each of which tells what a longer trace does

Panel traced(const std::string& title, const Axis& y, const std::vector<double>& t,
             const std::vector<double>& values, const LineStyle& style) {
  Panel panel{title, {"time $t$", "s"}, y, 330.0};
  Series line;
  line.style = style;
  for (const std::size_t i : decimate_columns(t, values, kPictureColumns))
    line.x.push_back(t[i]), line.y.push_back(values[i]);
  panel.series.push_back(std::move(line));
  return panel;
}

Panel loop_of(const Recording& r, const Axis& input, const Axis& position) {
  Panel panel{"Position over input", input, position, 480.0};
  Series line;
  line.style = measured_style();
  line.style.width = 2.0;
  const std::size_t every = std::max<std::size_t>(1, r.size() / 20'000);
  for (std::size_t i = 0; i < r.size(); i += every) line.x.push_back(r.u[i]), line.y.push_back(r.x1[i]);
  panel.series.push_back(std::move(line));
  return panel;
}

FigureData figure_of(const Recording& r, Coordinates coordinates, const InputFacts& facts,
                     const std::vector<std::string>& lines) {
  const Axis input = {"input $u$", facts.unit.empty() ? "units of $u$" : coordinates.shown_unit(facts.unit)};
  FigureData figure{"recording.png", literal(r.file)};
  for (const std::string& line : lines) figure.lines.push_back(literal(line));
  std::vector<double> t(r.size());
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = r.time(i);
  const bool load = r.encoder == EncoderSide::kLoad;
  const std::vector<double>& x = load ? r.x2 : r.x1;
  const Axis position = {load ? "position $x_2$" : "position $x_1$", coordinates.position_unit()};
  figure.panels.push_back(traced("Input", input, t, r.u, input_style()));
  figure.panels.push_back(traced("Position", position, t, x, measured_style()));
  if (!r.even()) {
    std::vector<double> steps(t.size());
    std::adjacent_difference(t.begin(), t.end(), steps.begin());
    steps.front() = steps.size() > 1 ? steps[1] : 0.0;
    figure.panels.push_back(traced("Time from row to row", {"step", "s"}, t, steps, guide_style()));
  }
  if (!load) figure.panels.push_back(loop_of(r, input, position));
  return figure;
}

}  // namespace
}  // namespace internal::report

std::string recording_picture(const Recording& recording, Coordinates coordinates, const InputFacts& input,
                              const std::vector<std::string>& lines) {
  return internal::report::picture_bytes(internal::report::figure_of(recording, coordinates, input, lines));
}

}  // namespace gapscope
