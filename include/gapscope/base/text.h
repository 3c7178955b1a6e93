#pragma once

#include <span>
#include <string>

namespace gapscope {

/// `text` with every `from` in it replaced by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// An identifier for people: "cogging_torque" reads "cogging torque".
std::string readable(const std::string& identifier);

bool contains(std::span<const std::string> names, const std::string& name);

}  // namespace gapscope
