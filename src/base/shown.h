#pragma once

#include <string>
#include <string_view>

namespace gapscope {

/// What a message shows of a text from a file or of its name: the first characters. What is no UTF-8, and
/// what is not seen but obeyed (control characters, marks of direction), is '?'.
/// @param most  of the text that is shown [byte]
std::string printable(std::string_view text, std::size_t most = std::string_view::npos);

/// The same in quotes.
std::string shown(std::string_view text, std::size_t most = 40);

/// Whether bytes are text: UTF-8, all of it printable but for line ends and tabs.
bool is_text(std::string_view bytes);

}  // namespace gapscope
