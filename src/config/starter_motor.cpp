#include "config/starter_motor.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

/// Sharpness of torque_saturation for a limit that is hard: at the knee 1.4 % are missing.
constexpr double kHardLimit = 50.0;

constexpr const char* kTakenByTheGain =
    "not known apart from the controller's gain, which scales with it: only their product acts";

/// A number of the motor's sheet, which is that of its own shaft.
/// @param begun  it is where the fit begins, and no more
std::string of_the_sheet(double value, bool geared, bool begun = false) {
  const std::string number = yaml_number(value);
  if (!geared && !begun) return number;
  return fmt::format("{{value: {}{}{}}}", number, begun ? ", estimate: true" : "",
                     geared ? ", given_at: motor" : "");
}

/// The inertia and the torque constant where an anchor tells their scale.
void write_anchored(YamlWriter& out, const Begin& begin, Coordinates coordinates) {
  if (begin.gain_sought)
    out.entry("torque_constant", "1", kTakenByTheGain);
  else if (begin.input_is_torque)
    out.entry("torque_constant", "1", std::string("u is in ") + coordinates.torque_unit() + " already");
  else
    out.comment("torque_constant: the fit finds it, by the anchor below");
  if (!begin.knows_inertia)
    out.entry("motor_inertia", "{estimate: true}", coordinates.unit("kg m^2") + "; the fit finds its start");
  out.entry("motor_damping", "{estimate: true}", coordinates.unit("N m s/rad") + "; the fit finds its start");
}

/// "{value: 0.0342, estimate: true}": what a file says in six digits, what was read in three.
std::string start_text(double value, const Begin& begin) {
  return begin.nominal ? fmt::format("{{value: {:.6g}, estimate: true}}", value)
                       : fmt::format("{{value: {:.3g}, estimate: true}}", value);
}

}  // namespace

void write_estimated(YamlWriter& out, const char* key, double value, const std::string& unit,
                     const Begin& begin) {
  const bool known = value > 0.0;
  out.entry(key, known ? start_text(value, begin) : "{estimate: true}",
            unit + "; " + (known ? begin.from : "the fit finds its start"));
}

void take_constant(Begin& begin, double constant, double ratio) {
  const std::string told = fmt::format("gapscope: torque_constant {:g} is given ", constant);
  if (begin.input_is_torque)
    throw ConfigError(told + "of an input that is a torque or force already, expected none: it is 1 there");
  if (begin.gain_sought)
    throw ConfigError(
        told + "beside a gain that is to be estimated, expected one of the two: only their product acts");
  begin.motor_constant = constant;
  begin.numbers.torque_constant = constant * ratio;
  for (double* read : {&begin.numbers.inertia, &begin.numbers.damping, &begin.numbers.friction})
    *read *= constant * ratio;
}

void write_motor(YamlWriter& out, const Begin& begin, Coordinates coordinates) {
  if (begin.anchored) return write_anchored(out, begin, coordinates);
  if (begin.gain_sought)
    out.entry("torque_constant", "1", kTakenByTheGain);
  else if (begin.input_is_torque)
    out.entry("torque_constant", "1", std::string("u is in ") + coordinates.torque_unit() + " already");
  else if (begin.motor_constant > 0.0)
    out.entry("torque_constant", of_the_sheet(begin.motor_constant, begin.geared),
              coordinates.with_units("[N m] per unit of u, as given"));
  else if (begin.numbers.torque_constant > 0.0)
    out.entry("torque_constant", yaml_number(begin.numbers.torque_constant),
              coordinates.with_units("[N m] per unit of u; ") + begin.from +
                  (begin.nominal ? "; every number that is fitted goes in proportion to it" : ""));
  else
    out.entry("torque_constant", "{value: 1, guess: true}",
              coordinates.with_units("GUESS: [N m] per unit of u; with 1 all torques are in units of u. "
                                     "Where it is known: torque_constant: ") +
                  (begin.geared ? "{value: 0.06, given_at: motor}, say, before the gear" : "0.172, say"));
  const char* const scale = begin.settled() ? "" : " (over torque_constant)";
  if (begin.motor_inertia > 0.0)
    out.entry(
        "motor_inertia", of_the_sheet(begin.motor_inertia, begin.geared, begin.one_body),
        coordinates.unit("kg m^2") +
            (begin.one_body ? "; begun as given, and fitted: it is that of all that moves" : ", as given"));
  else
    write_estimated(out, "motor_inertia", begin.numbers.inertia,
                    coordinates.unit("kg m^2") + scale + "; better the sheet's" +
                        (begin.geared ? ": {value: 3e-5, given_at: motor}, say" : ""),
                    begin);
  write_estimated(out, "motor_damping", begin.numbers.damping, coordinates.unit("N m s/rad") + scale, begin);
}

