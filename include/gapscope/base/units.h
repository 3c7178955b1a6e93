#pragma once

#include <string>

namespace gapscope {

/// `text` with every `from` in it replaced by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// A unit of a rotational drive ("N m s/rad") as it is on the axis at hand: in metres for a translational one
/// ("N s/m").
std::string axis_unit(const std::string& unit, bool rotation);

/// A unit as axis_unit() tells it, typeset: "N·m", "kg m²"; nothing for "-".
std::string shown_unit(const std::string& unit, bool rotation);

}  // namespace gapscope
