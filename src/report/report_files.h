#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "report/figure_formats.h"
#include "report/html_page.h"

namespace gapscope::internal::report {

/// A figure as the bytes of a PNG.
/// @param tight  as few as there may be
std::string picture_bytes(const FigureData& figure, bool tight = false);

/// The same at half the size, for a page that shows it among its text.
std::string small_picture(FigureData figure);

/// Draws the figures into a folder, each as its PNG and what else is asked for, side by side on all cores,
/// and writes report.md and report.html beside them; removes those of an earlier result that are missing now.
/// @throws std::runtime_error naming what cannot be written.
void write_report_files(const std::string& folder, const std::vector<FigureData>& figures,
                        const std::string& text, const FigureFormats& formats, const PageHead& head);

}  // namespace gapscope::internal::report
