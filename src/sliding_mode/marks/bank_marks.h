#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sliding_mode/marks/bank_run.h"

namespace gapscope::internal::sliding_mode {

/// A stretch of one error signal outside its floor, of one sign.
struct Excursion {
  std::size_t bound = 0;  ///< index into the grid
  int sign = 0;           ///< of e
  std::size_t start = 0;  ///< last sample before it that is within the floor, or of the other sign
  std::size_t peak = 0;
  std::size_t end = 0;  ///< first sample back below half the floor, or of the other sign
  double height = 0.0;  ///< |e| at the peak [rad]
};

/// What stands out of the floors of a bank: all that is asked of a long recording, whose error signals
/// would take 50 times the room.
struct BankMarks : BankRun {
  std::vector<std::vector<Excursion>> excursions;  ///< of each bound, in time
  std::vector<std::uint32_t> loud;  ///< of each sample: a bit for each bound with |e| > 2 floor
  struct Height {
    std::size_t sample = 0;
    double height = 0.0;  ///< |e| [rad]
  };
  std::vector<Height> at_highest;  ///< where the highest bound is loud, in time

  bool is_loud(std::size_t i, std::size_t bound) const { return (loud[i] >> bound & 1u) != 0; }
  /// The largest |e| [rad] of the highest bound in [from, to), 0 where it is not loud.
  double highest_peak(std::size_t from, std::size_t to) const;
};

/// A matched bank's marks, its errors looked at as they come.  @param bounds  32 at most
BankMarks mark_bank(const MotorTrace& trace, const signals::SignalFacts& facts, std::vector<double> bounds);

/// Those of errors that are there.  @param run  of 32 bounds at most
BankMarks marks_of(const BankErrors& run);

std::vector<Excursion> find_excursions(const BankErrors& run, std::size_t bound);

/// Up to which bound something would show that peaks at `height` [rad] at this bound, the highest that shows
/// it [rad/s²]. That is the bound itself, but the highest of the bank is where the bank ends: there a
/// velocity step, whose peak is kStepPeak Δv²/k₂, would show up to as many times that bound as its peak has
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
  double step = 0.0;  ///< velocity step Δv = √(k₂ |e_peak|/kStepPeak), median of the top three [rad/s]
  std::vector<double> steps;  ///< of the top three
  double abruptness = 0.0;    ///< abruptness() of its highest excursion [rad/s²]
  std::size_t latency = 0;    ///< longest from start to peak among the top four [samples]
};

std::vector<BankEvent> link_events(const BankRun& run, const std::vector<std::vector<Excursion>>& excursions,
                                   std::size_t tolerance);

}  // namespace gapscope::internal::sliding_mode