namespace {

/// About 0 a fit looks that far on its own (anchor_reader.cpp), and so it does about what is read [rad].
constexpr double kHangsWithin = 0.5;

/// Beyond half of that a start at 0 is nearer to its bound than to where the arm hangs.
bool hangs_elsewhere(const AnchorConfig& anchor, double hangs_at) {
  return std::isfinite(anchor.mass) && std::abs(hangs_at) > 0.5 * kHangsWithin;
}

}  // namespace

std::string hanging_told(const AnchorConfig& anchor, double hangs_at) {
  if (!hangs_elsewhere(anchor, hangs_at)) return "";
  return fmt::format("{:.2f} rad, read off the recording: the position at which the arm hangs down",
                     hangs_at);
}

std::string anchor_comment(const AnchorConfig& anchor, double hangs_at) {
  const std::string known = "known of the drive: sets the scale of all torques";
  if (!std::isfinite(anchor.mass)) return known;
  if (hangs_elsewhere(anchor, hangs_at))
    return known + "; hangs_at [rad]: where the arm hangs down, read off the recording, the fit finds it";
  if (std::isfinite(hangs_at)) return known + "; the arm hangs down at about 0, as the recording shows";
  return known +
         "; that the arm hangs down at 0 (within 0.5 rad) the recording does not show: else add hangs_at: "
         "its position there [rad], e.g. 3.14";
}

std::string anchor_text(const AnchorConfig& anchor, double hangs_at) {
  std::string text;
  const auto add = [&](const char* key, double value) {
    if (std::isfinite(value))
      text += (text.empty() ? "" : ", ") + fmt::format("{}: {}", key, yaml_number(value));
  };
  add("mass", anchor.mass), add("arm", anchor.arm);
  if (hangs_elsewhere(anchor, hangs_at))
    text += fmt::format(", hangs_at: {{value: {0:.2f}, estimate: true, bounds: [{1:.2f}, {2:.2f}]}}",
                        hangs_at, hangs_at - kHangsWithin, hangs_at + kHangsWithin);
  add("inertia", anchor.inertia), add("friction", anchor.friction);
  return "{" + text + "}";
}

void suggest_anchor(YamlWriter& out, bool gain_sought, Coordinates coordinates) {
  if (gain_sought)
    out.comment(
        "GUESS: without a number with a unit of torque the fit gives ratios only. Delete the line of "
        "motor_inertia, and say what you know (or gapscope init --mass 0.49 --arm 0.1, or --inertia):");
  else
    out.comment(
        "No data sheet gives torque_constant? Delete its line and that of motor_inertia, and say what you know (the "
        "fit then sets aside what it cannot start from; or gapscope init --mass 0.49 --arm 0.1, or --inertia):");
  out.comment("anchor: {inertia: 8.8e-4}  # " + coordinates.unit("kg m^2") + ", of the motor's side" +
              (coordinates.rotational() ? "; or {mass: 0.49, arm: 0.1}  # kg, m" : ""));
}

namespace {

/// One effect of a simulator's model, each of its numbers as a start of the fit.
void write_effect(YamlWriter& out, const Begin& begin, const char* name,
                  std::initializer_list<std::pair<const char*, double>> numbers, const std::string& comment) {
  std::string text;
  for (const auto& [key, value] : numbers)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", key, start_text(value, begin));
  out.entry(std::string("- ") + name, "{" + text + "}", comment);
}

void write_friction(YamlWriter& out, const Begin& begin, const std::string& unit) {
  const std::string of = unit + (begin.settled() ? "; " : " (over torque_constant); ") + begin.from;
  const double level = begin.numbers.friction;
  if (begin.anchored || begin.friction_sought)
    out.entry("- motor_coulomb_friction", "{level_nm: {estimate: true}}",
              unit + (begin.settled() ? "" : " (over torque_constant)") + "; the fit finds its start");
  else if (begin.asymmetry != 0.0)
    write_effect(out, begin, "friction_asymmetry", {{"level_nm", level}, {"coulomb_ratio", begin.asymmetry}},
                 of);
  else
    write_effect(out, begin, "motor_coulomb_friction", {{"level_nm", level}}, of);
}

/// A file of one joint has its motor in the armature: with a gap, what is behind that is the load.
void part_armature(JointNumbers& n) {
  const double armature = n.inertia - n.body_inertia;
  if (!n.load_joint.empty() || !(armature > 0.0) || !(n.body_inertia > 0.0)) return;
  n.load_inertia = n.body_inertia, n.inertia = armature;
  n.notes.push_back("the motor has the armature alone, and the load the inertia of the body");
}

}  // namespace

