#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gapscope/config/configuration.h"

namespace gapscope::internal::run {

/// What rests on numbers that the configuration calls guesses; a sentence for each.
std::vector<std::string> guess_warnings(const Configuration& configuration);

/// What is known of u; nothing where nothing is.
std::optional<InputFacts> known_input(const Configuration& configuration);

}  // namespace gapscope::internal::run
