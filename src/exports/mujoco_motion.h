#pragma once

#include <span>
#include <vector>

#include "exports/offset_mass.h"

namespace gapscope::internal::exports {

/// What an exported MJCF says of a drive: one or two bodies, each on a joint of its own.
struct MujocoDrive {
  bool has_load = true;
  bool locked = false;           ///< the output does not move: it stands at load_place
  double inertia[2] = {};        ///< of motor and load [kg m²]
  double damping[2] = {};        ///< [N m s/rad]
  double friction[2] = {};       ///< frictionloss [N m]
  double constant[2] = {};       ///< a constant torque [N m]
  double torque_constant = 0.0;  ///< [N m per unit of u]
  double lag = 0.0;              ///< time constant of the actuator [s]; 0: none
  double input_limit = 0.0;      ///< of u [unit of u]; 0: none
  double first_input = 0.0;      ///< that held before the start [unit of u]
  double half_gap = 0.0;         ///< β [rad]
  double stiffness = 0.0;        ///< of the contact [N m/rad]
  double contact_damping = 0.0;  ///< [N m s/rad]
  double load_place = 0.0;       ///< x2 of a locked output [rad]
  double unbalance = 0.0;  ///< amplitude of gravity's torque on the load, without one on the motor [N m]
  double unbalance_phase = 0.0;         ///< −G sin(x + phase) [rad]
  KnownMass hangs = {};                 ///< what is known to make it
  double place[2] = {}, speed[2] = {};  ///< at the start [rad, rad/s]

  /// 1/m1 + 1/m2, of a locked output 1/m1: what a torque of the contact does to x1 − x2 [1/(kg m²)]
  double contact_mobility() const;
};

enum class MujocoIntegrator { kEuler, kRungeKutta };

/// How MuJoCo would go through time.
struct MujocoStepping {
  double step = 1e-3;  ///< [s]
  MujocoIntegrator integrator = MujocoIntegrator::kEuler;
  bool default_friction = false;  ///< solreffriction and solimpfriction as an MJCF has them that does not say
};

// The parameters of the soft constraints that the exported MJCF gives.
inline constexpr double kSoftest = 1e-4;    ///< impedance of the contact: the least that MuJoCo takes
inline constexpr double kHardest = 0.9999;  ///< of dry friction: the most that it takes
/// Time constant of dry friction [s]; MuJoCo raises it to two steps.
inline constexpr double kShortest = 1e-6;

/// x1 at every step of the engine, the first one at t = 0, as MuJoCo's own steps make it:
///   * acceleration of the smooth torques a⁰ = (τ − d v)/m, then the soft constraints (dry friction of either
///     joint, the limit of the tendon x1 − x2), which are the minimum over a of
///       Σ ½ m (a − a⁰)² + Σ s(J a − a*),   a* = −b J v − k i r,   R = (1 − i)/i · J M⁻¹ Jᵀ
///     with i the impedance and r the distance: friction is linear within its level and constant beyond, a
///     limit only pushes (MuJoCo documentation, "Computation", "Modeling: solver parameters"),
///   * semi-implicit Euler, the joint damping implicit, or the classical Runge–Kutta method of order 4.
/// @param u  held over each step [unit of u]
/// @returns fewer than u.size() + 1 values where the motion leaves what the engine takes (1e10)
std::vector<double> mujoco_motion(const MujocoDrive& drive, const MujocoStepping& stepping,
                                  std::span<const double> u);

}  // namespace gapscope::internal::exports
