#include "diagnosis/simulator_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "gapscope/base/decimals.h"
#include "gapscope/base/text.h"

namespace gapscope::internal::diagnosis {
namespace {

/// A number as people read it: lengths and times in thousandths, torques with a prefix.
std::string amount(double value, const std::string& unit, Coordinates coordinates) {
  if (unit == "rad") return coordinates.thousandths(value);
  if (unit == "s") return fmt::format("{:.3g} ms", 1e3 * value);
  const std::string shown = coordinates.shown_unit(unit);
  if (shown.starts_with("N")) return SharedUnit(value, shown)(value);
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
          " (an integrator that takes damping implicitly, as MuJoCo's Euler, adds half a step of it to the "
          "inertia: this much at a step of {:.2g} ms)",
          1e3 * step);
  }
  return "";
}

/// Semi-implicit Euler is half a step ahead.
std::string ahead_by_half_a_step(double ahead, double dt) {
  const double step = step_of_solver(2.0 * ahead, dt);
  return step > 0.0 ? fmt::format(
                          ", as a semi-implicit Euler method at a step of {:.2g} ms leaves it, being "
                          "half a step ahead",
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
      return fmt::format("it has no {}, the drive has ({})", name, drive);
    case FoundIn::kSimulator:
      return fmt::format("it has {} ({}), the drive has none", name, simulator);
    default:
      return fmt::format("its {} is {} where the drive's is {}", name, simulator, drive);
  }
}

/// What mending takes; where errors of several rows hide each other, no row alone takes any.
std::string mended_words(const SimulatorComparison& c, Coordinates coordinates) {
  const SimulatorErrors& e = c.errors;
  std::string text = fmt::format(
      " Over the held-out input it is {} rms off the drive. A model fitted to it stands in for it (it misses "
      "it by {}): its error, {},",
      coordinates.thousandths(e.simulator), coordinates.thousandths(e.stand_in_miss),
      coordinates.thousandths(e.stand_in));
  const std::string first = readable(c.rows.front().name);
  text += c.shrink > 0.0
              ? fmt::format(" falls to {} with {} mended, by {} %", coordinates.thousandths(e.mended), first,
                            with_decimals(100.0 * c.shrink, 0))
              : fmt::format(" does not fall with {} alone mended", first);
  const auto differing =
      std::count_if(c.rows.begin(), c.rows.end(), [](const SimulatorRow& r) { return r.differs; });
  if (differing > 1)
    text += fmt::format("; with all {} rows it is {}", differing, coordinates.thousandths(e.all_mended));
  return text + ".";
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

std::string differing_sentence(const SimulatorComparison& c, Coordinates coordinates) {
  std::vector<std::string> parts;
  for (const SimulatorRow& row : c.rows)
    if (row.differs) parts.push_back(row.sentence);
  return fmt::format("Your simulator differs from the drive: {}.", fmt::join(parts, "; ")) +
         mended_words(c, coordinates);
}

/// What keeps "no row differs" from being all that there is to say; empty where nothing does. A simulator
/// that the model does not follow was not compared at all.
std::string hidden_sentence(const SimulatorComparison& c, double drive_floors, double simulator_floors) {
  const SharedUnit floors(1.0, "");
  if (simulator_floors > kRule.far)
    return fmt::format(
        "What differs is not told: the model with all effects of both leaves {} floors on your simulator, "
        "which it does not follow.",
        floors.number(simulator_floors));
  if (drive_floors > kRule.far)
    return fmt::format(
        "No row differs, but the model with all effects of both leaves {} floors on the drive: what differs "
        "may hide there.",
        floors.number(drive_floors));
  if (const double off = c.errors.simulator / c.floor; off > kLeastRow)
    return fmt::format(
        "What differs is not told: no row does, though your simulator is {} floors off the drive.",
        floors.number(off));
  return "";
}

std::string alike_sentence(const SimulatorComparison& c, double drive_floors, double simulator_floors,
                           Coordinates coordinates) {
  const std::string hidden = hidden_sentence(c, drive_floors, simulator_floors);
  return fmt::format("{} Over the held-out input your simulator is {} rms off the drive.",
                     hidden.empty()
                         ? "Your simulator lacks nothing that these recordings would show above two floors."
                         : hidden,
                     coordinates.thousandths(c.errors.simulator));
}

}  // namespace

std::string row_sentence(const SimulatorRow& row, const std::vector<SimulatorRow>& rows, double dt,
                         Coordinates coordinates) {
  if (row.is_effect)
    return effect_row_sentence(row, coordinates) + in_steps(row, dt) + creeping(row) + likely_others(row);
  const ComparedNumber& n = row.numbers.front();
  return fmt::format("its {} is {} where the drive's is {}", readable(row.name),
                     amount(n.simulator, n.unit, coordinates), amount(n.drive, n.unit, coordinates)) +
         implicitly_damped(row, rows, dt);
}

std::string sentence_beside(const SimulatorComparison& c, double drive_floors, double simulator_floors,
                            Coordinates coordinates) {
  const bool differs = !c.rows.empty() && c.rows.front().differs;
  return differs ? differing_sentence(c, coordinates)
                 : alike_sentence(c, drive_floors, simulator_floors, coordinates);
}

}  // namespace gapscope::internal::diagnosis
