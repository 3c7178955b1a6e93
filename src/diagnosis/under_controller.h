#pragma once

#include <optional>

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// What is held out in closed loop: each recording begins where the model fits it best, and goes on under the
/// controller alone. Nothing where the recordings have no command.
std::optional<ClosedLoop> judged_under_controller(const Study& study, const ReferenceModel& before,
                                                  const ReferenceModel& after);

}  // namespace gapscope::internal::diagnosis
