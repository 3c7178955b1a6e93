#pragma once

#include <cstddef>
#include <vector>

#include "gapscope/base/remark.h"
#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// What the samples say about themselves, before any detection.
struct SignalFacts {
  double quantum = 0.0;    ///< of the encoder [rad]
  double noise = 0.0;      ///< σ_n, standard deviation of one sample: noise and quantisation [rad]
  double travel = 0.0;     ///< peak to peak, without the drift from period to period [rad]
  double centre = 0.0;     ///< middle of that travel [rad]
  double amplitude = 0.0;  ///< half of it, from the 2 and 98 % quantiles [rad]
  double speed_rms = 0.0;  ///< [rad/s]
  /// Mean of u, without its sign, over √2 times its standard deviation: the amplitude of a sine about it.
  /// Beyond 1 what u works against, such as gravity or a preload, exceeds all that it swings by.
  double leaning = 0.0;
  double half_period = 0.0;  ///< median time between crossings of the centre [s]
  std::size_t half_periods = 0;
  double input_period = 0.0;           ///< exact_period() of u [s]; 0: it has none
  std::vector<std::size_t> crossings;  ///< of the centre, one per half stroke
  Remark defect;                       ///< why nothing can be detected here; empty if something can

  /// Beyond the noise of the encoder.
  bool moves() const { return amplitude > 6.0 * noise && amplitude > 0.0; }
  /// The way that is surely none of noise and counting: 8 σ + 2 quanta [rad].
  double least_way() const { return 8.0 * noise + 2.0 * quantum; }
  /// Samples that share one rounding where x1 moves by `step` [rad] a sample: a motor that takes several of
  /// them for a quantum reads no more often than it passes one, unless noise dithers its counts.
  double sharing(double step) const;
};

SignalFacts read_facts(const MotorTrace& trace);

/// Fewest half periods that make a motion periodic.
constexpr std::size_t kFewestHalfPeriods = 4;

/// Fewest periods of the input that tell a drift from the motion.
constexpr double kFewestRepetitions = 3.0;

}  // namespace gapscope::internal::signals
