#pragma once

#include <cmath>

namespace gapscope::internal::exports {

constexpr double kGravity = 9.81;  // m/s², along −z in every exported model

/// A body on the axis y through its origin.
struct OffsetMass {
  double mass = 1.0;        ///< [kg]
  double x = 0.0, z = 0.0;  ///< of its centre [m]
  double own = 0.0;         ///< inertia about the centre [kg m²]
};

/// A mass that is known to hang on an arm.
struct KnownMass {
  double mass = 0.0;  ///< [kg]; 0: nothing is known
  double arm = 0.0;   ///< [m]
  double gravity = kGravity;

  double torque() const { return mass * gravity * arm; }
};

/// How far the torque of a known mass may be off that of the drive: a torque that was fitted is another one.
constexpr double kSameTorque = 1e-6;

/// That of this inertia about the axis on which gravity has the torque −G sin(q + phase): the mass that is
/// known, on its arm, else one beside the axis that makes up a tenth of the inertia.
inline OffsetMass offset_mass(double inertia, double unbalance, double phase, const KnownMass& known = {}) {
  OffsetMass body;
  body.own = inertia;
  if (unbalance <= 0.0) return body;
  double radius = known.arm;
  body.mass = known.mass;
  const bool is_it = std::abs(known.torque() - unbalance) <= kSameTorque * unbalance &&
                     inertia >= known.mass * known.arm * known.arm;
  if (!is_it) {
    body.mass = 10.0 * unbalance * unbalance / (kGravity * kGravity * inertia);
    radius = unbalance / (body.mass * kGravity);
  }
  body.x = -radius * std::sin(phase), body.z = -radius * std::cos(phase);
  body.own = inertia - body.mass * radius * radius;
  return body;
}

}  // namespace gapscope::internal::exports
