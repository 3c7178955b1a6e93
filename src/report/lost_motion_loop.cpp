#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "report/figures.h"
#include "report/signals.h"
#include "report/view_signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr double kAway = 0.1;  ///< of its largest value, that a torque has left zero

constexpr double kFlankBegin = 0.7, kFlankEnd = 0.95;  ///< of the torque of its level
constexpr double kAsStiff = 2.0;  ///< factor within which a flank of the loop is the one that was read
constexpr double kWindUp = 1.5;   ///< free runs that a flank may wind up by at its amplitude

/// From one zero of the torque to the next.
struct HalfCycle {
  std::size_t from = 0, to = 0;
  double extreme = 0.0;  ///< its largest value, with its sign
};

/// Cut where the torque passes zero, after it was away from it on either side.
std::vector<HalfCycle> half_cycles(const std::vector<double>& torque) {
  const double away = kAway * largest_magnitude(torque);
  std::vector<HalfCycle> cycles(1);
  std::size_t zero = 0;
  for (std::size_t i = 1; i < torque.size(); ++i) {
    if (torque[i] * torque[i - 1] <= 0.0 && torque[i] != torque[i - 1]) zero = i;
    const bool turned = std::abs(torque[i]) > away && torque[i] * cycles.back().extreme < 0.0 &&
                        std::abs(cycles.back().extreme) > away;
    if (turned) cycles.back().to = zero, cycles.push_back({zero, 0, 0.0});
    if (std::abs(torque[i]) > std::abs(cycles.back().extreme)) cycles.back().extreme = torque[i];
  }
  cycles.back().to = torque.size();
  return cycles;
}

/// The levels of the estimate, in the unit of the axis.
struct LoopFigure {
  const ReportView& view;
  const LostMotion& lost_motion;
  DriveSignal drive = drive_signal(view);
  double constant = 1.0;  ///< axis over u
  std::vector<double> torque = without_noise(view, drive.values);
  std::vector<HalfCycle> cycles = half_cycles(torque);

  explicit LoopFigure(const ReportView& v) : view(v), lost_motion(v.run.model_free->lost_motion) {
    if (const FittedParameter* k = parameter(v.run, "torque_constant"); k && std::isfinite(k->value))
      constant = k->value;
  }
  double amplitude(const LostMotionLevel& level) const { return std::abs(constant) * level.amplitude; }
  /// The level whose amplitude is nearest to that of a half cycle.
  std::size_t level_of(const HalfCycle& cycle) const {
    std::size_t nearest = 0;
    const auto distance = [&](std::size_t i) {
      return std::abs(std::log(std::abs(cycle.extreme) / amplitude(lost_motion.levels[i])));
    };
    for (std::size_t i = 1; i < lost_motion.levels.size(); ++i)
      if (distance(i) < distance(nearest)) nearest = i;
    return nearest;
  }
};

/// Whether the end of the ramps is a flank: not the free run itself, which winds up farther than that.
bool has_flank(const LostMotionLevel& level) {
  return level.flank > 0.0 &&
         !(level.free_run > 0.0 && level.flank * level.amplitude > kWindUp * level.free_run);
}

/// Dark and light by turns, so that neighbours differ in a grey print as well.
LineStyle level_style(std::size_t level) {
  constexpr std::array kColours{kBlue, Colour{230, 159, 0}, kBlack, Colour{86, 180, 233}};
  return {kColours[level % kColours.size()], 3.0, {}};
}

/// Where x1 stands as the rising torque of one side last passes a share of its level, median of the half
/// cycles.
double place_on_flank(const LoopFigure& f, std::size_t level, double side, double share) {
  const double torque = share * f.amplitude(f.lost_motion.levels[level]);
  std::vector<double> places;
  for (const HalfCycle& cycle : f.cycles) {
    if (f.level_of(cycle) != level || !(side * cycle.extreme > torque)) continue;
    std::size_t i = cycle.from;
    while (i + 1 < cycle.to && f.torque[i] != cycle.extreme) ++i;
    while (i > cycle.from && side * f.torque[i] > torque) --i;
    const auto& x = f.view.recording->position();
    const double from = side * f.torque[i], to = side * f.torque[std::min(i + 1, f.torque.size() - 1)];
    const double way = to > from ? (torque - from) / (to - from) : 0.0;
    places.push_back(x[i] + way * (x[std::min(i + 1, x.size() - 1)] - x[i]));
  }
  return median(std::move(places));
}

/// The loaded flank of one side as the loop has it: a line through two of its places. Nothing where it is not
/// as stiff as the flank that was read: then the loop has none there.
std::optional<Series> flank_of(const LoopFigure& f, std::size_t level, double side) {
  const LostMotionLevel& l = f.lost_motion.levels[level];
  const double top = f.amplitude(l), read = std::abs(l.flank / f.constant);
  if (!has_flank(l)) return {};
  const double low = place_on_flank(f, level, side, kFlankBegin),
               high = place_on_flank(f, level, side, kFlankEnd);
  const double slope = (high - low) / (side * (kFlankEnd - kFlankBegin) * top);
  if (!(std::abs(slope) < kAsStiff * read) || !(kAsStiff * std::abs(slope) > read)) return {};
  Series s;
  s.style = {kVermillion, 6.0, {18, 8}};
  s.x = {side * kFlankBegin * top, side * top};
  s.y = {low, high + slope * side * (1.0 - kFlankEnd) * top};
  return s;
}

