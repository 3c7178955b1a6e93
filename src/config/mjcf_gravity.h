#pragma once

#include "config/mjcf.h"

namespace gapscope::internal::config {

/// Gravity's torque on all that turns with a hinge, about its axis a through p: with the mass m at c, r = c −
/// p and q the angle from the file's own pose,
///   m (a·(r × g) cos q − (r·g − (r·a)(a·g)) sin q) = −G sin(q + phase).
/// Bodies without a joint of their own count. What cannot be computed is noted as "not taken: gravity, ...".
void read_gravity(const Mjcf& mjcf, const tinyxml2::XMLElement& joint, JointNumbers& numbers);

}  // namespace gapscope::internal::config
