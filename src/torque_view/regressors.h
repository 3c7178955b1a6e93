#pragma once

#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "gapscope/recording/recording.h"
#include "torque_view/low_pass.h"
#include "torque_view/options.h"

namespace gapscope::internal::torque_view {

/// A recording with its stamps as they are.
struct StampedTrace {
  std::string file;
  std::vector<double> t;       ///< rising [s]
  std::vector<double> u;       ///< [unit of u]
  std::vector<double> x;       ///< motor position [rad or m]
  double quantum = 0.0;        ///< of the encoder; 0: unknown
  bool held_command = false;   ///< u is a command that is held to the next sample, no measured current
  double added_inertia = 0.0;  ///< of this recording's load, beyond the others', which takes its part of u

  double step() const;  ///< median of the time steps [s]
};
StampedTrace stamped(const MotorTrace& trace, bool held_command);

/// One recording in one band. Laws are evaluated at the samples, on states through G_i of σ_i = 0.6 σ, and
/// thinned to rows by one of two filters, which together make every column see the Gaussian G of the band:
///   linear in the states (J a, d w, what follows the model's torque): G_o, σ_o = 0.8 σ, as G_o ∗ G_i = G;
///   what the states only switch (a direction, an angle, the time):    G itself, as the input does.
struct BandRecord {
  double hz = 0.0;                      ///< top of the band
  std::vector<double> t, x, w, a;       ///< at the samples: t, x raw, w and a through G_i
  std::vector<double> row_time;         ///< [s]
  std::vector<std::size_t> row_number;  ///< on the even grid that masked rows were dropped from
  Eigen::VectorXd u;                    ///< G ∗ u at the rows
  RowFilter rest, whole;                ///< G_o and G
  double masked = 0.0;                  ///< share of the rows that were dropped
};
BandRecord in_band(const StampedTrace& trace, double hz, const TorqueViewOptions& options);

/// σ of white noise on x, as the top of its spectrum shows it: what the shortest kernel leaves [rad].
double position_noise(const StampedTrace& trace);

/// rms of the acceleration that white noise of σ on x makes in the low-pass of f:
///   σ² dt ∫ G''² = σ² dt · 3/(8 √π σ_t⁵)
double noise_acceleration(double noise, double dt, double hz);

}  // namespace gapscope::internal::torque_view
