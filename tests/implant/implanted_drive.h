#pragma once

#include "implant/implant.h"
#include "independent_plant/simulate.h"

/// A drive of one body on the independent plant, and the same with what was implanted into its recordings.
namespace gapscope::internal::implant::test {

namespace plant = gapscope::independent_plant;

inline constexpr double kCount = 2.0 * kPi / 1048576.0;  ///< of 20 bit [rad]

inline plant::BlindDrive one_body() {
  plant::BlindDrive drive;
  drive.load = plant::BlindLoad::kNone;
  drive.motor_inertia = 1.75e-3, drive.motor_damping = 0.02;
  drive.gap = 0.0;
  drive.effects.motor.friction.level_nm = 0.01;
  return drive;
}

/// Read by 20 bit at 2 kHz.
inline plant::BlindRun driven(const plant::BlindDrive& drive, const std::vector<double>& u) {
  return plant::simulate_blind_command(drive, u, {kCount, 0.0}, {2000.0, 0.0, 1, 1e-12});
}

/// At rest for a while, as what was commanded before a recording is not in it, then several frequencies.
inline std::vector<double> commanded(std::uint64_t seed = 3) {
  plant::BlindExcitation e;
  e.waveform = plant::Waveform::kMultisine;
  e.amplitude = 0.6, e.frequency = 0.5, e.frequency_end = 4.0;
  std::vector<double> u(200, 0.0);
  const std::vector<double> more = plant::command(e, 2000.0, 6.0, seed);
  u.insert(u.end(), more.begin(), more.end());
  return u;
}

inline Receiver receiver_of(const plant::BlindDrive& d) {
  return {d.torque_constant, d.motor_inertia, d.motor_damping, true, true};
}

}  // namespace gapscope::internal::implant::test
