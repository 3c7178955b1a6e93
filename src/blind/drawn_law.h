#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gapscope/diagnosis/named_value.h"
#include "independent_plant/effects.h"

namespace gapscope::blind {

/// How the law of the independent plant compares with the catalogue's.
enum class LawForm {
  kSame,     ///< the same function: its numbers are the catalogue's
  kSeries,   ///< a function of the motor angle, of which the catalogue has the first harmonics: amplitudes of
             ///< those
  kAnother,  ///< another function by construction: no number of it is the catalogue's
};

/// An effect that a drive was given, in the numbers of the catalogue.
struct DrawnLaw {
  std::string effect;
  LawForm form = LawForm::kAnother;
  std::vector<NamedValue> numbers;  ///< by the catalogue's keys, units and order, the amount first; of
                                    ///< another form none
};

/// Of sin(y + k sin y) = Σ (Jₙ₋₁(k) − (−1)ⁿ Jₙ₊₁(k)) sin(n y) a series has the first and the second (Jacobi,
/// Anger).
DrawnLaw drawn_law(const independent_plant::Effects& effects, std::string_view effect);

/// Form of an effect's law on the independent plant.
LawForm form_of(std::string_view effect);

}  // namespace gapscope::blind
