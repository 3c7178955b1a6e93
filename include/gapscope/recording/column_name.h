#pragma once

#include <string_view>

namespace gapscope {

/// Whether the name of a column, or a unit in it, is that of a temperature: "motor_temp", "coil [°C]". No
/// drive is moved by one.
bool says_temperature(std::string_view column);

/// What is to be named as the input in its place, for messages.
inline constexpr const char* kInputsOfDrives =
    "the column of a torque, a force, a current, a voltage or a duty (one that is called so by mistake: "
    "rename it)";

}  // namespace gapscope
