#include "exports/left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/carriage.h"

namespace gapscope::internal::exports {
namespace {

/// Of the travel: a target that is farther off is no model of the drive, and is told not to be used as it is.
/// Of `study_left_out 1890001 120` (six effects over five decades in two rigs) these are 24, by half of it
/// 30, by double 17.
constexpr double kFarOff = 0.01;

/// Of the encoder: what is left out and does more than that says the same at any step worth taking, and one
/// row takes the place of the table of steps. Of the same drives in 70, by half of it in 73, by double in 65.
constexpr double kManyFloors = 10.0;

constexpr const char* kInTheLoop = "in your loop, before each step: `";

constexpr const char* kController = "controller";

/// What every format leaves to the loop is no part that it lacks.
bool lacks(const CarriedPart& part) {
  return part.fidelity == Fidelity::kLeftOut && part.part != "torque_constant" && part.part != kController;
}

/// "+ 0.5", "- 0.5"
std::string signed_term(double value) {
  return fmt::format("{} {:.6g}", value < 0.0 ? '-' : '+', std::abs(value));
}

/// An effect's numbers by their keys.
struct Numbers {
  const ModelEffect& effect;
  double operator()(const char* key) const { return value_in(effect, key); }
};

/// "sin(6*qpos + 0.5)"; with harmonics "(sin(y) + 0.1*sin(2*y))", y being told behind the line.
std::string wave(const Numbers& of, const char* position, std::string& where) {
  const double phase = of("phase_rad");
  std::string angle = fmt::format("{:.6g}*{}", of("periods_per_turn"), position);
  if (phase != 0.0) angle += " " + signed_term(phase);
  std::string further;
  const auto add = [&](const char* key, const char* term) {
    if (const double size = of(key); size != 0.0) further += " " + signed_term(size) + "*" + term;
  };
  add("second_harmonic", "sin(2*y)"), add("second_harmonic_cos", "cos(2*y)");
  add("third_harmonic", "sin(3*y)"), add("third_harmonic_cos", "cos(3*y)");
  if (further.empty()) return "sin(" + angle + ")";
  where = " with y = " + angle;
  return "(sin(y)" + further + ")";
}

/// A line of a loop; empty: there is none that is short.
struct LoopLine {
  std::string code;
  std::string remark = {};  ///< behind it
};

/// "0.0117 ms"
std::string milliseconds(double seconds) { return fmt::format("{:.3g} ms", 1e3 * seconds); }

/// The input of so many steps ago, out of a ring; C, as the other lines.
LoopLine delay_line(double delay, double step) {
  const double count = std::round(delay / step), left = count * step - delay;
  if (count < 1.0) return {};
  const std::string at_another = fmt::format("at another step round({:.6g}/step) of them", delay);
  const std::string rounding =
      std::abs(left) < 1e-6 * delay
          ? ""
          : fmt::format(", {} {} than the delay", milliseconds(std::abs(left)), left > 0.0 ? "more" : "less");
  return {fmt::format("static double past[{0}]; static int at; double now = u; u = past[at]; past[at] = now; "
                      "at = (at + 1) % {0};",
                      count),
          fmt::format(" ({} steps of {}{}; {})", count, milliseconds(step), rounding, at_another)};
}

/// The line that is the effect.
LoopLine loop_line(const ModelEffect& effect, const LoopWords& w) {
  const Numbers of{effect};
  const std::string_view name = effect.entry->name;
  std::string where;
  if (name == "torque_ripple") {
    const std::string factor = fmt::format("(1 + {:.6g}*{})", of("ratio"), wave(of, w.position, where));
    const std::string input = w.gain == 1.0 ? "u" : fmt::format("{:.6g}*u", w.gain);
    return {fmt::format("{} = {}*{}{}", w.command, input, factor, where)};
  }
  if (name == "cogging_torque" || name == "load_unbalance") {
    const std::string term = wave(of, w.position, where);
    return {fmt::format("{} -= {:.6g}*{}{}", w.torque, of("amplitude_nm"), term, where)};
  }
  if (name == "quadratic_drag")
    return {fmt::format("{0} -= {1:.6g}*{2}*pow(fabs({2}), {3:.6g})", w.torque, of("coefficient_nms2"),
                        w.speed, of("exponent") - 1.0)};
  if (name == "input_dead_zone")
    return {fmt::format("u = u > {0:.6g} ? u - {0:.6g} : u < -{0:.6g} ? u + {0:.6g} : 0", of("width"))};
  if (name == "input_delay") return delay_line(of("delay_s"), w.step);
  return {};
}

/// "3.04 rad", "12 mrad"
std::string length_words(double length, Coordinates coordinates) {
  return length < 1.0 ? coordinates.thousandths(length)
                      : fmt::format("{:.3g} {}", length, coordinates.position_unit());
}

/// Whether a format has exactly what slow recordings do not tell from a delay.
bool has_lag(const std::string& format) {
  return std::ranges::any_of(carriage_of(format), [](const Carriage& c) {
    return c.part == "actuator_lag" && c.fidelity == Fidelity::kExact;
  });
}

const TargetError* least(const std::vector<TargetError>& errors) {
  const auto at = std::min_element(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
    return !std::isnan(a.rms) && (std::isnan(b.rms) || a.rms < b.rms);
  });
  return at == errors.end() || std::isnan(at->rms) ? nullptr : &*at;
}

}  // namespace

