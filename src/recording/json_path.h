#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "recording/json_cursor.h"

namespace gapscope::internal::recording {

/// Keys of objects, and places in lists from 0 on: "data[0].actions" has three.
using JsonPath = std::vector<std::variant<std::string, std::size_t>>;

JsonPath json_path(const std::string& name);

/// Goes over what is next in a text, and calls `take` where the path ends, which has to go over what is
/// there.
/// @throws DamagedBytes
void at_path(JsonCursor& json, const JsonPath& path, const std::function<void()>& take);

/// Adds the paths of the lists of numbers below a path, of the first element where a list has objects.
/// @param depth  of the path
void add_lists(JsonCursor& json, const std::string& path, int depth, std::vector<std::string>& to);

}  // namespace gapscope::internal::recording
