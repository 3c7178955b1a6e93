#pragma once

#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/bound_bank.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// The error signals of all bounds over one recording, with the chatter floor of each.
struct BankRun {
  std::vector<double> bounds;  ///< rising [rad/s²]
  std::vector<double> floor;   ///< of |e| while sliding, one per bound [rad]
  std::vector<double> quiet;   ///< share of samples with |e| < 2 floor, one per bound
  std::vector<double> errors;  ///< (n_samples × n_bounds) [rad]
  double error(std::size_t i, std::size_t bound) const { return errors[i * bounds.size() + bound]; }
  std::size_t samples() const { return errors.size() / bounds.size(); }
};

/// Logarithmic grid of bounds for a motion: from what cannot slide to where chatter buries everything.
std::vector<double> bound_grid(const signals::SignalFacts& facts, double dt);

/// A bank as it stands just before the first sample of a recording.
BoundBank started_bank(const MotorTrace& trace, const signals::SignalFacts& facts,
                       std::span<const double> bounds, Discretisation discretisation);

BankRun run_bank(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<double> bounds,
                 Discretisation discretisation);

/// Index of L_acc, the smallest bound that slides 80 % of the time; the highest one if none does.
std::size_t smallest_sliding(const BankRun& run);

/// A stretch of one error signal outside its floor, of one sign.
struct Excursion {
  std::size_t bound = 0;  ///< index into the grid
  int sign = 0;           ///< of e
  std::size_t start = 0;  ///< last sample before it that is within the floor, or of the other sign
  std::size_t peak = 0;
  std::size_t end = 0;  ///< first sample back below half the floor, or of the other sign
  double height = 0.0;  ///< |e| at the peak [rad]
};

std::vector<Excursion> find_excursions(const BankRun& run, std::size_t bound);

/// Up to which bound something would show that peaks at `height` [rad] at this bound, the highest that shows
/// it [rad/s²]. That is the bound itself, but the highest of the bank is where the bank ends: there a
/// velocity step, whose peak is 0.102 Δv²/k₂, would show up to as many times that bound as its peak has
/// double floors.
double abruptness(const BankRun& run, std::size_t bound, double height);

/// Excursions of one sign, linked over the bounds from the highest down: one thing that happened to the
/// motor.
struct BankEvent {
  int sign = 0;
  std::size_t start = 0;  ///< at the highest bound: least latency
  std::size_t peak = 0;   ///< at the highest bound
  std::size_t top = 0;    ///< highest bound (index) that shows it
  std::size_t last = 0;   ///< lowest bound (index) that shows it
  std::size_t seen = 0;   ///< number of bounds that show it
  double step = 0.0;      ///< velocity step Δv = √(k₂ |e_peak|/0.102), median of the top three [rad/s]
  std::vector<double> steps;  ///< of the top three
  double abruptness = 0.0;    ///< abruptness() of its highest excursion [rad/s²]
  std::size_t latency = 0;    ///< longest from start to peak among the top four [samples]
};

std::vector<BankEvent> link_events(const BankRun& run, const std::vector<std::vector<Excursion>>& excursions,
                                   std::size_t tolerance);

}  // namespace gapscope::internal::sliding_mode
