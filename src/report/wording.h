#pragma once

#include <optional>
#include <string>

#include "results/run_result.h"

/// How numbers and findings are put into words. Plain Unicode text, fit for Markdown and figures alike.
namespace gapscope::internal::report {

/// A number, or a text with numbers, as it is printed: "-1.2e-05" reads "−1.2·10⁻⁵".
std::string typeset(const std::string& text);

/// So many significant digits, without a unit: "0.132", "−0.02", "8810"; a dash for NaN.
std::string rounded(double value, int digits = 3);

/// "18.7 mrad": three significant digits; "unknown" for NaN.
std::string quantity(double value, const std::string& unit);

/// The same in the unit of a larger number beside it, to as many significant digits: "0.0846 mrad" beside
/// 18.9 mrad, where quantity() has 84.6 µrad.
std::string quantity_beside(double value, double larger, const std::string& unit);

/// "18.70 mrad (95 %: 18.50 to 18.90)": digits as the interval warrants; without one like quantity().
std::string with_interval(double value, const Interval& ci95, const std::string& unit);

/// "18.50 to 18.90 mrad"; empty without an interval.
std::string interval_text(const Interval& ci95, const std::string& unit);

/// "18.70 ± 0.20 mrad"; an interval that is not around its value, as where it was cut at 0, as
/// with_interval() has it
/// The value of an estimate with as many digits as its interval has, or three.
std::string beside_interval(double value, const Interval& ci95, const std::string& unit);
/// A fit in per cent; what is no whole one is never rounded to "100 %".
std::string fit_text(double percent, int digits = 4);
std::string plus_minus(double value, const Interval& ci95, const std::string& unit);

/// A ratio or count for people: "7.0", "132".
std::string plain_number(double value);

/// "1 passage", "3 passages"
std::string counted(std::size_t count, const std::string& noun);

std::string position_unit(const RunResult& run);  ///< "rad" or "m"
std::string torque_unit(const RunResult& run);    ///< "N·m" or "N"
std::string input_unit(const RunResult& run);     ///< of u, as it was declared: "A", else "units of $u$"

/// What a figure writes behind the unit of a torque (force): "$K_m$ guessed", or nothing.
std::string torque_note(const std::optional<InputFacts>& input);

/// The parameter of that key, nullptr if there is none.
const FittedParameter* parameter(const RunResult& run, const std::string& key);

/// How far each estimate is from the true gap, where that is known; else empty.
std::string accuracy(const RunResult& run);
std::string without_estimate(const RunResult& run);  ///< in its place

/// How well the free run of the fitted model meets the recording; empty without a fit.
std::string fit_quality(const RunResult& run);

/// The answer of a run in a sentence; of a result without one its estimates.
std::string headline(const RunResult& run);

/// What each estimator says, and how they compare.
std::string estimates_text(const RunResult& run);

}  // namespace gapscope::internal::report
