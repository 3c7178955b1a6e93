#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gapscope::internal::recording {

/// What a column may be of a recording.
enum class ColumnRole { kTime, kInput, kPosition, kSpeed, kTarget };

/// The words of "Motor_tempCoil2": "motor", "temp", "coil".
std::vector<std::string> words_of(std::string_view name);

/// How well the name of a column says a role: 0 not at all, else the more the better.
int likeness(const std::string& name, ColumnRole role);

/// Words and numbers that two names have both: "pos (1)" and "load (1)" one.
int shared_words(const std::string& a, const std::string& b);

}  // namespace gapscope::internal::recording
