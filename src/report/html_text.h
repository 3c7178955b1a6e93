#pragma once

#include <string>
#include <vector>

namespace gapscope::internal::report {

/// A picture of a report: its file name in the text, and the bytes of its PNG.
struct Picture {
  std::string file;
  std::string png;
  double columns = 1.0;  ///< of a journal that it fills: below that its letters are too small to read
};

/// The bytes in base64.
std::string base64(const std::string& bytes);

/// A line of a report as HTML: **bold**, *words*, `code` and links; everything else stands as it is.
std::string html_line(const std::string& line);

/// The text of report.md (the part of Markdown that reports are written in) as the body of a page: the title
/// and what stands before the first section in full, the sections folded but for the first ones, tables with
/// headings that sort, pictures within the page.
std::string html_body(const std::string& markdown, const std::vector<Picture>& pictures);

}  // namespace gapscope::internal::report
