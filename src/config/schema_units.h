#pragma once

#include "config/schema_parts.h"
#include "gapscope/base/coordinates.h"

namespace gapscope::internal::config {

/// recording: units, of whatever axis.
Json units_schema();

/// recording: registers.
Json registers_schema();

/// Of a configuration whose axis turns, or slides.
Json units_of_axis(Coordinates coordinates);

}  // namespace gapscope::internal::config
