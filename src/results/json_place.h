#pragma once

#include <string>
#include <string_view>

namespace gapscope::internal {

/// The line, from 1, on which a value stands in a valid JSON text: place is "model_free.events[3].t1_s", ""
/// for the whole. Of a place that is not there, the line of the nearest one around it that is.
int line_of_place(std::string_view text, std::string place);

/// The line of a byte of a text.
int line_of_byte(std::string_view text, std::size_t byte);

}  // namespace gapscope::internal
