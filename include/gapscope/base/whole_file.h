#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace gapscope {

/// Writes a file aside and gives it its name when it is complete, so that nobody ever finds a part of it, and
/// what was there before stays until then. A pipe or a device is written as it is.
/// @throws std::runtime_error where it cannot be written; nothing is left of it
void write_whole_file(const std::string& path, const std::function<void(std::ostream&)>& write);

}  // namespace gapscope
