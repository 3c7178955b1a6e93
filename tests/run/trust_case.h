#pragma once

#include <string>

#include "drives/family.h"

namespace gapscope::test {

/// The configuration that a user writes who has the recording and the data sheet: everything of the sheet,
/// nothing of the drive.
std::string sheet_configuration(const std::string& name, const independent_plant::ChainCase& c);

/// Writes NAME.csv (t, u, x1 and, where asked for, x2) and NAME.yaml into a folder.
/// @returns the path of the configuration
std::string write_case(const std::string& folder, const std::string& name,
                       const independent_plant::ChainCase& c, bool with_x2);

}  // namespace gapscope::test
