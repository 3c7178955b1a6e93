#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/bound_bank.h"

namespace gapscope::internal::sliding_mode {

/// What a bank of bounds is judged by over one recording.
struct BankRun {
  std::vector<double> bounds;  ///< rising [rad/s²]
  std::vector<double> floor;   ///< of |e| while sliding, one per bound [rad]
  std::vector<double> quiet;   ///< share of samples with |e| < 2 floor, one per bound
};

/// The same with all error signals: of one bound, or over a short recording.
struct BankErrors : BankRun {
  std::vector<double> errors;  ///< (n_samples × n_bounds) [rad]
  double error(std::size_t i, std::size_t bound) const { return errors[i * bounds.size() + bound]; }
  std::size_t samples() const { return errors.size() / bounds.size(); }
};

/// Logarithmic grid of bounds for a motion: from what cannot slide to where chatter buries everything.
std::vector<double> bound_grid(const signals::SignalFacts& facts, double dt);

/// A bank as it stands just before the first sample of a recording.
BoundBank started_bank(const MotorTrace& trace, const signals::SignalFacts& facts,
                       std::span<const double> bounds, Discretisation discretisation);

BankErrors run_bank(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<double> bounds,
                    Discretisation discretisation);

/// What the chatter of each bound, noise and rounding leave of |e| [rad].
std::vector<double> chatter_floors(const signals::SignalFacts& facts, double dt,
                                   std::span<const double> bounds, Discretisation discretisation);

/// Steps that do not chatter lag by ÿ dt² instead, which chatter_floors() does not show.
void raise_by_lag(BankRun& run, double dt);

/// Index of L_acc, the smallest bound that slides 80 % of the time; the highest one if none does.
std::size_t smallest_sliding(const BankRun& run);

}  // namespace gapscope::internal::sliding_mode
