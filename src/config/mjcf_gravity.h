#pragma once

#include "config/mjcf.h"

namespace gapscope::internal::config {

/// Gravity's torque on all that turns with a hinge, about its axis a through p: with the mass m at c, r = c −
/// p and q the angle from the file's own pose,
///   m (a·(r × g) cos q − (r·g − (r·a)(a·g)) sin q) = −G sin(q + phase).
/// Bodies without a joint of their own count, as they are turned. g is that in the joint's body, which joints
/// above it leave as it is only where they slide or turn about the vertical. Of a slide its weight along it.
/// What cannot be computed is noted as "not taken: gravity, ...".
void read_gravity(const Mjcf& mjcf, const tinyxml2::XMLElement& joint, JointNumbers& numbers);

}  // namespace gapscope::internal::config
