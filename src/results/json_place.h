#pragma once

#include <string>
#include <string_view>

namespace gapscope::internal::results {

/// The line, from 1, on which a value stands in a valid JSON text: place is "model_free.events[3].t1_s", ""
/// for the whole. Of a place that is not there, the line of the nearest one around it that is.
int line_of_place(std::string_view text, std::string place);

/// The line of a byte of a text.
int line_of_byte(std::string_view text, std::size_t byte);

/// The bracket or brace of a JSON text that opens the given level, the outermost being 1; npos if none does.
std::size_t byte_of_level(std::string_view text, std::size_t level);

}  // namespace gapscope::internal::results
