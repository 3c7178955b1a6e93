#include "engine_plant/mujoco_plant.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include "base/random.h"
#include "base/require.h"
#include "independent_plant/drive.h"

namespace gapscope::engine_plant {
namespace {

using independent_plant::BlindDrive;

constexpr double kEarth = 9.81;   // m/s²
constexpr double kBeside = 0.2;   // of the inertia: that of the mass beside the axis about it
constexpr double kPliant = 1e-4;  // least impedance of a constraint that MuJoCo takes: a spring and a damper
constexpr double kUnyielding = 0.9999;  // the largest

/// @param torque  of gravity at its largest [N m], and the angle beside which that is zero
std::string inertial(double inertia, double torque, double phase) {
  double mass = 1.0, radius = 0.0;
  if (torque > 0.0) {
    mass = torque * torque / (kBeside * inertia * kEarth * kEarth);
    radius = torque / (mass * kEarth);
  }
  const double own = inertia - (torque > 0.0 ? kBeside * inertia : 0.0);
  return fmt::format("<inertial pos='{} 0 {}' mass='{}' diaginertia='{} {} {}'/>", -radius * std::sin(phase),
                     -radius * std::cos(phase), mass, own, own, own);
}

std::string body(const std::string& name, const std::string& inertia, double damping, double friction,
                 double step) {
  return fmt::format(
      "<body name='{0}'>{1}<joint name='{0}' type='hinge' axis='0 1 0' damping='{2}' frictionloss='{3}' "
      "solreffriction='{4} 1' solimpfriction='{5} {5} .001'/></body>\n",
      name, inertia, damping, friction, 2.0 * step, kUnyielding);
}

double or_else(double value, double nominal) { return std::isnan(value) ? nominal : value; }

std::string contact(const BlindDrive& d) {
  const auto& e = d.effects.contact;
  const double mobility = 1.0 / d.motor_inertia + 1.0 / d.load_inertia;
  return fmt::format(
      "<tendon><fixed limited='true' range='{} {}' solreflimit='{} {}' solimplimit='{} {} .0001'>"
      "<joint joint='motor' coef='1'/><joint joint='load' coef='-1'/></fixed></tendon>\n",
      -0.5 * d.gap, 0.5 * d.gap, -mobility * or_else(e.stiffness_nm_rad, d.contact_stiffness),
      -mobility * or_else(e.damping_nms_rad, d.contact_damping), kPliant, kPliant);
}

/// MuJoCo asks for those without a state first.
std::string actuators(const BlindDrive& d) {
  const double lag = d.effects.command.lag_s;
  return fmt::format(
      "<actuator><general joint='load' gainprm='0' biastype='affine' biasprm='{} 0 0'/>"
      "<general name='drive' joint='motor' gear='{}'{}/></actuator>\n",
      d.effects.load.constant_torque_nm, d.torque_constant,
      lag > 0.0 ? fmt::format(" dyntype='filter' dynprm='{}'", lag) : std::string());
}

/// The drive as MJCF, in which all of its truth stands but the delay: two bodies, a tendon's limit as the
/// contact, dry friction that holds, a mass beside the axis under gravity, a filter as the actuator's lag.
/// @param step  of the engine [s]
/// @throws std::logic_error for an effect that MJCF has no element for, or another load or contact
std::string drive_xml(const BlindDrive& d, double step) {
  GAPSCOPE_REQUIRE(d.load == independent_plant::BlindLoad::kFree);
  GAPSCOPE_REQUIRE(d.contact == independent_plant::ContactKind::kCompliant);
  const auto& load = d.effects.load;
  GAPSCOPE_REQUIRE(load.unbalance_periods == 1.0);
  return fmt::format(
             "<mujoco><option timestep='{}' integrator='RK4' gravity='0 0 -{}' tolerance='1e-15' "
             "iterations='100'/>\n<worldbody>\n",
             step, kEarth) +
         body("motor", inertial(d.motor_inertia, 0.0, 0.0), d.motor_damping,
              d.effects.motor.friction.level_nm, step) +
         body("load", inertial(d.load_inertia, load.unbalance_nm, load.unbalance_phase_rad), d.load_damping,
              d.load_coulomb, step) +
         "</worldbody>\n" + contact(d) + actuators(d) +
         fmt::format("<keyframe><key qpos='{} {}' qvel='{} {}'/></keyframe></mujoco>\n", d.x1, d.x2, d.w1,
                     d.w2);
}

using independent_plant::BlindCase;

constexpr double kLongestStep = 1.25e-5;  // s: at four times as long contacts leave four floors of 20 bit

struct Delete {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, Delete>;

mjModel* parsed(const std::string& xml, char* problem, int size) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* kFile = "drive.xml";
#if mjVERSION_HEADER >= 300
  mj_addBufferVFS(files.get(), kFile, xml.data(), static_cast<int>(xml.size()));
#else
  const int place = mj_makeEmptyFileVFS(files.get(), kFile, static_cast<int>(xml.size()));
  if (place < 0) throw std::logic_error("MuJoCo takes no file");
  std::memcpy(files->filedata[place], xml.data(), xml.size());
#endif
  mjModel* model = mj_loadXML(kFile, files.get(), problem, size);
  mj_deleteVFS(files.get());
  return model;
}

/// The parser keeps what it read last: one at a time.
Model model_of(const std::string& xml) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  mju_user_warning = [](const char*) {};  // which would go to a file in the working folder
  char problem[1000] = "";
  Model model(parsed(xml, problem, sizeof problem));
  if (!model) throw std::logic_error(problem);
  return model;
}

/// The command as it acts: late, and over a step in which it changes its mean.
class LateCommand {
 public:
  LateCommand(const std::vector<double>& u, double dt, double delay) : u_(u), dt_(dt), delay_(delay) {}
  double mean(double from, double to) const {
    const double change = dt_ * std::ceil((from - delay_) / dt_ - 1e-9) + delay_;  // the first one from there
    if (change <= from || change >= to) return at(0.5 * (from + to));
    return (at(0.5 * (from + change)) * (change - from) + at(0.5 * (change + to)) * (to - change)) /
           (to - from);
  }

