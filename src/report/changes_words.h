#pragma once

#include <string>
#include <vector>

#include "results/drive_changes.h"

/// What a comparison says, in words of its codes and numbers.
namespace gapscope::internal::report {

/// Of a quantity of this comparison as it is shown: "mrad" comes of "rad" later.
std::string changes_unit(const DriveChanges& all, const DriveQuantity& q);

/// "lost motion at ±3.95 N·m, model-free"
std::string quantity_name(const DriveChanges& all, const DriveQuantity& q);

/// "2.89 ± 0.31 mrad", "at most 35.1 mrad", or why there is none.
std::string observed_text(const Observation& o, const std::string& unit);

/// "-30.8 ± 1.5 mrad, changed"
std::string change_text(const Change& c, const std::string& unit);

/// The last parts of the folders' names where these tell them apart, else the whole.
std::vector<std::string> short_names(const std::vector<std::string>& folders);

/// What has changed most, from the first report to the last, with both values, the difference and its
/// interval; or that nothing has been seen to.
std::string changes_headline(const DriveChanges& all);

/// Which numbers of the fit differ, from the first report to the last; empty where nobody can tell.
std::string which_text(const DriveChanges& all);

/// The course of each quantity in time, or the units unlike the others, but for the one that heads the text:
/// a line each; empty of few reports.
std::vector<std::string> order_lines(const DriveChanges& all);

/// How many rows changed, are the same, are open, and at which error rate.
std::string changes_count(const DriveChanges& all);

}  // namespace gapscope::internal::report
