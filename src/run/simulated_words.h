#pragma once

#include <string>
#include <vector>

#include "gapscope/config/configuration.h"

namespace gapscope::internal::run {

/// What a reader must know of data that no drive has made; empty where none is known to be such.
std::vector<std::string> simulated_words(const Configuration& configuration);

}  // namespace gapscope::internal::run
