#pragma once

#include <optional>

#include "config/configuration.h"
#include "run/run_diagnosis.h"

namespace gapscope::internal::run {

/// Where nothing is known of a gap that is sought: the one that the detector reads in what is fitted, or else
/// in what is held out [rad]. A diagnosis begins its search there: it asks for a model that has it, not
/// whether two estimates agree.
std::optional<double> read_gap(const Configuration& configuration, const DiagnosisRecordings& recordings);

}  // namespace gapscope::internal::run
