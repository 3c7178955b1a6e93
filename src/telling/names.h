#pragma once

#include <string>
#include <vector>

#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/telling/statement.h"

/// What effects and numbers are called, and how much there is of them.
namespace gapscope::internal::telling {

/// "cogging torque", "inverse Stribeck friction (lower at low speed)": with what the sign of its parameters
/// makes of it, and with its period where it was added more than once.
ToldName name_of(const AddedEffect& added, const Diagnosis& diagnosis, Coordinates coordinates);

/// The same with how much there is of it as its aside.
/// @param share  what it takes, put behind the amount; empty: not told
ToldName with_amount(const AddedEffect& added, const Diagnosis& diagnosis, Coordinates coordinates,
                     const std::string& share);

/// Its period and its amount; a period that the name has is not told again.
std::vector<std::string> amounts_of(const AddedEffect& added, const Diagnosis& diagnosis,
                                    Coordinates coordinates, bool period_is_named);

/// What the recordings cannot tell from an effect, but for what was added as well.
std::vector<std::string> others_of(const AddedEffect& added, const Diagnosis& diagnosis);

/// An estimated number that now reads differently.
struct ChangedNumber {
  std::string name;     ///< "motor damping"
  std::string briefly;  ///< "motor damping 0.1 → 0.04 N·m s/rad"
  std::string in_full;  ///< "motor damping 0.1 → 0.0400 N·m s/rad (95 %: 0.0399 to 0.0401)"
  double moved = 0.0;   ///< by how much of itself
  bool torque = false;  ///< of an effect
};
/// All of them: those that clearly move first, torques of effects before them.
std::vector<ChangedNumber> changed_numbers(const Diagnosis& diagnosis, Coordinates coordinates);

/// Those in brief: the first three, and how many more there are.
Fact briefly_changed(const std::vector<ChangedNumber>& all);
/// The first ones and all that clearly move with their intervals, the rest by name.
Fact changed_in_full(const std::vector<ChangedNumber>& all, std::size_t most);

/// What inertia and damping that change by one factor may be instead; nothing where they do not.
Told scaled_numbers(const Diagnosis& diagnosis);

/// "a free curve over the speed", or the effect of a law of the torque balance.
std::string readable_law(const std::string& law);

/// A literal value of a configuration, whose braces are none of a wording.
inline Fact estimate_true() { return word("estimate", "{estimate: true}"); }

}  // namespace gapscope::internal::telling
