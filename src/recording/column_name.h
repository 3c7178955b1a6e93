#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gapscope/recording/units.h"

namespace gapscope {

/// The words of "Motor_tempCoil2": "motor", "temp", "coil".
std::vector<std::string> words_of_name(std::string_view name);

/// Whether the name of a column, or a unit in it, is that of a temperature: "motor_temp", "coil [°C]". No
/// drive is moved by one.
bool says_temperature(std::string_view column);

/// In place of a unit: one step of the encoder.
inline constexpr const char* kCounts = "counts";

/// The unit of a quantity that ends the name of a column, as it is declared: "ms" of "time_ms", "deg" of
/// "Angle [deg]" and "pos_degrees", "counts" of "enc [inc]". Empty where there is none. A single letter is
/// one in brackets or of what the name says it measures, as of current_A: torque_A may be that of an axis A.
std::string unit_in_name(std::string_view column, Quantity quantity);

/// What ends the name of a column as a unit and is none of this quantity: a speed's ("rpm" of "speed_rpm"
/// where a position is asked for), or whatever stands in square brackets. Empty where nothing does.
std::string unit_of_another(std::string_view column, Quantity quantity);

/// What is to be named as the input in its place, for messages.
inline constexpr const char* kInputsOfDrives =
    "the column of a torque, a force, a current, a voltage or a duty (one that is called so by mistake: rename it)";

}  // namespace gapscope
