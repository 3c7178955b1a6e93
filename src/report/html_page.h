#pragma once

#include <string>
#include <vector>

#include "report/html_text.h"

namespace gapscope::internal::report {

/// A word on how far an answer goes, in the colour that its kind has.
struct Badge {
  const char* kind;  ///< "good", "limited", "bad" or "open"
  std::string text;
};

/// What a page begins with, beside its text.
struct PageHead {
  std::string title;
  std::string about = "";          ///< what it is of: files, length, version
  std::vector<Badge> badges = {};  ///< below the title
  std::string carrying = "";       ///< file of the picture that carries the answer
};

/// The text of report.md as one page that needs no other file and no network: light or dark as the reader has
/// it, printable, tables that sort at a click on a heading, one cursor over all panels that share an axis.
std::string html_page(const PageHead& head, const std::string& markdown,
                      const std::vector<Picture>& pictures);

}  // namespace gapscope::internal::report
