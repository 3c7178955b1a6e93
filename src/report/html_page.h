#pragma once

#include <string>
#include <vector>

#include "report/html_text.h"

namespace gapscope::internal::report {

/// The text of report.md as one page that needs no other file and no network: light or dark as the reader has
/// it, printable, tables that sort at a click on a heading.
std::string html_page(const std::string& title, const std::string& markdown,
                      const std::vector<Picture>& pictures);

}  // namespace gapscope::internal::report
