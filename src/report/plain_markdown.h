#pragma once

#include <string>

namespace gapscope::internal::report {

/// A report as it is stored: names and sentences of others in it are text, whatever signs they have. A `<`
/// that would begin HTML and a `![` that would fetch a picture are written as signs; the report's own
/// pictures and what is code stay.
std::string plain_markdown(const std::string& text);

}  // namespace gapscope::internal::report
