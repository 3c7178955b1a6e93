#pragma once

#include <string>

namespace gapscope::internal::inspection {

/// What a column may be of a recording.
enum class ColumnRole { kTime, kInput, kPosition, kSpeed, kTarget };

/// How well the name of a column says a role: 0 not at all, else the more the better.
int likeness(const std::string& name, ColumnRole role);

/// Words and numbers that two names have both: "pos (1)" and "load (1)" one.
int shared_words(const std::string& a, const std::string& b);

}  // namespace gapscope::internal::inspection
