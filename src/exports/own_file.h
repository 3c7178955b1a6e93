#pragma once

#include <string>

#include "exports/mujoco_drive.h"

namespace gapscope::internal::exports {

/// What to change in a model that has these joints already: the attributes of joints, actuator and tendon,
/// and where the file is known the body's centre of mass for the gravity that was found:
///   the centre's lever across the axis, r = G/(m g) (cos φ e1 + sin φ e2), φ = phase + ref, e1 along gravity
///   and e2 = axis × e1, has −G sin(q + phase) about the axis;
/// what the body's inertia about the axis gains by it comes off the armature.
std::string own_file(const ExportSource& source, const MujocoDrive& drive);

}  // namespace gapscope::internal::exports
