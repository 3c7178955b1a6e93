#include <cmath>

#include "report/panel_plan.h"

namespace gapscope::internal::report {
namespace {

void widen(Interval& range, double value) {
  if (!std::isfinite(value)) return;
  range.low = std::isnan(range.low) ? value : std::min(range.low, value);
  range.high = std::isnan(range.high) ? value : std::max(range.high, value);
}

void widen(Interval& range, const Interval& other) {
  widen(range, other.low);
  widen(range, other.high);
}

/// A range with room on both sides; something to look at even for a single value.
Interval with_room(Interval range, double share) {
  if (std::isnan(range.low)) return {0.0, 1.0};
  double room = share * (range.high - range.low);
  const double magnitude = std::max(std::abs(range.low), std::abs(range.high));
  if (range.high - range.low <= 1e-9 * magnitude || magnitude == 0.0)
    room = magnitude > 0.0 ? 0.1 * magnitude : 1.0;
  return {range.low - room, range.high + room};
}

/// "torque (mN·m, $K_m$ guessed)"
std::string axis_label(const Axis& axis, const std::string& unit) {
  if (unit.empty()) return axis.name;
  return axis.name + " (" + unit + (axis.unit_note.empty() ? "" : ", " + axis.unit_note) + ")";
}

constexpr double kOverhang = 60.0;  ///< by which a label may be longer than its axis [px]

/// In one line where it is no longer than its axis, else in several, the unit in the last one.
std::vector<std::string> label_lines(const std::string& label, double length, const Typesetter& typesetter) {
  if (label.empty()) return {};
  if (typesetter.measure(label, kTextSize).width <= length + kOverhang) return {label};
  const std::size_t unit = label.rfind(" (");
  auto lines = typesetter.wrapped(label.substr(0, unit), length + kOverhang, kTextSize);
  if (unit != label.npos) lines.push_back(label.substr(unit + 1));
  return lines;
}

/// Every place, or every second, third, ... as far as their names stand clear of each other.
void name_places(const Axis& axis, double length, bool upright, const Typesetter& typesetter,
                 AxisPlan& plan) {
  double widest = 0.0;
  for (const Place& place : axis.places)
    widest = std::max(widest, typesetter.measure(place.label, kTickSize).width);
  const double needed = upright ? 1.3 * kTickSize : widest + 0.6 * kTickSize;
  const double pitch = length / std::max(1.0, static_cast<double>(axis.places.size()));
  const auto every = static_cast<std::size_t>(std::max(1.0, std::ceil(needed / pitch)));
  for (std::size_t i = 0; i < axis.places.size(); i += every) {
    plan.ticks.values.push_back(axis.places[i].at);
    plan.names.push_back(axis.places[i].label);
  }
  plan.label = axis_label(axis, axis.unit);
}

double widest_label(const AxisPlan& plan, const Typesetter& typesetter) {
  double widest = 0.0;
  for (std::size_t i = 0; i < plan.ticks.values.size(); ++i)
    widest = std::max(widest, typesetter.measure(plan.tick_text(i), kTickSize).width);
  return widest;
}

AxisPlan planned_scale(const Axis& axis, Interval data, double length, bool upright,
                       const Typesetter& typesetter) {
  AxisPlan plan;
  const bool fixed = !std::isnan(axis.range.low);
  plan.range = fixed ? axis.range : with_room(data, 0.06);
  if (!axis.categories.empty()) {  // the first one at the top
    const double last = static_cast<double>(axis.categories.size()) - 1.0;
    plan.range = {last + 0.6, -0.6};
    plan.label = axis.name;
    return plan;
  }
  if (!axis.places.empty()) {
    name_places(axis, length, upright, typesetter, plan);
    return plan;
  }
  const AxisScale scale =
      axis_scale(axis.unit, std::max(std::abs(plan.range.low), std::abs(plan.range.high)));
  plan.factor = scale.factor;
  plan.label = axis_label(axis, scale.unit);
  const auto ticks = [&](int most) {
    return round_ticks(plan.range.low / plan.factor, plan.range.high / plan.factor, most);
  };
  if (upright) {
    plan.ticks = ticks(std::max(2, static_cast<int>(length / (2.2 * kTickSize))));
    return plan;
  }
  for (int most = 9; most >= 2; --most) {  // as many as stand clear of each other
    plan.ticks = ticks(most);
    const double pitch = length * plan.ticks.step * plan.factor / (plan.range.high - plan.range.low);
    if (pitch > widest_label(plan, typesetter) + 1.2 * kTickSize) break;
  }
  return plan;
}

}  // namespace

Interval x_range(const Panel& panel) {
  Interval range;
  for (const Series& s : panel.series) {
    for (const double x : s.x) widen(range, x);
    for (const Interval& i : s.x_intervals) widen(range, i);
  }
  for (const Mark& mark : panel.x_marks) widen(range, mark.at);
  for (const Tile& tile : panel.tiles) widen(range, tile.x);
  return range;
}

Interval y_range(const Panel& panel) {
  Interval range;
  for (const Series& s : panel.series) {
    for (const double y : s.y) widen(range, y);
    for (const Interval& i : s.y_intervals) widen(range, i);
  }
  for (const Mark& mark : panel.y_marks) widen(range, mark.at);
  for (const Band& band : panel.y_bands) widen(range, band.range);
  for (const Dimension& dimension : panel.dimensions) widen(range, dimension.range);
  for (const Tile& tile : panel.tiles) widen(range, tile.y);
  return range;
}

double label_thickness(const AxisPlan& plan, const Typesetter& typesetter) {
  double thickness = 0.0;
  for (const std::string& line : plan.lines) thickness += typesetter.measure(line, kTextSize).height();
  return thickness;
}

AxisPlan plan_axis(const Axis& axis, Interval data, double length, bool upright,
                   const Typesetter& typesetter) {
  AxisPlan plan = planned_scale(axis, data, length, upright, typesetter);
  if (upright) plan.lines = label_lines(plan.label, length, typesetter);
  return plan;
}

Margins side_margins(const Panel& panel, const Typesetter& typesetter) {
  const AxisPlan x = plan_axis(panel.x, x_range(panel), 1000.0, false, typesetter);
  const AxisPlan y = plan_axis(panel.y, y_range(panel), panel.height, true, typesetter);
  Margins margins;
  double labels = widest_label(y, typesetter);
  for (const std::string& name : panel.y.categories)
    labels = std::max(labels, typesetter.measure(name, kTextSize).width);
  margins.left = labels + 2 * kSpace;
  if (!y.lines.empty()) margins.left += label_thickness(y, typesetter) + kSpace;
  margins.right = widest_label(x, typesetter) / 2;
  for (const std::string& remark : panel.y.remarks)
    margins.right = std::max(margins.right, typesetter.measure(remark, kTextSize).width + 2 * kSpace);
  for (const Dimension& dimension : panel.dimensions)
    margins.right = std::max(margins.right,
                             4 * kSpace + typesetter.measure(dimension.label, kTextSize).height() + kSpace);
  return margins;
}

}  // namespace gapscope::internal::report
