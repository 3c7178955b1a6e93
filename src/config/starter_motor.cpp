#include "config/starter_motor.h"

#include <fmt/format.h>

#include <cmath>

namespace gapscope::internal::config {
namespace {

constexpr const char* kTakenByTheGain =
    "not known apart from the controller's gain, which takes its size: only their product acts";

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

}  // namespace

void write_estimated(YamlWriter& out, const char* key, double value, const std::string& unit,
                     const std::string& from) {
  const bool known = value > 0.0;
  out.entry(key, known ? fmt::format("{{value: {:.3g}, estimate: true}}", value) : "{estimate: true}",
            unit + "; " + (known ? from : "the fit finds its start"));
}

void write_motor(YamlWriter& out, const Begin& begin, Coordinates coordinates) {
  if (begin.anchored) return write_anchored(out, begin, coordinates);
  if (begin.gain_sought)
    out.entry("torque_constant", "1", kTakenByTheGain);
  else if (begin.input_is_torque)
    out.entry("torque_constant", "1", std::string("u is in ") + coordinates.torque_unit() + " already");
  else if (begin.numbers.torque_constant > 0.0)
    out.entry("torque_constant", yaml_number(begin.numbers.torque_constant),
              coordinates.with_units("[N m] per unit of u; ") + begin.from);
  else
    out.entry("torque_constant", "{value: 1, guess: true}",
              coordinates.with_units("GUESS: [N m] per unit of u; with 1 all torques are in units of u. "
                                     "Where it is known: torque_constant: 0.172, say"));
  const char* const scale = begin.settled() ? "" : " (over torque_constant)";
  write_estimated(out, "motor_inertia", begin.numbers.inertia,
                  coordinates.unit("kg m^2") + scale + "; better the sheet's", begin.from);
  write_estimated(out, "motor_damping", begin.numbers.damping, coordinates.unit("N m s/rad") + scale,
                  begin.from);
}

std::string anchor_text(const AnchorConfig& anchor) {
  std::string text;
  const auto add = [&](const char* key, double value) {
    if (std::isfinite(value))
      text += (text.empty() ? "" : ", ") + fmt::format("{}: {}", key, yaml_number(value));
  };
  add("mass", anchor.mass), add("arm", anchor.arm);
  add("inertia", anchor.inertia), add("friction", anchor.friction);
  return "{" + text + "}";
}

void suggest_anchor(YamlWriter& out, bool gain_sought, Coordinates coordinates) {
  if (gain_sought)
    out.comment(
        "GUESS: without a number with a unit of torque the fit tells ratios only. Delete the line of "
        "motor_inertia, and say what you know (or gapscope init --mass 0.49 --arm 0.1, or --inertia):");
  else
    out.comment(
        "No sheet tells torque_constant? Delete its line and that of motor_inertia, and say what you know "
        "(the "
        "fit then sets aside what it cannot start from; or gapscope init --mass 0.49 --arm 0.1, or "
        "--inertia):");
  out.comment("anchor: {inertia: 8.8e-4}  # " + coordinates.unit("kg m^2") + ", of the motor's side" +
              (coordinates.rotational() ? "; or {mass: 0.49, arm: 0.1}  # kg, m" : ""));
}

void write_effects(YamlWriter& out, const Begin& begin, Coordinates coordinates) {
  const char* const others = "`gapscope effects` lists what else a drive may have";
  const double friction = begin.numbers.friction, unbalance = begin.numbers.unbalance;
  if (!(friction > 0.0) && !(unbalance > 0.0)) return out.entry("effects", "[]", others);
  out.open("effects");
  out.comment(others);
  const std::string unit = coordinates.torque_unit();
  if (unbalance > 0.0)
    out.entry("- load_unbalance",
              fmt::format("{{amplitude_nm: {{value: {:.3g}, estimate: true}}, phase_rad: {{value: {:.3g}, "
                          "estimate: true}}}}",
                          unbalance, begin.numbers.unbalance_phase),
              unit + ", rad; gravity " + begin.from);
  if (!(friction > 0.0)) return out.close();
  if (begin.anchored)
    out.entry("- motor_coulomb_friction", "{level_nm: {estimate: true}}", unit + "; the fit finds its start");
  else
    out.entry("- motor_coulomb_friction",
              fmt::format("{{level_nm: {{value: {:.3g}, estimate: true}}}}", friction),
              unit + (begin.settled() ? "; " : " (over torque_constant); ") + begin.from);
  out.close();
}

}  // namespace gapscope::internal::config
