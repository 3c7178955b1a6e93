#pragma once

#include <span>

#include "gapscope/telling/statement.h"

namespace gapscope::internal::telling {

/// What is told to do next.
std::span<const Wording> step_wordings();

}  // namespace gapscope::internal::telling
