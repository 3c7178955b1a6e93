#pragma once

#include <string>
#include <string_view>

namespace gapscope {

/// What a message shows of a text from a file: its first characters, control characters as '?'.
std::string printable(std::string_view text, std::size_t most);

/// The same in quotes.
std::string shown(std::string_view text, std::size_t most = 40);

/// Whether bytes are text: UTF-8, and no control characters but line ends and tabs.
bool is_text(std::string_view bytes);

}  // namespace gapscope
