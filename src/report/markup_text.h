#pragma once

#include <string>

namespace gapscope::internal::report {

/// Text as HTML and XML have it; control characters, which XML 1.0 cannot hold, are left out.
std::string markup_text(const std::string& text);

}  // namespace gapscope::internal::report
