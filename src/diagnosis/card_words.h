#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/diagnosis/card.h"
#include "gapscope/diagnosis/diagnosis.h"

/// How a card writes numbers and lists.
namespace gapscope::internal::diagnosis {

inline constexpr const char* kNoBacklash = "There is no backlash above ";  ///< begins one that denies a gap
inline constexpr const char* kThePlay = "The play at zero torque";  ///< begins the answer that bounds a gap

/// A size with the prefix that keeps the first of several between 1 and 1000; all of them in that unit.
class SharedUnit {
 public:
  /// @param first  size that chooses the prefix   @param unit  "N·m", "N", "rad" or "m"
  SharedUnit(double first, const std::string& unit);
  std::string number(double value) const;                                       ///< "9.66"
  std::string operator()(double value) const { return number(value) + unit_; }  ///< "9.66 N"
  /// "9.66 N, 95 %: 9.41 to 9.91": two digits of the half width; without an interval as above.
  std::string with_interval(double value, const Interval& ci95) const;
  /// "9.66 N (95 %: 9.41 to 9.91)"
  std::string with_interval_aside(double value, const Interval& ci95) const;

 private:
  std::string interval_after(double value, const Interval& ci95, const char* before, const char* after) const;

  double factor_ = 1.0;
  std::string unit_;  ///< with the space before it; empty of a ratio
};

/// "The backlash gap 2β (full width, at x1) is "
std::string the_gap_is();

/// Whether the gap is that of an effect that divides the one body of the model: rigid at its contact and with
/// all friction on the motor's side, it shows that there is a gap rather than how wide it is.
bool divides_one_body(const Diagnosis& diagnosis);

/// "the encoder's noise", or what else no model of the motion gets below.
std::string floor_of_the_motion(const MismatchSize& size);

/// " (these recordings leave it open by 15 %)": of a gap whose interval is wider than a part of it, which
/// then rests on the form of the contact's law, and nobody knows that; else empty.
std::string left_open(const Answer& gap);

/// "17.1 %", "0.21 %"
std::string percent_text(double percent);

/// "a, b and c"
std::string enumerated(const std::vector<std::string>& items, const char* last = "and");

/// The same with a capital letter, and a full stop at its end.
std::string as_sentence(std::string text);

/// "The missing torque depends on the direction of motion.", "... is periodic in the motor angle."
std::string where_words(const Diagnosis& diagnosis, Coordinates coordinates);

/// Of a gap that a diagnosis does not estimate: who tells it. A null pointer: there is no diagnosis either.
std::string gap_not_estimated(const Diagnosis* diagnosis, Coordinates coordinates);

/// "`gapscope export --to mjcf` takes it to other simulators.", or that no format has all that was added.
std::string export_words(const CardFacts& facts);

/// Without what stands in brackets: the detail of a report has it.
std::string without_asides(std::string text);

/// Up to the first of these characters that ends a clause, outside of brackets and of code, with a full stop.
std::string first_clause(const std::string& text, std::string_view ends = ".;");

}  // namespace gapscope::internal::diagnosis
