#pragma once

#include <functional>
#include <optional>
#include <string>

namespace gapscope {

/// Does work in a process of its own (a copy of this one), for libraries that a damaged file can end.
/// @returns what it returned; nothing if it threw, or the work ended the process, or took a minute of
/// processor time
/// @throws std::bad_alloc if memory was short, MachineError if there can be no further process or somebody
/// killed it
std::optional<std::string> run_apart(const std::function<std::string()>& work);

}  // namespace gapscope
