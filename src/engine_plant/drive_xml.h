#pragma once

#include <string>

#include "independent_plant/drive.h"

namespace gapscope::engine_plant {

/// The drive as MJCF, in which all of its truth stands but the delay: two bodies, a tendon's limit as the
/// contact, dry friction that holds, a mass beside the axis under gravity, a filter as the actuator's lag.
/// @param step  of the engine [s]
/// @throws std::logic_error for an effect that MJCF has no element for, or another load or contact
std::string drive_xml(const independent_plant::BlindDrive& drive, double step);

}  // namespace gapscope::engine_plant
