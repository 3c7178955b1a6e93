#include "exports/c_header.h"

#include <fmt/format.h>
#include <math.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <memory>

#include "base/require.h"
#include "base/text.h"
#include "exports/carried.h"
#include "exports/stiff_contact.h"
#include "exports/target_errors.h"

namespace gapscope::internal::exports {
namespace {

constexpr int kMostHeld = 1 << 12;
#define GSD_HELD kMostHeld
#include "exports/drive_step.c"
#undef GSD_HELD

constexpr const char* kNotInC = "the generated code has no such law";

void set_motor(const ExportSource& s, gsd_numbers& n) {
  const PlantModel<double>& plant = s.plant;
  n.km = plant.drive.torque_constant;
  n.m1 = plant.drive.motor_inertia;
  n.d1_plus = plant.drive.motor_damping + plant.motor_damping_excess;
  n.d1_minus = plant.drive.motor_damping - plant.motor_damping_excess;
  const double bristle = effect_value(s, "presliding_friction", "level_nm");
  n.f1_plus = std::max(plant.motor_friction_plus, 0.0) + bristle;
  n.f1_minus = std::max(plant.motor_friction_minus, 0.0) + bristle;
  n.motor_sticks = plant.motor_sticks ? 1 : 0;
}

void set_load(const ExportSource& s, gsd_numbers& n) {
  const PlantModel<double>& plant = s.plant;
  n.has_load = plant.structure.has_load ? 1 : 0;
  n.locked = n.has_load != 0 && plant.structure.load == LoadKind::kLocked ? 1 : 0;
  const bool free = n.has_load != 0 && n.locked == 0;
  n.m2 = free ? plant.drive.motor_inertia * plant.drive.mass_ratio : n.m1;
  n.d2 = free ? plant.drive.load_damping : 0.0;
  n.f2 = free ? plant.drive.load_coulomb_friction : 0.0;
  n.load_sticks = free && plant.load_sticks ? 1 : 0;
  n.load_torque = plant.load_torque;
  n.half_gap = 0.5 * plant.drive.gap;
  n.k = plant.drive.contact_stiffness, n.c = plant.drive.contact_damping;
  n.adhesion = plant.adhesion;
  if (n.has_load != 0 && plant.structure.contact == ContactLaw::kRigid) {
    const StiffContact stiff =
        stiff_contact(plant.structure, 1.0 / n.m1 + (n.locked != 0 ? 0.0 : 1.0 / n.m2));
    n.k = stiff.stiffness, n.c = stiff.damping;
  }
}

void set_command(const ExportSource& s, gsd_numbers& n) {
  n.delay = effect_value(s, "input_delay", "delay_s");
  n.lag = effect_value(s, "actuator_lag", "time_constant_s");
  const double knee = effect_value(s, "torque_saturation", "knee");
  n.knee = std::isfinite(knee) ? knee : 0.0;
  n.sharpness = effect_value(s, "torque_saturation", "sharpness");
  n.dead_zone = effect_value(s, "input_dead_zone", "width");
}

void set_smooth(const ExportSource& s, gsd_numbers& n) {
  const auto of = [&](const char* effect, const char* key) { return effect_value(s, effect, key); };
  n.cogging = of("cogging_torque", "amplitude_nm"), n.cogging_n = of("cogging_torque", "periods_per_turn");
  n.cogging_phase = of("cogging_torque", "phase_rad");
  n.cogging_s2 = of("cogging_torque", "second_harmonic");
  n.cogging_c2 = of("cogging_torque", "second_harmonic_cos");
  n.cogging_s3 = of("cogging_torque", "third_harmonic");
  n.cogging_c3 = of("cogging_torque", "third_harmonic_cos");
  n.ripple = of("torque_ripple", "ratio"), n.ripple_n = of("torque_ripple", "periods_per_turn");
  n.ripple_phase = of("torque_ripple", "phase_rad");
  n.ripple_s2 = of("torque_ripple", "second_harmonic"),
  n.ripple_c2 = of("torque_ripple", "second_harmonic_cos");
  n.ripple_s3 = of("torque_ripple", "third_harmonic"),
  n.ripple_c3 = of("torque_ripple", "third_harmonic_cos");
  n.unbalance = of("load_unbalance", "amplitude_nm"), n.unbalance_phase = of("load_unbalance", "phase_rad");
  n.unbalance_n = of("load_unbalance", "periods_per_turn");
  n.drag = of("quadratic_drag", "coefficient_nms2"), n.drag_exponent = of("quadratic_drag", "exponent");
  n.stribeck_level = of("stribeck_friction", "level_nm");
  n.stiction = n.stribeck_level * of("stribeck_friction", "stiction_ratio");
  n.stribeck_speed = of("stribeck_friction", "stribeck_speed_rad_s");
  n.stribeck_exponent = of("stribeck_friction", "exponent");
  const double sizes[] = {n.cogging, n.ripple, n.unbalance, n.drag, n.stiction};
  n.smooth = std::any_of(std::begin(sizes), std::end(sizes), [](double size) { return size != 0.0; }) ? 1 : 0;
}

gsd_numbers numbers_of(const ExportSource& s) {
  gsd_numbers n{};
  n.dt = s.dt;
  set_motor(s, n);
  set_load(s, n);
  set_command(s, n);
  set_smooth(s, n);
  return n;
}

/// What the struct of the header begins with, in its order.
std::string initialiser(const gsd_numbers& n) {
  const double values[] = {n.dt,
                           n.km,
                           n.m1,
                           n.m2,
                           n.d1_plus,
                           n.d1_minus,
                           n.d2,
                           n.f1_plus,
                           n.f1_minus,
                           n.f2,
                           n.load_torque,
                           n.half_gap,
                           n.k,
                           n.c,
                           n.adhesion,
                           n.delay,
                           n.lag,
                           n.knee,
                           n.sharpness,
                           n.dead_zone,
                           n.cogging,
                           n.cogging_n,
                           n.cogging_phase,
                           n.cogging_s2,
                           n.cogging_c2,
                           n.cogging_s3,
                           n.cogging_c3,
                           n.ripple,
                           n.ripple_n,
                           n.ripple_phase,
                           n.ripple_s2,
                           n.ripple_c2,
                           n.ripple_s3,
                           n.ripple_c3,
                           n.unbalance,
                           n.unbalance_phase,
                           n.unbalance_n,
                           n.drag,
                           n.drag_exponent,
                           n.stiction,
                           n.stribeck_speed,
                           n.stribeck_exponent,
                           n.stribeck_level};
  static_assert(offsetof(gsd_numbers, has_load) == sizeof values);
  const int flags[] = {n.has_load, n.locked, n.motor_sticks, n.load_sticks, n.smooth};
  static_assert(sizeof(gsd_numbers) >= sizeof values + sizeof flags);
  return fmt::format("{:.17g},\n    {}", fmt::join(values, ", "), fmt::join(flags, ", "));
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

int held_inputs(const gsd_numbers& n) { return static_cast<int>(n.delay / n.dt) + 2; }

std::string header_text(const ExportSource& s, const gsd_numbers& n) {
  const std::string guard = upper(s.stem) + "_DRIVE_H";
  std::string text = fmt::format(
      "/* {0} by gapscope, C99; certificate.md says what it carries and how exactly.\n"
      "\n"
      "     {0}_state drive;\n"
      "     {0}_start(&drive);                      // as the recording began\n"
      "     for (;;) x1 = {0}_step(&drive, u);      // x1 [{1}] at the end of a step of {2} s with the input u\n"
      "\n"
      "   u [unit of u] is held over the step; torque {3} {4} per unit on the motor. Link with -lm. */\n"
      "#ifndef {5}\n#define {5}\n\n#include <math.h>\n\n#define GSD_HELD {6}\n\n",
      s.stem, s.coordinates.position_unit(), s.dt, n.km, s.coordinates.torque_unit(), guard, held_inputs(n));
  text += drive_step_text();
  text += fmt::format(
      "\nstatic const gsd_numbers gsd_of_drive = {{\n    {}}};\n\n"
      "/* At rest or in motion, as the recording began. */\n"
      "static inline void gsd_start(gsd_state *s) {{\n  gsd_start_at(&gsd_of_drive, s, {:.17g}, {:.17g}, "
      "{:.17g}, {:.17g});\n}}\n\n"
      "static inline double gsd_step(gsd_state *s, double u) {{ return gsd_advance_by_step(&gsd_of_drive, s, "
      "u); }}\n\n#endif\n",
      initialiser(n), s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2);
  return replaced(replaced(text, "gsd_", s.stem + "_"), "GSD_", upper(s.stem) + "_");
}

/// Of C, and of what its own headers include on Unix: a file of that name in a folder of -I hides them.
constexpr const char* kSystemHeaders[] = {
    "alloca",   "assert",      "complex", "ctype",    "dlfcn",     "endian",  "errno",  "fcntl",
    "features", "fenv",        "float",   "inttypes", "iso646",    "limits",  "locale", "malloc",
    "math",     "memory",      "poll",    "pthread",  "sched",     "setjmp",  "signal", "stdalign",
    "stdarg",   "stdatomic",   "stdbit",  "stdbool",  "stdckdint", "stddef",  "stdint", "stdio",
    "stdlib",   "stdnoreturn", "string",  "strings",  "tgmath",    "threads", "time",   "uchar",
    "unistd",   "values",      "wchar",   "wctype"};

std::string header_name(const std::string& stem) {
  const bool hides = std::any_of(std::begin(kSystemHeaders), std::end(kSystemHeaders),
                                 [&](const char* name) { return upper(name) == upper(stem); });
  return (hides ? "drive_" : "") + stem + ".h";
}

TargetError error_of(const ExportSource& s, double& travel) {
  std::vector<double> times;
  for (std::size_t i = 0; i <= s.u.size(); ++i) times.push_back(s.dt * static_cast<double>(i));
  const std::vector<double> model = model_motion(s, times);
  TargetError e = compared(model, c_motion(s));
  e.integrator = "event-exact", e.step = s.dt;
  e.within_encoder = e.rms <= s.encoder_floor;
  travel = range_of(model);
  return e;
}

}  // namespace

std::vector<double> c_motion(const ExportSource& s) {
  const gsd_numbers n = numbers_of(s);
  GAPSCOPE_REQUIRE(held_inputs(n) <= kMostHeld);
  const auto state = std::make_unique<gsd_state>();
  gsd_start_at(&n, state.get(), s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2);
  std::vector<double> x1 = {state->x1};
  for (const double u : s.u) x1.push_back(gsd_advance_by_step(&n, state.get(), u));
  return x1;
}

DriveExport export_c(const ExportSource& s) {
  DriveExport out;
  Certificate& c = out.certificate;
  c.format = "c";
  c.parts = carried_parts(s, carriage_of("c"), kNotInC);
  for (CarriedPart& part : c.parts)
    if (part.part == "gap" && s.drive.structure.contact == ContactLaw::kRigid)
      part = {"gap", Fidelity::kApproximate, "a stiff contact in place of the impact law"};
  c.errors.push_back(error_of(s, c.travel));
  out.files = {{header_name(s.stem), header_text(s, numbers_of(s))}};
  return out;
}

}  // namespace gapscope::internal::exports
