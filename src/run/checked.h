#pragma once

#include <string>
#include <vector>

#include "config/configuration.h"
#include "gapscope/base/doubt.h"
#include "gapscope/inspection/inspection.h"

namespace gapscope::internal::run {

/// What `gapscope check` says will spoil the answer to a purpose.
struct Checked {
  std::vector<std::string> warnings;  ///< "log.csv: unit of x1: x1 steps by 360/262144: degrees? -> ..."
  std::vector<Doubt> of_reading;      ///< that hold against a reading without a model
  std::vector<Doubt> of_fit;          ///< … against a fitted model
};

/// Of these files as estimators and diagnosis alike read them; reversals are the detector's own concern, and
/// rows that are out of step that of whoever reads them.
/// @throws ConfigError as inspect() does
Checked check_files(const Configuration& configuration, const std::vector<RecordedFile>& files,
                    Purpose purpose);

}  // namespace gapscope::internal::run
