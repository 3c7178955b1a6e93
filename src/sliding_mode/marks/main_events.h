#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sliding_mode/marks/bank_marks.h"

namespace gapscope::internal::sliding_mode {

constexpr double kEcho = 2.5;  ///< an earlier impact that is this much weaker is none; a later one is an echo
constexpr double kMiddle = 0.5;     ///< of the main events: the bound that decides t2
constexpr double kMostTops = 0.95;  ///< … what an impact at every reversal would stand out of

/// Everything that a bank of bounds saw happen to the motor.  @param half_period  [samples]
std::vector<BankEvent> all_events(const BankMarks& run, double half_period);

/// How abrupt a main event must be at least, as a bound [rad/s²]: a sixth of the weakest of the strongest,
/// one for each half period. Nothing where fewer than kFewestHalfPeriods events are persistent.
std::optional<double> least_top(std::span<const BankEvent> events, const BankRun& run,
                                std::size_t half_periods);

/// Events that reach that bound, and are not the echo of another near by. Ranked by the top bound, never by
/// Δv: for an acceleration step the latter is meaningless.  @param half_period  [samples]
std::vector<BankEvent> main_events(std::span<const BankEvent> events, const BankRun& run, double least,
                                   double half_period);

/// Index of the bound that so many of the main events do not exceed.
/// @param tops  how many of them have each bound of the grid as their top   @param none  where there are none
std::size_t top_bound(std::span<const std::size_t> tops, double share, std::size_t none);

}  // namespace gapscope::internal::sliding_mode
