#pragma once

#include <functional>
#include <optional>
#include <string>

namespace gapscope {

/// Does work in a process of its own (a copy of this one), for libraries that a damaged file can end.
/// @returns what it returned; nothing if it threw, or the process was ended, or took a minute of processor
/// time
/// @throws std::bad_alloc if memory was short, std::runtime_error if there can be no further process.
std::optional<std::string> run_apart(const std::function<std::string()>& work);

}  // namespace gapscope
