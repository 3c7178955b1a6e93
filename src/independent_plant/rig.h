#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "independent_plant/motion.h"

namespace gapscope::independent_plant {

struct BlindSensor {
  double quantum = 0.0;  ///< counts are rounded to the nearest; 0: a perfect encoder [rad]
  double noise = 0.0;    ///< rms, before rounding [rad]
  /// 2^bits counts per revolution, noise in quanta.
  static BlindSensor with_bits(int bits, double noise_quanta = 0.0);
};

/// The encoder with all its faults; asked at rising times.
class EncoderReading {
 public:
  /// @param until  faults are spread from 0 to it [s]
  EncoderReading(const Dynamics& dynamics, const BlindSensor& sensor, double until, std::uint64_t seed);
  double read(double t, const State& s);

 private:
  const Dynamics& dynamics_;
  const SensorEffects& effects_;
  double quantum_, noise_rms_;
  std::mt19937_64 noise_;
  std::vector<double> losses_;  ///< times; the sign stands for the direction of the loss
};

/// A drive at work: commands go in, time goes on, the encoder is read.
class Rig {
 public:
  Rig(const BlindDrive& drive, const BlindSensor& sensor, double duration, double tolerance,
      std::uint64_t seed);

  /// A command that leaves the electronics at t, not before the last one; it acts after the drive's own delay
  /// and jitter. What is read at t is read before it acts.
  void send(double t, double u);
  void advance(double t);
  double read() { return encoder_.read(motion_.time(), motion_.state()); }  ///< the encoder, now [rad]
  double acting() const;  ///< what drives the motor, after all of the command's effects [unit of u]

  const Motion& motion() const { return motion_; }
  const Dynamics& dynamics() const { return dynamics_; }

 private:
  struct Update {
    double time = 0.0, command = 0.0;
  };
  void act_on(const Update& update);

  Dynamics dynamics_;
  Motion motion_;
  EncoderReading encoder_;
  std::mt19937_64 jitter_, noise_;
  std::deque<Update> queue_;
  double held_ = 0.0;
};

}  // namespace gapscope::independent_plant
