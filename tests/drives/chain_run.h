#pragma once

#include <functional>
#include <vector>

#include "drives/chain_motion.h"
#include "drives/controller.h"
#include "gapscope/recording/recording.h"
#include "independent_plant/simulate.h"

namespace gapscope::independent_plant {

struct ChainRun {
  Recording recording;             ///< x2 is the true angle of the last body
  std::vector<double> x1;          ///< of the motor, free of sensor and noise [rad]
  std::vector<JointEvent> events;  ///< of all joints
};

/// The command of a sample, from its time and from what the encoder reads then.
using ChainInput = std::function<double(double t, double x1)>;

/// Simulates the chain: the encoder is read at the samples, and each command acts until the next.
/// Deterministic in its arguments, where the input is.
/// @throws std::logic_error for numbers that make no drive.
ChainRun simulate_chain(const ChainDrive& drive, const ChainInput& input, const BlindSensor& sensor,
                        const BlindOptions& options);

/// A position loop that follows a course by the encoder of the motor.
struct PositionTask {
  ReferenceMotion course;
  ControllerSettings controller;  ///< turns at each sample
  /// What the target leads by, in the direction of its motion: half of what its author thinks the gap is.
  double compensation_rad = 0.0;
  double compensation_s = 0.02;  ///< time constant with which that changes sides
};

/// @param duration  that the course is for [s]
/// @param seed  of its phases and places
ChainInput position_input(const PositionTask& task, double duration, std::uint64_t seed);
ChainInput torque_input(const BlindExcitation& excitation, const BlindOptions& options);

}  // namespace gapscope::independent_plant