void add_loop_lines(const ExportSource& source, const LoopWords& words, Certificate& c) {
  const std::size_t first = c.parts.size() - source.drive.effects.size();  // numbers of the drive before them
  for (std::size_t i = first; i < c.parts.size(); ++i) {
    if (!lacks(c.parts[i])) continue;
    const LoopLine line = loop_line(source.drive.effects[i - first].effect, words);
    if (!line.code.empty()) c.parts[i].how += "; " + (kInTheLoop + line.code) + "`" + line.remark;
  }
}

bool hides_the_steps(const ExportSource& source, const std::vector<CarriedPart>& parts, double rms,
                     double travel) {
  const bool shows =
      std::isnan(source.encoder_floor) ? rms > kFarOff * travel : rms > kManyFloors * source.encoder_floor;
  return shows && std::any_of(parts.begin(), parts.end(), lacks);
}

void tell_controller(const ExportSource& source, Certificate& c) {
  const std::string torque = source.coordinates.torque_word();
  const std::string input = "the input of the file is u, not the goal (" + torque + " = torque_constant * u)";
  c.parts.push_back({kController, Fidelity::kLeftOut,
                     "yours to run, with the numbers of `controller:` in the configuration: " + input});
  c.warnings.push_back("the controller is not in the file: " + input +
                       "; give it what your controller makes of the goal");
}

void warn_of_left_out(const ExportSource& source, Certificate& c) {
  const TargetError* error = least(c.errors);
  if (error == nullptr || error->rms <= source.encoder_floor) return;
  const bool far = error->rms > kFarOff * c.travel;
  std::string names, lines;
  for (const CarriedPart& part : c.parts) {
    if (!lacks(part) && !(far && part.fidelity == Fidelity::kApproximate)) continue;
    names += (names.empty() ? "" : ", ") + part.part;
    if (const auto at = part.how.find(kInTheLoop); at != part.how.npos)
      lines += " What mends " + part.part + ", " + part.how.substr(at) + ".";
    if (part.part == "input_delay" && has_lag(c.format))
      lines +=
          " Where the diagnosis says of the delay that it may as well be actuator lag, which this format "
          "has: `gapscope diagnose` with `--exclude input_delay --exclude measurement_lag` adds that, for an "
          "export of its own.";
  }
  if (names.empty()) return;
  c.warnings.push_back(fmt::format(
      "by what is left out or approximated ({}) this file is {} rms off, on a travel of {}{}{}", names,
      length_words(error->rms, source.coordinates), length_words(c.travel, source.coordinates),
      far ? ": do not use it as it is, unless the file that you have is farther off." : ".", lines));
}

}  // namespace gapscope::internal::exports
