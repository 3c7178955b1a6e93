#pragma once

#include <cmath>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"
#include "gapscope/simulation/stepper.h"

namespace gapscope::internal::reference {

/// Output injection of the model run as an observer: x1 += l1 e, w1 += l2 e/dt.
/// Both poles of the position error of a free mass lie at exp(−2π f dt).
struct ObserverGain {
  double position = 0.0;  ///< l1 [-]
  double speed = 0.0;     ///< l2/dt [1/s]

  static ObserverGain poles(double hz, double dt) {
    if (hz <= 0.0) return {};
    const double p = std::exp(-2.0 * kPi * hz * dt);
    return {1.0 - p * p, (1.0 - p) * (1.0 - p) / dt};
  }
};

/// The drive's state where the sensor reads start.x1: what the sensor adds to the motor's angle shifts the
/// drive, not the first sample.
template <class T>
DriveState<T> behind_the_sensor(DriveStepper<T>& stepper, const DriveState<T>& start) {
  stepper.reset(start);
  const T added = stepper.measured() - start.x1;
  DriveState<T> drive = start;
  drive.x1 -= added, drive.x2 -= added;
  return drive;
}

/// Plays a recording's input on the model and hands each sample's index and stepper to `visit` before the
/// measurement is injected. @returns false when the motion left the numbers, or chatters: more events than
/// samples, all in all, are no motion that the recording could show.
/// @param start of the drive, with the motor where the sensor reads it
template <class T, class Visit>
bool roll_out(const PlantModel<T>& model, const DriveState<T>& start, const MotorTrace& recording,
              const ObserverGain& gain, Visit&& visit) {
  DriveStepper<T> stepper(model, recording.dt);
  stepper.reset(behind_the_sensor(stepper, start));
  for (std::size_t i = 0; i < recording.size(); ++i) {
    visit(i, stepper);
    if (gain.position > 0.0) {
      const T innovation = recording.x1[i] - stepper.measured();
      stepper.inject(gain.position * innovation, gain.speed * innovation);
    }
    stepper.step(recording.u[i]);
    if (!stepper.healthy() || stepper.events() > 100 + static_cast<long>(recording.size())) return false;
  }
  return true;
}

}  // namespace gapscope::internal::reference
