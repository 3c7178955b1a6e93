#pragma once

#include <string>

namespace gapscope::internal::report {

/// "## Words": what the words of a report mean, those that occur in it; empty where none does.
std::string glossary_section(const std::string& text);

}  // namespace gapscope::internal::report
