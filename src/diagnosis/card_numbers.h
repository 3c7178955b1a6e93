#pragma once

#include <string>
#include <vector>

#include "gapscope/diagnosis/card.h"
#include "gapscope/diagnosis/diagnosis.h"

/// What a card says of numbers: those of what was added, and those of the user's own that the fit has moved.
namespace gapscope::internal::diagnosis {

inline constexpr std::size_t kToldNumbers = 3;  ///< of the user's own; the report has all

/// "20.54 N, 95 %: 20.11 to 20.97": how much there is of an effect, as the fit has it. A law that contains a
/// simpler one shares its level with it and is told by what it adds, "stiction ratio 33.0 %", the simpler one
/// by that level. Nothing where the fit has no numbers of it.
std::string amount_of(const AddedEffect& a, const std::vector<AddedEffect>& all, Coordinates coordinates);

/// "motor damping 0.1 → 0.04 N·m s/rad and motor inertia 0.00532 → 0.00781 kg m²": what the configuration has
/// and what was fitted, in its units; empty where none of them reads differently.
/// @param most  told with their change, and all that change by more than a tenth; the rest by name
std::string refitted_words(const Diagnosis& d, Coordinates coordinates, std::size_t most);

/// What helps where no effect is missing: nothing, or other numbers, of the model and of the user's
/// simulator.
std::string other_numbers_help(const CardFacts& f);

/// The next step of the same.
std::string next_of_numbers(const CardFacts& f);

/// " Of your own numbers the fit has changed ...", where something was added.
std::string also_refitted(const CardFacts& f);
/// " Numbers that the fit has changed: motor inertia 0.114 → 0.154 kg m² and 3 more."
std::string briefly_refitted(const CardFacts& f);

}  // namespace gapscope::internal::diagnosis
