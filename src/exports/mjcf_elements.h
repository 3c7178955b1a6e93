#pragma once

#include <string>

#include "exports/mujoco_drive.h"

/// Attributes that the exported file has, and that are told for a file of the user's own.
namespace gapscope::internal::exports {

/// Friction of a joint with what makes it hold.
std::string dry_friction(const std::string& level);

/// The gap: limit and softness of the tendon motor − load, a spring and a damper that only push.
std::string gap_limit(const MujocoDrive& drive);

/// What the actuator has beside its gear: filter and range; empty, or each with a blank before it.
std::string filter_and_range(const MujocoDrive& drive);

/// Of an actuator that has always the same torque on a joint.
std::string constant_torque(const std::string& joint, const std::string& torque);

}  // namespace gapscope::internal::exports
