#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/configuration.h"

namespace gapscope::internal::run {

/// What rests on numbers that the configuration calls guesses; a sentence for each.
std::vector<std::string> guess_warnings(const Configuration& configuration);

/// Where a fit looked for the position at which the anchor's arm hangs down, and ended at the edge of that:
/// then it hangs elsewhere, and no torque is right. Empty where it did not.
/// @param phase  of the anchored load_unbalance, as fitted [rad]
std::string hanging_warning(const Configuration& configuration, double phase);

/// Of the model that a diagnosis fitted.
std::string hanging_warning(const Configuration& configuration, const ReferenceModel& fitted);

/// What is known of u; nothing where nothing is.
std::optional<InputFacts> known_input(const Configuration& configuration);

/// What a reader must know of data that no drive has made; empty where none is known to be such.
/// @param fitted  a model is fitted to them, which then says that the code agrees with itself
std::vector<std::string> simulated_words(const Configuration& configuration, bool fitted);

}  // namespace gapscope::internal::run