/// "±4.0 N·m: play 34.1 mrad, flank 690 N·m/rad"
std::string level_name(const LoopFigure& f, std::size_t index) {
  const LostMotionLevel& level = f.lost_motion.levels[index];
  const std::string unit = f.drive.axis.unit;
  std::string name = fmt::format("±{}: play {}", quantity(f.amplitude(level), unit),
                                 quantity(level.lost_motion, f.view.length_unit));
  const double stiffness = std::abs(f.constant) / level.flank;
  if (flank_of(f, index, 1.0) && flank_of(f, index, -1.0))
    name += fmt::format(", flank {} {}/{}", rounded(stiffness), unit, f.view.length_unit);
  return name;
}

Series loop_of(const LoopFigure& f, std::size_t level) {
  Series s;
  s.style = level_style(level);
  s.label = level_name(f, level);
  for (const HalfCycle& cycle : f.cycles) {
    if (f.level_of(cycle) != level) continue;
    for (std::size_t i = cycle.from; i < std::min(cycle.to + 1, f.torque.size()); ++i) {
      s.x.push_back(f.torque[i]);
      s.y.push_back(f.view.recording->position()[i]);
    }
    s.x.push_back(kNaN);
    s.y.push_back(kNaN);
  }
  return s;
}

/// Where x1 stands as the torque comes back to zero from one side.
double place_at_zero(const LoopFigure& f, std::size_t level, double side) {
  std::vector<double> places;
  for (const HalfCycle& cycle : f.cycles)
    if (f.level_of(cycle) == level && side * cycle.extreme > 0.0 && cycle.to > 0)
      places.push_back(f.view.recording->position()[std::min(cycle.to, f.torque.size() - 1)]);
  return median(places);
}

/// The play of the smallest torque, about the middle of where the branches stand.
void add_play(const LoopFigure& f, Panel& panel) {
  const double up = place_at_zero(f, 0, 1.0), down = place_at_zero(f, 0, -1.0);
  if (!std::isfinite(up) || !std::isfinite(down)) return;
  const double middle = 0.5 * (up + down), half = 0.5 * std::abs(f.lost_motion.levels.front().lost_motion);
  panel.dimensions.push_back(
      {{middle - half, middle + half},
       "play " + quantity(f.lost_motion.levels.front().lost_motion, f.view.length_unit)});
  for (const double y : {middle - half, middle + half}) panel.y_marks.push_back({y, guide_style(), ""});
}

/// Of the levels whose loop has them on both sides.
void add_flanks(const LoopFigure& f, Panel& panel) {
  const char* label = "loaded flank";
  for (std::size_t level = 0; level < f.lost_motion.levels.size(); ++level) {
    auto plus = flank_of(f, level, 1.0), minus = flank_of(f, level, -1.0);
    if (!plus || !minus) continue;
    plus->label = label, label = "";
    panel.series.push_back(std::move(*plus));
    panel.series.push_back(std::move(*minus));
  }
}

std::string reading_of(const LoopFigure& f, bool flanks) {
  const std::string unit = f.view.length_unit;
  std::string text = fmt::format("At zero {} the two branches lie apart by {}", f.drive.name,
                                 with_interval(f.lost_motion.value, f.lost_motion.ci95, unit));
  const Interval range = f.lost_motion.range();
  if (f.lost_motion.levels.size() > 1)
    text += fmt::format(", by level {} to {}", quantity(range.low, unit), quantity(range.high, unit));
  return text + (flanks ? ". Dashed: the loaded flanks." : ".");
}

}  // namespace

FigureData lost_motion_loop(const ReportView& view) {
  FigureData figure{"lost_motion_loop.png", "Displacement against input"};
  if (!view.recording || !view.run.model_free || !view.run.model_free->lost_motion.read())
    return missing_figure(figure, "there is no quasi-static loop of displacement and input", false);
  const LoopFigure f(view);
  Panel panel;
  panel.x = f.drive.axis;
  panel.y = {"motor $x_1$", view.length_unit};
  panel.height = 760.0;
  panel.x_marks.push_back({0.0, guide_style(), ""});
  for (std::size_t level = f.lost_motion.levels.size(); level-- > 0;)  // the small ones on top
    panel.series.push_back(loop_of(f, level));
  add_flanks(f, panel);
  add_play(f, panel);
  figure.reading = reading_of(f, panel.series.size() > f.lost_motion.levels.size());
  figure.panels.push_back(panel);
  return figure;
}

}  // namespace gapscope::internal::report
