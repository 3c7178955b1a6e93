#pragma once

#include <functional>

#include "recording/array_file.h"
#include "recording/mat_element.h"

namespace gapscope::internal::recording {

/// The flaw of an array that is a struct.
inline constexpr const char* kIsStruct = "is a struct";

constexpr std::uint32_t kMatrix = 14;  ///< type of an element that is an array

/// What an element of a file of version 5 says of the array that it is: class, size and name; its numbers
/// follow.
/// @param tagged  its own tag stands before it, as where it was deflated
StoredArray read_head(MatElement& element, bool tagged);

/// Goes through the arrays within a struct of which the head was read, in the order of the file, those of
/// structs within it, too. They are named as MATLAB names them: "rec.signals(2).values".
/// @param visit  returns whether this one is looked for; its numbers then follow
/// @returns whether it was found
/// @throws DamagedVariable
bool walk_struct(MatElement& element, const StoredArray& head,
                 const std::function<bool(const StoredArray&)>& visit);

}  // namespace gapscope::internal::recording
