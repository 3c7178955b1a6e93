#pragma once

#include <string>
#include <string_view>

namespace gapscope {

/// Whether a text can be the name of a file or folder everywhere: 1 to 100 of letters, digits, _, - and .,
/// and neither - nor . first.
bool is_plain_name(std::string_view name);

/// A text as a part of such a name: every other character is '_'.
std::string plain_part(std::string text);

}  // namespace gapscope
