#pragma once

#include <cstdint>
#include <vector>

#include "gapscope/recording/recording.h"
#include "independent_plant/drive.h"
#include "independent_plant/excitation.h"
#include "independent_plant/rig.h"

namespace gapscope::independent_plant {

constexpr double kFastTolerance = 1e-9;  ///< trajectories within about 1e-7 rad over 10 s, for statistics

struct BlindOptions {
  double rate = 2500.0;      ///< [Hz]
  double duration = 10.0;    ///< [s]
  std::uint64_t seed = 1;    ///< the only source of randomness: noise, phases, knocks, lost counts
  double tolerance = 1e-13;  ///< local error of a step [rad]
};

/// From losing one flank to closing the other, or the same again (a bounce).
struct GapPassage {
  int from_flank = 0, to_flank = 0;  ///< 0: started in the gap
  double t1 = 0.0, t2 = 0.0;         ///< contact torque reached zero; contact closed [s]
  double x1_t1 = 0.0, x1_t2 = 0.0;   ///< [rad]
  double load_travel = 0.0;          ///< x2(t2) − x2(t1) [rad]
  double gap = 0.0;                  ///< 2β at t2 [rad]
};

struct BlindTruth {
  std::vector<ContactEvent> contact_events;
  std::vector<GapPassage> passages;
  std::vector<double> x1, w1, x2, w2;  ///< at the samples, free of sensor and noise [rad, rad/s]
  long steps = 0;                      ///< of the integrator
};

struct BlindRun {
  Recording recording;  ///< as the drive's electronics would store it; x2 and mode as a reference
  BlindTruth truth;
};

/// Simulates the drive. Deterministic in its arguments.
/// @throws std::logic_error for numbers that make no drive.
BlindRun simulate_blind(const BlindDrive& drive, const BlindExcitation& excitation, const BlindSensor& sensor,
                        const BlindOptions& options = {});

/// The same for a given command.
BlindRun simulate_blind_command(const BlindDrive& drive, const std::vector<double>& u,
                                const BlindSensor& sensor, const BlindOptions& options = {});

}  // namespace gapscope::independent_plant
