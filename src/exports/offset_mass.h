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

/// That of this inertia about the axis on which gravity has the torque −G sin(q + phase): a mass beside the
/// axis that makes up a tenth of the inertia.
inline OffsetMass offset_mass(double inertia, double unbalance, double phase) {
  OffsetMass body;
  body.own = inertia;
  if (unbalance <= 0.0) return body;
  body.mass = 10.0 * unbalance * unbalance / (kGravity * kGravity * inertia);
  const double radius = unbalance / (body.mass * kGravity);
  body.x = -radius * std::sin(phase), body.z = -radius * std::cos(phase);
  body.own = inertia - body.mass * radius * radius;
  return body;
}

}  // namespace gapscope::internal::exports