void fit_to_structure(Begin& begin, StarterModel structure) {
  constexpr double kMostAsymmetric = 0.99;  // of friction_asymmetry
  JointNumbers& n = begin.numbers;
  if (structure == StarterModel::kGap) part_armature(n);
  const auto refuse = [&](double& torque, const char* why) {
    if (torque != 0.0)
      n.notes.push_back(fmt::format("not taken: the constant torque {:.4g}, {}", torque, why));
    torque = 0.0;
  };
  if (structure == StarterModel::kLocked) {
    refuse(n.constant_torque, "as the output does not move");
    refuse(n.load_constant_torque, "as the output does not move");
    if (n.unbalance > 0.0) n.notes.push_back("not taken: gravity, as the output does not move");
    n.unbalance = kNaN;
  }
  const bool behind_a_gap = structure == StarterModel::kGap && !n.load_joint.empty();
  if (!behind_a_gap) n.load_constant_torque += n.constant_torque, n.constant_torque = 0.0;
  begin.asymmetry = n.friction > 0.0 && n.constant_torque != 0.0 ? -n.constant_torque / n.friction : 0.0;
  if (std::abs(begin.asymmetry) <= kMostAsymmetric && begin.asymmetry != 0.0) return;
  begin.asymmetry = 0.0;
  refuse(n.constant_torque, "which is more than the friction of the motor's joint holds");
}

void doubt_the_control(Begin& begin, Coordinates coordinates) {
  constexpr double kFarBeyond = 2.0;  // a command that is clipped goes less far
  JointNumbers& n = begin.numbers;
  const bool geared = n.torque_constant > 0.0 && n.torque_constant != 1.0;
  if (!geared || !(begin.largest_input > kFarBeyond * n.input_limit)) return;
  n.notes.push_back(
      fmt::format("the input reaches {:.3g}, {:.2g} times the range of the actuator's control ({:.3g}): is "
                  "it the {} at the "
                  "joint? Then take torque_constant: 1 and no torque_saturation; with {:.3g} every number "
                  "here comes out so many times too large",
                  begin.largest_input, begin.largest_input / n.input_limit, n.input_limit,
                  coordinates.torque_word(), n.torque_constant));
}

void write_effects(YamlWriter& out, const Begin& begin, Coordinates coordinates) {
  const char* const others = "`gapscope effects` lists what else a drive may have";
  const JointNumbers& n = begin.numbers;
  const bool clipped = n.input_limit < begin.largest_input;
  const bool rubs = n.friction > 0.0 || begin.friction_sought;
  if (!rubs && !(n.unbalance > 0.0) && n.load_constant_torque == 0.0 && !(n.lag > 0.0) && !clipped)
    return out.entry("effects", "[]", others);
  out.open("effects");
  out.comment(others);
  const std::string unit = coordinates.torque_unit();
  if (n.unbalance > 0.0)
    write_effect(out, begin, "load_unbalance",
                 {{"amplitude_nm", n.unbalance}, {"phase_rad", n.unbalance_phase}},
                 unit + ", rad; gravity " + begin.from);
  if (n.load_constant_torque != 0.0)
    write_effect(out, begin, "constant_load_torque", {{"torque_nm", n.load_constant_torque}},
                 unit + "; " + begin.from);
  if (n.lag > 0.0)
    write_effect(out, begin, "actuator_lag", {{"time_constant_s", n.lag}}, "s; filter of the actuator");
  if (clipped)
    write_effect(out, begin, "torque_saturation", {{"knee", n.input_limit}, {"sharpness", kHardLimit}},
                 "unit of u; range of the actuator, which the input exceeds");
  if (rubs) write_friction(out, begin, unit);
  out.close();
}

}  // namespace gapscope::internal::config
