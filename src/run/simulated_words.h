#pragma once

#include <string>
#include <vector>

#include "config/configuration.h"

namespace gapscope::internal::run {

/// What a reader must know of data that no drive has made; empty where none is known to be such.
/// @param fitted  a model is fitted to them, which then says that the code agrees with itself
std::vector<std::string> simulated_words(const Configuration& configuration, bool fitted);

}  // namespace gapscope::internal::run
