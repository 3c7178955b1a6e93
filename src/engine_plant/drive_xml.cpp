#include "engine_plant/drive_xml.h"

#include <fmt/format.h>

#include <cmath>

#include "base/require.h"

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

}  // namespace

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

}  // namespace gapscope::engine_plant
