#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"
#include "gapscope/simulation/stepper.h"
#include "reference/input_delay.h"

namespace gapscope::internal::reference {

/// Output injection of the model run as an observer, into the body with the encoder: x1 += l1 e, w1 += l2
/// e/dt. Both poles of the position error of a free mass lie at exp(−2π f dt), dt the interval before the
/// sample.
struct ObserverGain {
  double position = 0.0;  ///< l1 [-]
  double speed = 0.0;     ///< l2/dt [1/s]

  static ObserverGain poles(double hz, double dt) {
    if (hz <= 0.0) return {};
    const double p = std::exp(-2.0 * kPi * hz * dt);
    return {1.0 - p * p, (1.0 - p) * (1.0 - p) / dt};
  }
};

/// The gain at each sample of a recording: of uneven sampling each interval has its own.
class ObserverGains {
 public:
  ObserverGains() = default;  ///< no correction: the free run
  ObserverGains(double hz, const MotorTrace& recording)
      : hz_(hz), dt_(recording.dt), stamps_(recording.stamps), mean_(ObserverGain::poles(hz, recording.dt)) {}

  bool corrects() const { return mean_.position > 0.0; }
  ObserverGain at(std::size_t i) const {
    return stamps_.empty() || i == 0 ? mean_ : ObserverGain::poles(hz_, interval(i));
  }
  /// The time that ends with sample i [s].
  double interval(std::size_t i) const {
    return stamps_.empty() || i == 0 ? dt_ : stamps_[i] - stamps_[i - 1];
  }

 private:
  double hz_ = 0.0, dt_ = 0.0;
  std::span<const double> stamps_;
  ObserverGain mean_;
};

/// The input that a stepper for the recording takes.
inline std::span<const double> stepped_input(const MotorTrace& recording) {
  return recording.sent.empty() ? recording.u : recording.sent;
}

/// A stepper for the intervals of a recording, with the load that it had, and, where its controller's output
/// acts later, for that delay.
template <class T>
DriveStepper<T> stepper_for(const PlantModel<T>& model, const MotorTrace& recording) {
  double shortest = recording.even() ? 0.0 : recording.dt;
  for (std::size_t i = 1; i < recording.stamps.size(); ++i)
    shortest = std::min(shortest, recording.step(i - 1));
  if (recording.sent.empty() && recording.load.is_none())
    return DriveStepper<T>(model, recording.dt, shortest);
  PlantModel<T> then = model;
  if (!recording.load.is_none()) add_load(then, recording.load.inertia, recording.load.gravity);
  if (!recording.sent.empty()) delay_input(then, T(recording.delay));
  return DriveStepper<T>(then, recording.dt, shortest);
}

/// One interval of the recording, from sample i on, with the input u.
template <class T>
void play_step(DriveStepper<T>& stepper, const MotorTrace& recording, std::size_t i, const T& u) {
  if (recording.even())
    stepper.step(u);
  else
    stepper.step(u, recording.step(i));
}
template <class T>
void play_step(DriveStepper<T>& stepper, const MotorTrace& recording, std::size_t i) {
  play_step(stepper, recording, i, T(stepped_input(recording)[i]));
}

/// The drive's state where the sensor reads the position that the recorded body starts at: what the sensor
/// adds to it shifts the drive, not the first sample.
template <class T>
DriveState<T> behind_the_sensor(const PlantModel<T>& model, DriveStepper<T>& stepper,
                                const DriveState<T>& start) {
  stepper.reset(start);
  const T added = stepper.measured() - (model.structure.reads_load() ? start.x2 : start.x1);
  DriveState<T> drive = start;
  drive.x1 -= added, drive.x2 -= added;
  return drive;
}

/// Plays an input, that of each sample, on the model and hands each sample's index and stepper to `visit`
/// before the measurement is injected. @returns false when the motion left the numbers, or chatters: more
/// events than samples, all in all, are no motion that the recording could show.
/// @param start of the drive, with the motor where the sensor reads it
template <class T, class U, class Visit>
bool roll_out(const PlantModel<T>& model, const DriveState<T>& start, const MotorTrace& recording,
              std::span<const U> u, const ObserverGains& gains, Visit&& visit) {
  DriveStepper<T> stepper = stepper_for(model, recording);
  stepper.reset(behind_the_sensor(model, stepper, start));
  for (std::size_t i = 0; i < recording.size(); ++i) {
    visit(i, stepper);
    if (gains.corrects()) {
      const ObserverGain gain = gains.at(i);
      const T innovation = recording.x1[i] - stepper.measured();
      stepper.inject(gain.position * innovation, gain.speed * innovation);
    }
    play_step(stepper, recording, i, T(u[i]));
    if (!stepper.healthy() || stepper.events() > 100 + static_cast<long>(recording.size())) return false;
  }
  return true;
}

/// The same with the input of the recording.
template <class T, class Visit>
bool roll_out(const PlantModel<T>& model, const DriveState<T>& start, const MotorTrace& recording,
              const ObserverGains& gains, Visit&& visit) {
  return roll_out(model, start, recording, stepped_input(recording), gains, std::forward<Visit>(visit));
}

}  // namespace gapscope::internal::reference
