#pragma once

#include <string>
#include <vector>

namespace gapscope::internal::report {

/// A picture of a report: its file name in the text, and the same as an SVG element of a page.
struct Picture {
  std::string file;
  std::string svg;
};

/// A line of a report as HTML: **bold**, *words*, `code` and links; everything else stands as it is.
std::string html_line(const std::string& line);

/// The text of report.md (the part of Markdown that reports are written in) as the body of a page: the title
/// and what stands before the first section in full, the sections folded but for the first ones, tables with
/// headings that sort, pictures within the page.
/// @param head      stands below the title
/// @param carrying  file of the picture that carries the answer: it stands before the first section; empty:
/// none
std::string html_body(const std::string& markdown, const std::vector<Picture>& pictures,
                      const std::string& head = "", const std::string& carrying = "");

}  // namespace gapscope::internal::report
