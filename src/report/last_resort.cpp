#include "report/last_resort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "report/diagnosis_words.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

Axis variable_axis(const DiagnosisResult& r, const LastResortLaw& law) {
  if (law.variable == "speed") return {"speed $w_1$", r.coordinates.shown_unit("rad/s")};
  if (law.variable == "input") return {"input $u$", input_unit(r)};
  return {std::string(r.coordinates.rotational() ? "motor angle" : "displacement") + " $x_1$",
          r.coordinates.position_unit(),
          {},
          {},
          {}};
}

/// The law between its nodes; NaN beyond them.
double law_at(const LastResortLaw& law, double at, int direction) {
  const auto& c = law.curve;
  for (std::size_t i = 0; i + 1 < c.size(); ++i) {
    const bool holds =
        c[i].direction == c[i + 1].direction && (c[i].direction == 0 || c[i].direction == direction);
    if (holds && c[i].at <= at && at <= c[i + 1].at && c[i].at < c[i + 1].at)
      return c[i].torque + (c[i + 1].torque - c[i].torque) * (at - c[i].at) / (c[i + 1].at - c[i].at);
  }
  return kNaN;
}

/// Means over bins, of each direction. With the law: what it leaves, on top of itself.
void add_bins(const LastResortLaw& law, bool with, Panel& panel) {
  Series plus{"forward", {kVermillion, 2.0, {}}}, minus{"backward", {kBlue, 2.0, {}}};
  plus.joined = minus.joined = false;
  plus.marker = Marker::kTriangleUp, minus.marker = Marker::kTriangleDown;
  for (const ResidualBin& b : law.residual) {
    const double torque = with ? b.after + law_at(law, b.at, b.direction) : b.before;
    if (std::isnan(torque)) continue;
    Series& s = b.direction > 0 ? plus : minus;
    s.x.push_back(b.at), s.y.push_back(torque);
  }
  for (Series& s : std::vector<Series>{minus, plus})
    if (!s.x.empty()) panel.series.push_back(s);
}

/// A friction jumps at standstill: the line is interrupted where the direction changes.
Series drawn_curve(const LastResortLaw& law) {
  Series curve{readable(law.law), {kInk, 4.0, {}}};
  for (std::size_t i = 0; i < law.curve.size(); ++i) {
    const CurvePoint& p = law.curve[i];
    if (i > 0 && p.direction != law.curve[i - 1].direction) {
      curve.x.push_back(p.at), curve.y.push_back(kNaN);
      curve.y_intervals.push_back({kNaN, kNaN});
    }
    curve.x.push_back(p.at), curve.y.push_back(p.torque);
    curve.y_intervals.push_back(p.ci95);
  }
  return curve;
}

Panel panel_of(const DiagnosisResult& r, const LastResortLaw& law, const std::string& title, bool with) {
  Panel panel{title, variable_axis(r, law), correction_axis(r), 520.0};
  add_bins(law, with, panel);
  return panel;
}

}  // namespace

FigureData diagnosis_law(const DiagnosisResult& r) {
  FigureData figure{"diagnosis_law.png", "A law of what remains"};
  if (r.diagnosis.laws.empty())
    return missing_figure(figure, "no free-form law explains what remains", false);
  const LastResortLaw& law = r.diagnosis.laws.front();
  figure.title = "What remains is a function of " + law.variable;
  figure.panels = {panel_of(r, law, "Without the law", false),
                   panel_of(r, law, "The law, and what it leaves on top of it", true)};
  figure.panels.back().series.push_back(drawn_curve(law));
  Interval range{0.0, 0.0};  // the same in both
  for (const Panel& panel : figure.panels)
    for (const Series& s : panel.series)
      for (const double y : s.y)
        if (!std::isnan(y))
          range.low = std::min(range.low, 1.05 * y), range.high = std::max(range.high, 1.05 * y);
  for (Panel& panel : figure.panels) panel.y.range = range;
  figure.width = 3200.0, figure.columns = 2;
  figure.reading = fmt::format(
      "Means of the held-out correcting {} over bins of the {}; the law with its 95 % intervals, all other "
      "numbers refitted with it.",
      r.coordinates.torque_word(), law.variable);
  return figure;
}

std::string law_table(const DiagnosisResult& r) {
  std::string text;
  for (const LastResortLaw& law : r.diagnosis.laws) {
    text += fmt::format(
        "\n## What remains, as a function of {}\n\nThe law says nothing of a cause. Refitted in the "
        "simulator it explains {} of the held-out error above the floor (95 %: {} to {}); the correcting {} "
        "falls from {} to {}. `{}` holds the table to add to the motor's {}, `fitted_with_law.yaml` the "
        "model with the law. The interval is for recordings within the table: what lies beyond it has not been seen.\n",
        law.variable, rounded(law.shrink), rounded(law.shrink_ci95.low), rounded(law.shrink_ci95.high),
        r.coordinates.torque_word(), quantity(law.before_torque, r.coordinates.shown_unit("N m")),
        quantity(law.after_torque, r.coordinates.shown_unit("N m")), compensation_name(law),
        r.coordinates.torque_word());
    if (law.variable == "input")
      text +=
          "Its scale is a convention: the curve changes nothing at the largest input, and all numbers of the "
          "model in `fitted_with_law.yaml` go with that. A drive that lacks torque only at large inputs has "
          "all of them, and the curve, too large by one factor: the table serves with the numbers of that "
          "file, not with those of a sheet.\n";
    if (law.variable == "position")
      text +=
          "An incremental encoder counts from where it was switched on: after that the table has to be "
          "shifted to where the drive is.\n";
  }
  return text;
}

}  // namespace gapscope::internal::report