 private:
  double at(double t) const {
    const double sample = std::floor((t - delay_) / dt_);
    return sample < 0.0 ? 0.0 : u_[std::min(static_cast<std::size_t>(sample), u_.size() - 1)];
  }
  const std::vector<double>& u_;
  double dt_, delay_;
};

/// x1 at the samples, as it truly is.
std::vector<double> motion(const BlindCase& c, const std::vector<double>& u) {
  const double dt = 1.0 / c.options.rate, fewest = dt / kLongestStep;
  const int inner = static_cast<int>(std::ceil(fewest - 1e-9));
  const double step = dt / inner;
  const Model model = model_of(drive_xml(c.drive, step));
  const std::unique_ptr<mjData, Delete> data(mj_makeData(model.get()));
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  const int drive = mj_name2id(model.get(), mjOBJ_ACTUATOR, "drive");
  const LateCommand command(u, dt, c.drive.effects.command.delay_s);
  std::vector<double> x1;
  for (std::size_t i = 0; i < u.size(); ++i) {
    x1.push_back(data->qpos[0]);
    for (int k = 0; k < inner; ++k) {
      const double t = dt * static_cast<double>(i) + step * k;
      data->ctrl[drive] = command.mean(t, t + step);
      mj_step(model.get(), data.get());
    }
  }
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
    if (data->warning[warning].number > 0) throw std::logic_error("MuJoCo's motion diverges");
  return x1;
}

/// What no XML of MuJoCo 2.2 says would silently be left out.
void require_said(const independent_plant::Effects& e) {
  const auto& f = e.motor.friction;
  const bool motor = f.stiction_ratio != 0.0 || f.coulomb_ratio != 0.0 || f.gear_ratio != 0.0 ||
                     e.motor.bristle.level_nm != 0.0 || e.motor.drag_nms2 != 0.0 ||
                     e.motor.cogging.amplitude != 0.0;
  const bool command = e.command.ripple.amplitude != 0.0 || e.command.dead_zone != 0.0 ||
                       std::isfinite(e.command.saturation_knee);
  if (motor || command) throw std::logic_error("MuJoCo has no element for an effect of this drive");
}

}  // namespace

void require_mujoco() {}

Recording mujoco_recording(const BlindCase& c) {
  require_said(c.drive.effects);
  Recording r;
  r.file = "mujoco", r.dt = 1.0 / c.options.rate, r.quantum = c.sensor.quantum;
  r.u = independent_plant::command(c.excitation, c.options.rate, c.options.duration, c.options.seed);
  r.x1 = motion(c, r.u);
  std::mt19937_64 noise = random_stream(c.options.seed, "encoder of an engine");
  for (double& x : r.x1) {
    if (c.sensor.noise > 0.0) x += c.sensor.noise * normal(noise);
    if (r.quantum > 0.0) x = r.quantum * std::nearbyint(x / r.quantum);
  }
  return r;
}

}  // namespace gapscope::engine_plant
