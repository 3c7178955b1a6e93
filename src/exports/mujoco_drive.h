#pragma once

#include <vector>

#include "exports/carried.h"
#include "exports/mujoco_motion.h"

namespace gapscope::internal::exports {

/// The drive as far as MJCF of MuJoCo 2.2.2 can say it.
MujocoDrive mujoco_drive(const ExportSource& source);

/// What of it that is, with the elements that say it.
std::vector<CarriedPart> mujoco_parts(const ExportSource& source);

}  // namespace gapscope::internal::exports
