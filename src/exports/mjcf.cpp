#include "exports/mjcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exports/left_out.h"
#include "exports/mjcf_elements.h"
#include "exports/mujoco_drive.h"
#include "exports/offset_mass.h"
#include "exports/own_file.h"
#include "exports/target_errors.h"

namespace gapscope::internal::exports {
namespace {

/// On a slide the mass is the inertia.
std::string inertial(const MujocoDrive& d, std::size_t body, bool turns) {
  const bool heavy = body == (d.has_load && !d.locked ? 1u : 0u);
  OffsetMass m = offset_mass(d.inertia[body], heavy ? d.unbalance : 0.0, d.unbalance_phase, d.hangs);
  if (!turns) m.mass = d.inertia[body];
  return fmt::format("<inertial pos=\"{} 0 {}\" mass=\"{}\" diaginertia=\"{} {} {}\"/>", m.x, m.z, m.mass,
                     m.own, m.own, m.own);
}

std::string joint(const std::string& name, const MujocoDrive& d, std::size_t body, bool turns) {
  std::string text = turns ? fmt::format("<joint name=\"{}\" type=\"hinge\" axis=\"0 1 0\" damping=\"{}\"",
                                         name, d.damping[body])
                           : fmt::format("<joint name=\"{}\" type=\"slide\" axis=\"1 0 0\" damping=\"{}\"",
                                         name, d.damping[body]);
  if (d.friction[body] > 0.0) text += "\n             " + dry_friction(fmt::to_string(d.friction[body]));
  return text + "/>";
}

std::string bodies(const ExportSource& s, const MujocoDrive& d) {
  const bool turns = s.coordinates.rotational();
  std::string text = "  <worldbody>\n";
  for (std::size_t body = 0; body < (d.has_load && !d.locked ? 2u : 1u); ++body) {
    const std::string name = s.stem + (body == 0 ? "_motor" : "_load");
    text += fmt::format("    <body name=\"{}\">\n      {}\n      {}\n    </body>\n", name,
                        inertial(d, body, turns), joint(name, d, body, turns));
  }
  return text + "  </worldbody>\n";
}

std::string contact(const ExportSource& s, const MujocoDrive& d) {
  if (!d.has_load) return "";
  std::string text = fmt::format(
      "  <tendon>\n    <fixed name=\"{}_gap\" {}>\n      <joint joint=\"{}_motor\" coef=\"1\"/>\n", s.stem,
      gap_limit(d), s.stem);
  if (!d.locked) text += fmt::format("      <joint joint=\"{}_load\" coef=\"-1\"/>\n", s.stem);
  return text + "    </fixed>\n  </tendon>\n";
}

std::string constant_torques(const ExportSource& s, const MujocoDrive& d) {
  std::string text;
  for (std::size_t body = 0; body < 2; ++body) {
    if (d.constant[body] == 0.0) continue;
    const std::string side = body == 0 ? "motor" : "load";
    text += fmt::format("    <general name=\"{}_constant_{}\" {}/>\n", s.stem, side,
                        constant_torque(s.stem + "_" + side, fmt::to_string(d.constant[body])));
  }
  return text;
}

/// The drive first, unless it has a state: MuJoCo asks for those without one before those with.
std::string actuators(const ExportSource& s, const MujocoDrive& d) {
  const std::string drive =
      fmt::format("    <general name=\"{0}_drive\" joint=\"{0}_motor\" gear=\"{1}\"{2}/>\n", s.stem,
                  d.torque_constant, filter_and_range(d));
  const std::string constant = constant_torques(s, d);
  return "  <actuator>\n" + (d.lag > 0.0 ? constant + drive : drive + constant) + "  </actuator>\n";
}

std::string sensors(const ExportSource& s) {
  return fmt::format("  <sensor>\n    <jointpos name=\"{0}_encoder\" joint=\"{0}_motor\"/>\n  </sensor>\n",
                     s.stem);
}

std::string parts(const ExportSource& s, const MujocoDrive& d) {
  return bodies(s, d) + contact(s, d) + actuators(s, d) + sensors(s);
}

/// As the input's first sample finds it.
std::string start(const ExportSource& s, const MujocoDrive& d) {
  const bool two = d.has_load && !d.locked;
  const auto pair = [&](const double(&v)[2]) {
    return two ? fmt::format("{} {}", v[0], v[1]) : fmt::to_string(v[0]);
  };
  const std::string act = d.lag > 0.0 ? fmt::format(" act=\"{}\"", d.first_input) : "";
  return fmt::format("  <keyframe>\n    <key name=\"{}_start\" qpos=\"{}\" qvel=\"{}\"{}/>\n  </keyframe>\n",
                     s.stem, pair(d.place), pair(d.speed), act);
}

/// The step of a file, and what the head of the file says of it; empty: nothing.
struct ChosenStep {
  double step = kCertifiedStep;  ///< [s]
  std::string note;
};

std::string heading(const ExportSource& s, const MujocoDrive& d, const std::string& what,
                    const ChosenStep& chosen) {
  std::string text = fmt::format(
      "<!-- {0} by gapscope: {1}; certificate.md says what it carries and how exactly.\n"
      "     ctrl of {0}_drive is u (torque {2} per unit of u on the motor), held from step to step; "
      "{0}_encoder is x1.\n",
      s.stem, what, s.coordinates.torque_unit());
  if (d.has_load && d.locked)
    text +=
        "     The tendon is the gap to an output that stands still; solreflimit belongs to this inertia: "
        "more asks\n     for -k/m1.\n";
  else if (d.has_load)
    text +=
        "     The tendon is the gap; solreflimit belongs to these two inertias: more inertia on the load's "
        "body asks\n     for -k (1/m1 + 1/m2).\n";
  else
    text += fmt::format(
        "     One body: hang your link into {}_motor and take its inertia off what is given there.\n",
        s.stem);
  if (d.friction[0] > 0.0 || (d.friction[1] > 0.0 && !d.locked))
    text += "     solreffriction is raised to two steps by MuJoCo, whatever the step is.\n";
  if (d.unbalance > 0.0 && !(d.hangs.mass > 0.0))
    text += "     Of gravity only m g r is known: the mass stands for it at an arm that is assumed.\n";
  if (!chosen.note.empty()) text += "     " + chosen.note + ".\n";
  return text.insert(text.size() - 1, " -->");
}

std::string alone(const ExportSource& s, const MujocoDrive& d, const ChosenStep& chosen) {
  return heading(s, d, "a complete model", chosen) +
         fmt::format(
             "<mujoco model=\"{}\">\n  <option timestep=\"{}\" integrator=\"RK4\" gravity=\"0 0 -{}\" "
             "tolerance=\"1e-15\" iterations=\"100\"/>\n",
             s.stem, chosen.step, d.hangs.gravity) +
         parts(s, d) + start(s, d) + "</mujoco>\n";
}

std::string fragment(const ExportSource& s, const MujocoDrive& d, const ChosenStep& chosen) {
  return heading(s, d, "a fragment, <include file=\"...\"/> in a model of yours", chosen) +
         "<mujocoinclude>\n" + parts(s, d) + "</mujocoinclude>\n";
}

/// Parts whose law has a kink that falls between two steps.
bool has_a_kink(const std::string& part) {
  return part.starts_with("contact_") || part == "shaft_compliance" || part == "impact_damping";
}

/// Exact in its law is not yet exact in an engine of fixed steps.
void judge_parts(const std::vector<TargetError>& errors, Certificate& c) {
  const bool within = std::any_of(errors.begin(), errors.end(), [](const TargetError& e) {
    return e.within_encoder && std::abs(e.step - kCertifiedStep) < 1e-9;
  });
  if (within) return;
  for (CarriedPart& part : c.parts)
    if (part.fidelity == Fidelity::kExact && has_a_kink(part.part)) {
      part.fidelity = Fidelity::kApproximate;
      part.how +=
          fmt::format("; its law is exact, but MuJoCo closes and opens it at its steps, which at {} ms shows",
                      1e3 * kCertifiedStep);
    }
}

struct Integrator {
  const char* name;
  MujocoIntegrator kind;
};
constexpr Integrator kIntegrators[] = {{"Euler", MujocoIntegrator::kEuler},
                                       {"RK4", MujocoIntegrator::kRungeKutta}};

/// What an MJCF does that gives frictionloss and nothing else. Where other things are further off, the creep
/// is no news.
void judge_defaults(const MujocoDrive& d, const TargetErrors& errors, Coordinates coordinates,
                    Certificate& c) {
  constexpr double kWorthSaying = 1.2;  // times the error that is there anyway
  if (d.friction[0] <= 0.0 && (d.friction[1] <= 0.0 || d.locked)) return;
  const auto rms = [&](bool by_default) {
    const auto motion = [&](double step, std::span<const double> u) {
      return mujoco_motion(d, {step, MujocoIntegrator::kRungeKutta, by_default}, u);
    };
    return errors.at(kCertifiedStep, motion).rms;
  };
  c.default_error = rms(true);
  const double held = rms(false);
  if (!(c.default_error > kWorthSaying * held)) return;
  c.warnings.push_back(fmt::format(
      "frictionloss with MuJoCo's default solreffriction and solimpfriction creeps where the drive holds: {} "
      "instead of {} rms at {} ms, and no smaller step helps. Keep both attributes when you copy the joint.",
      coordinates.thousandths(c.default_error), coordinates.thousandths(held), 1e3 * kCertifiedStep));
}

/// One row, of the whole recording: what the file lacks takes it farther off than any step.
void judge_whole(const ExportSource& s, const TargetMotion& motion, Certificate& c) {
  ExportSource whole = s;
  whole.u = s.all_u;
  const TargetErrors errors(whole);
  c.errors = {errors.at(kCertifiedStep, motion)};
  c.errors.front().integrator = "RK4";
  c.travel = errors.travel();
  c.duration = whole.duration();
}

/// 1, 2 or 5 times a power of ten, the largest that is no more.
double rounded_down(double step) {
  const double decade = std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= step * (1.0 + 1e-9)) return digit * decade;
  return decade;
}

/// The largest step within the encoder by the better integrator; where there is none the certified one, or
/// below that what the file stands.
ChosenStep chosen_step(const std::vector<StepLimits>& limits) {
  const auto l =
      std::find_if(limits.begin(), limits.end(), [](const StepLimits& of) { return of.integrator == "RK4"; });
  if (l == limits.end()) return {};
  if (l->within_encoder >= kCertifiedStep) return {l->within_encoder, ""};
  if (l->largest >= kCertifiedStep) return {};
  if (std::isnan(l->largest))
    return {kFinestStep,
            fmt::format("timestep is {} ms, the finest that was tried, at which RK4 is not stable",
                        1e3 * kFinestStep)};
  const double step = rounded_down(l->largest);
  return {
      step,
      fmt::format(
          "timestep is {:.4g} ms: the largest stable step of RK4 is {:.4g} ms, in a model of yours as well",
          1e3 * step, 1e3 * l->largest)};
}

void judge(const ExportSource& s, const MujocoDrive& d, Certificate& c) {
  const TargetErrors errors(s);
  const auto motion_by = [&](MujocoIntegrator kind) {
    return [&d, kind](double step, std::span<const double> u) { return mujoco_motion(d, {step, kind}, u); };
  };
  c.travel = errors.travel();
  const TargetMotion finest = motion_by(MujocoIntegrator::kRungeKutta);
  const TargetError certified = errors.at(kCertifiedStep, finest);
  if (!certified.unstable && hides_the_steps(s, c.parts, certified.rms, c.travel)) {
    judge_defaults(d, errors, s.coordinates, c);
    return judge_whole(s, finest, c);
  }
  for (const Integrator& integrator : kIntegrators)
    c.limits.push_back(errors.scan(integrator.name, motion_by(integrator.kind), c.errors));
  if (!errors.steps_fall_on_rows())
    c.warnings.push_back(
        fmt::format("no step of the table divides the {:.6g} ms between two rows of the input, or is a whole "
                    "multiple of them: a part of each error is an input that comes late by up to a step",
                    1e3 * s.dt));
  judge_parts(c.errors, c);
  judge_defaults(d, errors, s.coordinates, c);
}

}  // namespace

DriveExport export_mjcf(const ExportSource& s) {
  const MujocoDrive d = mujoco_drive(s);
  DriveExport out;
  Certificate& c = out.certificate;
  c.format = "mjcf";
  c.own_file = own_file(s, d);
  c.parts = mujoco_parts(s);
  judge(s, d, c);
  const ChosenStep chosen = chosen_step(c.limits);
  if (!chosen.note.empty()) c.warnings.push_back(chosen.note);
  add_loop_lines(s, {"qpos", "qvel", "ctrl", 1.0, "qfrc_applied", chosen.step}, c);
  out.files = {{s.stem + ".xml", alone(s, d, chosen)}, {s.stem + "_fragment.xml", fragment(s, d, chosen)}};
  return out;
}

}  // namespace gapscope::internal::exports
