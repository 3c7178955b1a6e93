#pragma once

#include <cstdint>
#include <string>

#include "independent_plant/simulate.h"

namespace gapscope::independent_plant {

/// Everything that makes one recording.
struct BlindCase {
  std::string kind;
  BlindDrive drive;
  BlindExcitation excitation;
  BlindSensor sensor;
  BlindOptions options;
};

BlindRun simulate_blind(const BlindCase& c);

/// A random drive with a gap, by fixed laws:
///   gap log-uniform 5–50 mrad; m2/m1 log-uniform 0.1–10 (m1, Km of the source paper);
///   k log-uniform 50–5000 N·m/rad; c such that a free impact keeps a uniform 40–90 % of its speed:
///   c = 2ζ√(k·m1·m2/(m1 + m2)), ζ = −ln e/√(π² + ln² e);
///   d1, d2 log-uniform ×0.2–2 of the paper's; Fc2 uniform 2–60 % of the torque amplitude;
///   sine uniform 0.5–3 Hz, 7 periods, torque log-uniform 0.05–0.2 N·m, raised in steps of 25 % (Fc2 with
///   it) until the motor travels at least 1.5 gaps peak to peak; 1, 2, 2.5, 5 or 10 kHz; 20, 16, 14 or 12
///   bit; every second seed in the mean with noise of 0.3–1.5 quanta; the load starts anywhere in the gap.
/// Another waveform takes the place of the sine, of the same period and peak torque: a multisine is the first
/// four harmonics at random phases.
///
/// The wide laws differ from the stated ones so that nothing hangs on one contact or one length: contact
/// damping ratio ζ uniform 0.05–0.4, torque uniform 0.05–0.2 N·m, uniform 8–12 periods.
enum class DriveLaws { kStated, kWide };

BlindCase random_drive(std::uint64_t seed, Waveform waveform = Waveform::kSine,
                       DriveLaws laws = DriveLaws::kStated);

constexpr int kGapFreeKinds = 7;

/// A random drive without a gap, of one of these kinds in equal shares; the rest by the laws above, with a
/// travel of at least 1.5 of the gaps that such a drive would have had.
///   rigid_coulomb      one inertia, Coulomb friction 2–60 % of the torque
///   compliant          two inertias on a spring of 30–5000 N·m/rad, load Coulomb friction 2–60 %
///   motor_coulomb      one inertia, motor Coulomb friction 2–70 %
///   stribeck_sticking  one inertia, Coulomb 10–40 %, stiction 1.2–2.2 times that, Stribeck speed 0.05–1
///   rad/s presliding         one inertia, LuGre level 10–60 %, presliding length log-uniform 1–30 mrad
///   cogging            one inertia, cogging 5–30 % with 12 or 60 periods, Coulomb friction 2–30 %
///   compliant_stribeck compliant, with the friction of stribeck_sticking on the motor
BlindCase random_gap_free_drive(std::uint64_t seed);
BlindCase random_gap_free_drive(std::uint64_t seed, int kind,  ///< 0 ≤ kind < kGapFreeKinds
                                Waveform waveform = Waveform::kSine, DriveLaws laws = DriveLaws::kStated);

/// What a data sheet says of the drive: no effects, and every number but motor inertia and torque constant
/// (which set the scale that no recording of u and x1 can check) off by a uniform share of up to `spread`.
BlindDrive data_sheet(const BlindDrive& drive, std::uint64_t seed, double spread = 0.2);

}  // namespace gapscope::independent_plant
