#pragma once

#include <string>

namespace gapscope {

/// What is known of the input u of a drive beyond its numbers.
struct InputFacts {
  std::string unit;               ///< of SI, as it was declared: "A", "V", "N m", "N"; empty: none was
  bool constant_guessed = false;  ///< torque_constant is a guess, and every torque that is told rests on it

  bool told() const { return !unit.empty() || constant_guessed; }
};

/// A text that speaks of "units of u" or "N m per unit of u", with the declared unit in their place; without
/// one "7 unit of u" reads "7 units of u". "The unit of u" stays. Of a u that is a torque "1 N m per unit of
/// u" reads "1 (u is in N m)".
std::string with_input_unit(const std::string& text, const InputFacts& input);

}  // namespace gapscope
