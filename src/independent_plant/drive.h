#pragma once

#include "independent_plant/effects.h"

namespace gapscope::independent_plant {

enum class BlindLoad {
  kFree,
  kLocked,  ///< the output does not move: x2 stays where it starts
  kNone,    ///< one inertia (motor_inertia, motor_damping); load effects act on it
};

enum class ContactKind {
  kCompliant,  ///< spring and damper behind the gap, never pulling
  kRigid,      ///< impact law with restitution
  kBonded,     ///< spring and damper without a gap, pulling and pushing
};

/// The drive of the source paper with its example's numbers; stiffness and damping of the contact are not
/// given there. Effects come on top.
///   motor    m1·ẇ1 = Km·u − d1·w1 − τc
///   load     m2·ẇ2 = τc − d2·w2 − Fc2·sign(w2), sign set-valued at zero
///   contact  τc = ±max(0, k·p ± c·(w1 − w2)) while p = ±(x1 − x2) − β > 0
struct BlindDrive {
  BlindLoad load = BlindLoad::kFree;
  ContactKind contact = ContactKind::kCompliant;
  double motor_inertia = 8.78e-4;    ///< m1 [kg·m²]
  double torque_constant = 0.172;    ///< Km [N·m per unit of u]
  double motor_damping = 0.062;      ///< d1 [N·m·s/rad]
  double load_inertia = 8.78e-4;     ///< m2 [kg·m²]
  double load_damping = 0.035;       ///< d2 [N·m·s/rad]
  double load_coulomb = 0.05;        ///< Fc2 [N·m]
  double gap = 18.8e-3;              ///< 2β [rad]
  double contact_stiffness = 200.0;  ///< k [N·m/rad]
  double contact_damping = 0.05;     ///< c [N·m·s/rad]
  double restitution = 1.0;          ///< rigid contact only; 1 is eq. (3)
  double x1 = 0.0, w1 = 0.0;         ///< initial state [rad, rad/s]
  double x2 = 0.0, w2 = 0.0;
  Effects effects;
};

}  // namespace gapscope::independent_plant
