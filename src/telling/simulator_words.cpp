#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/shared_unit.h"
#include "base/text.h"
#include "diagnosis/rule.h"
#include "diagnosis/simulator.h"
#include "gapscope/telling/card.h"
#include "gapscope/telling/statement.h"

namespace gapscope {
namespace internal::telling {
namespace {

using diagnosis::kRule;

/// A number as people read it: lengths and times in thousandths, torques with a prefix.
std::string amount(double value, const std::string& unit, Coordinates coordinates) {
  if (unit == "rad") return coordinates.thousandths(value);
  if (unit == "s") return fmt::format("{:.3g} ms", 1e3 * value);
  const std::string shown = coordinates.shown_unit(unit);
  if (unit == "N m") return SharedUnit(value, shown)(value);
  const std::string number = SharedUnit(1.0, "").number(value);
  return shown.empty() ? number : number + " " + shown;
}

/// A number by its name without its unit: "length 2 mrad", "46 periods per turn".
std::string with_name(const ComparedNumber& n, double value, Coordinates coordinates) {
  if (n.key == "periods_per_turn") return fmt::format("{:.3g} periods per turn", value);
  return name_of_key(n.key) + " " + amount(value, n.unit, coordinates);
}

/// Where its wave begins and what rides on it are for the table.
bool is_detail(const ComparedNumber& n) {
  return n.key.find("phase") != std::string::npos || n.key.find("harmonic") != std::string::npos;
}

bool is_size(const ComparedNumber& n) {
  for (const char* size : {"level_nm", "amplitude_nm", "torque_nm", "delay_s", "time_constant_s", "gap_rad",
                           "amplitude_rad", "coefficient_nms2"})
    if (n.key == size) return true;
  return false;
}

/// The amounts that there are, and the shape: where there is no level, a ratio stands for itself.
std::string of_side(const SimulatorRow& row, bool drive, Coordinates coordinates) {
  const auto value_of = [drive](const ComparedNumber& n) { return drive ? n.drive : n.simulator; };
  const auto is_there = [&](const ComparedNumber& n) {
    return says_how_much(row, n) && !says_none(row, n, value_of(n));
  };
  const bool any = std::any_of(row.numbers.begin(), row.numbers.end(), is_there);
  std::vector<std::string> parts;
  for (const ComparedNumber& n : row.numbers) {
    const double value = value_of(n);
    if (is_detail(n) || (any && says_none(row, n, value))) continue;
    parts.push_back(parts.empty() && is_size(n) ? amount(value, n.unit, coordinates)
                                                : with_name(n, value, coordinates));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// How near a number has to come to a sample or a small part of it to be a step [-]: half of where (1 - t)/2
/// meets (1 + t)/3. Half as much is less than such a number is known to.
constexpr double kIsStep = 0.5 * (1.0 / 2.0 - 1.0 / 3.0) / (1.0 / 2.0 + 1.0 / 3.0);

/// The step of a solver that leaves half of it in a number, if that is a sample or down to a fourth of one;
/// 0: it is none.
double step_of_solver(double twice_half, double dt) {
  for (const double parts : {1.0, 2.0, 3.0, 4.0})
    if (std::abs(twice_half * parts / dt - 1.0) < kIsStep) return dt / parts;
  return 0.0;
}

/// An integrator that takes the damping implicitly gives the motor half a step of it as inertia.
std::string implicitly_damped(const SimulatorRow& row, const std::vector<SimulatorRow>& rows, double dt) {
  if (row.name != "motor_inertia") return "";
  for (const SimulatorRow& other : rows) {
    if (other.name != "motor_damping") continue;
    const ComparedNumber& inertia = row.numbers.front();
    const double step =
        step_of_solver(2.0 * (inertia.simulator - inertia.drive) / other.numbers.front().simulator, dt);
    if (step > 0.0)
      return fmt::format(
          " (an integrator that treats damping implicitly, as MuJoCo's Euler, adds half a step of it to the "
          "inertia: this much at a step of {:.2g} ms)",
          1e3 * step);
  }
  return "";
}

/// Semi-implicit Euler is half a step ahead.
std::string ahead_by_half_a_step(double ahead, double dt) {
  const double step = step_of_solver(2.0 * ahead, dt);
  return step > 0.0
             ? fmt::format(
                   ", as a semi-implicit Euler method at a step of {:.2g} ms leaves it, being half a step ahead",
                   1e3 * step)
             : "";
}

/// What a fixed step leaves in a delay, or in the lag that is told for it; of a delay, how many samples it
/// is.
std::string in_steps(const SimulatorRow& row, double dt) {
  const bool lag = row.name == "actuator_lag" || row.name == "measurement_lag";
  if (!(lag || row.name == "input_delay") || row.numbers.empty()) return "";
  const double steps = (row.numbers.front().simulator - row.numbers.front().drive) / dt;
  const bool ahead = steps < 0.0 && steps > -0.6;
  if (lag) return ahead ? ahead_by_half_a_step(-steps * dt, dt) : "";
  const double halves = std::round(2.0 * steps);
  const bool whole = halves != 0.0 && std::abs(2.0 * steps - halves) < 0.2;
  return fmt::format(" ({} {:.2g} {} {}{})", whole ? "about" : "that is", std::abs(steps),
                     std::abs(std::abs(steps) - 1.0) < 0.05 ? "sample" : "samples",
                     steps > 0.0 ? "too much" : "too little",
                     ahead ? ahead_by_half_a_step(-steps * dt, dt)
                     : whole && std::abs(halves) <= 2.0
                         ? ", as an input that acts a step late or an integrator of fixed step leave it"
                         : "");
}

/// A simulator whose dry friction is a soft constraint, or smoothed, slides where the drive holds.
std::string creeping(const SimulatorRow& row) {
  if (row.name != "presliding_friction") return "";
  for (const ComparedNumber& n : row.numbers)
    if (n.key == "length_rad" && n.simulator > 2.0 * n.drive)
      return ": its friction creeps, as that of a smoothed law or of a soft constraint does";
  return "";
}

std::string effect_row_sentence(const SimulatorRow& row, Coordinates coordinates) {
  const std::string name = readable(row.name);
  const std::string drive = of_side(row, true, coordinates), simulator = of_side(row, false, coordinates);
  switch (row.found_in) {
    case FoundIn::kDrive:
      return fmt::format("it has no {}, where the drive has {}", name, drive);
    case FoundIn::kSimulator:
      return fmt::format("it has {} ({}), where the drive has none", name, simulator);
    default:
      return fmt::format("its {} is {} where the drive's is {}", name, simulator, drive);
  }
}

/// What the recordings cannot tell from it; a delay and a lag of the same time are hardly ever told apart.
std::string likely_others(const SimulatorRow& row) {
  std::vector<std::string> others;
  const EffectEntry* entry = find_effect(row.name);
  const bool lags = entry != nullptr && entry->follows == ResidualPattern::kInputSteps;
  if (lags)
    for (const char* other : entry->look_alikes) others.push_back(readable(other));
  for (const std::string& other : row.group)
    if (other != row.name && !contains(others, readable(other))) others.push_back(readable(other));
  return others.empty() ? "" : fmt::format(" (or {})", fmt::join(others, " or "));
}

/// What keeps "no row differs" from being all that there is to say; nothing where nothing does. A simulator
/// that the model does not follow was not compared at all.
Statement alike(const SimulatorComparison& c) {
  if (c.simulator_floors > kRule.far)
    return {"simulator.not_followed", {ratio("floors", c.simulator_floors)}};
  if (c.drive_floors > kRule.far) return {"simulator.hidden", {ratio("floors", c.drive_floors)}};
  if (const double off = c.errors.simulator / c.floor; off > kLeastRow)
    return {"simulator.off", {ratio("floors", off)}};
  return {"simulator.alike"};
}

/// What mending takes; where errors of several rows hide each other, no row alone takes any.
Told mended(const SimulatorComparison& c) {
  const SimulatorErrors& e = c.errors;
  const std::size_t rows = static_cast<std::size_t>(std::ranges::count_if(c.rows, &SimulatorRow::differs));
  const std::vector<Fact> facts = {number("off", e.simulator, "rad"),
                                   number("miss", e.stand_in_miss, "rad"),
                                   number("error", e.stand_in, "rad"),
                                   number("mended", e.mended, "rad"),
                                   number("all", rows > 1 ? e.all_mended : kNaN, "rad"),
                                   ratio("rows", static_cast<double>(rows)),
                                   per_cent("share", 100.0 * c.shrink),
                                   word("first", readable(c.rows.front().name))};
  return {{"simulator.stand_in", facts},
          {c.shrink > 0.0 ? "simulator.mended" : "simulator.not_mended", facts}};
}

Told comparison_of(const SimulatorComparison& c) {
  const Statement off{"simulator.held_out", {number("off", c.errors.simulator, "rad")}};
  if (c.state == ComparisonState::kNotFitted) return {{"simulator.not_fitted"}};
  if (c.state == ComparisonState::kNotFollowed)
    return {off, {"simulator.no_row", {number("miss", c.errors.stand_in_miss, "rad")}}};
  if (c.rows.empty() || !c.rows.front().differs) return {alike(c), off};
  std::vector<std::string> rows;
  for (const SimulatorRow& row : c.rows)
    if (row.differs) rows.push_back(row.sentence);
  Told told = {{"simulator.differs", {names("rows", rows)}}};
  for (Statement& s : mended(c)) told.push_back(std::move(s));
  return told;
}

/// What one row says. @param rows  all of the table: what a solver leaves in one shows beside another
std::string row_sentence(const SimulatorRow& row, const std::vector<SimulatorRow>& rows, double dt,
                         Coordinates coordinates) {
  if (row.is_effect)
    return effect_row_sentence(row, coordinates) + in_steps(row, dt) + creeping(row) + likely_others(row);
  const ComparedNumber& n = row.numbers.front();
  return fmt::format("its {} is {} where the drive's is {}", readable(row.name),
                     amount(n.simulator, n.unit, coordinates), amount(n.drive, n.unit, coordinates)) +
         implicitly_damped(row, rows, dt);
}

}  // namespace
}  // namespace internal::telling

void put_into_words(SimulatorComparison& c, Coordinates coordinates) {
  using namespace internal::telling;
  for (SimulatorRow& row : c.rows)
    row.sentence = row.differs ? row_sentence(row, c.rows, c.dt, coordinates) : "";
  const Told told = comparison_of(c);
  c.sentence = in_words(told, Detail::kWhole, coordinates);
  c.in_brief = in_words({told.front()}, Detail::kBrief, coordinates);
}

}  // namespace gapscope
