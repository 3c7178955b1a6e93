#pragma once

#include "gapscope/base/statistics.h"

/// What can be added to the independent plant, by the side it acts on. Everything is absent by default.
/// Where a law can reasonably be written in another form than the first that comes to mind, it is: whoever
/// identifies these effects meets the effect, not the formula.
namespace gapscope::independent_plant {

/// Set-valued dry friction of the motor bearing. In direction s = sign(w1) it resists with
///   level·(1 + coulomb_ratio·s)·(1 + stiction_ratio·exp(−|w1/v|^exponent)),   v = stribeck_speed,
/// and viscous friction becomes d1·(1 + viscous_ratio·s). Gears that carry τ (the contact torque; of one body
/// what moves it against the torques of the load) add gear_ratio·(√(τ² + gear_knee²) − gear_knee) to the
/// level.
struct MotorFriction {
  double level_nm = 0.0;              ///< [N·m]
  double coulomb_ratio = 0.0;         ///< [-]
  double viscous_ratio = 0.0;         ///< [-]
  double stiction_ratio = 0.0;        ///< [-]
  double stribeck_speed_rad_s = 1.0;  ///< [rad/s]
  double stribeck_exponent = 1.0;     ///< [-], 1: Tustin's form, 2: Gaussian
  double gear_ratio = 0.0;            ///< [-]
  double gear_knee_nm = 0.0;          ///< [N·m]
};

/// LuGre bristle with constant level, of the motor or the load: ż = w − |w|·z/length, torque
/// −(level/length)·z − damping·ż.
struct BristleFriction {
  double level_nm = 0.0;
  double length_rad = 1e-3;
  double damping_nms = 0.0;
};

/// Periodic in the motor angle, steeper on one side of a tooth than on the other: with y = N·x1 + φ
///   amplitude·sin(y + skew·sin(y)),
/// whose second harmonic is skew/2 of the first, its third skew²/8, and so on; and harmonics of other origin,
/// amplitude·(second·sin(2y + φ2) + third·sin(3y + φ3)).
struct AngleHarmonic {
  double amplitude = 0.0;  ///< cogging: [N·m]; ripple: share of the torque [-]
  double periods_per_turn = 12.0;
  double phase_rad = 0.0;
  double skew = 0.0;    ///< [rad]
  double second = 0.0;  ///< [-]
  double second_phase_rad = 0.0;
  double third = 0.0;  ///< [-]
  double third_phase_rad = 0.0;
};

/// A short push on the motor from outside: half-sine torque pulses at random times (outside the catalogue).
struct Knocks {
  int count = 0;
  double torque_nm = 0.0;  ///< peak; sign drawn for every knock
  double duration_s = 5e-3;
};

struct MotorEffects {
  MotorFriction friction;
  BristleFriction bristle;
  double drag_nms2 = 0.0;  ///< −drag·sign(w1)·|w1|^drag_exponent
  double drag_exponent = 2.0;
  AngleHarmonic cogging;              ///< −cogging
  AngleHarmonic second_cogging;       ///< the same, of another origin, such as poles beside teeth
  double viscous_drift_ratio = 0.0;   ///< d1·(1 + ratio·(1 − exp(−t/T)))
  double viscous_drift_time_s = 5.0;  ///< T
  Knocks knocks;
};

struct LoadEffects {
  BristleFriction bristle;    ///< of a load with a gap or a soft shaft
  double unbalance_nm = 0.0;  ///< −unbalance·sin(N·x2 + φ)
  double unbalance_phase_rad = 0.0;
  double unbalance_periods = 1.0;  ///< N, of a load that turns otherwise than x2 counts
  double constant_torque_nm = 0.0;
  /// m2·(1 + ratio·r(t)), r a ramp from 0 to 1: mass arrives with the speed of the load.
  double inertia_ratio = 0.0;
  double inertia_time_s = 0.0;
  double inertia_duration_s = 0.0;   ///< 0: a step
  double resonator_inertia = 0.0;    ///< third inertia on the load by a spring [kg·m²]
  double resonator_stiffness = 0.0;  ///< [N·m/rad]
  double resonator_damping = 0.0;    ///< against the load [N·m·s/rad]
  double resonator_drag = 0.0;       ///< against the ground [N·m·s/rad]
};

struct ContactEffects {
  double stiffness_nm_rad = kNaN;  ///< true stiffness where it is not the nominal one
  double damping_nms_rad = kNaN;   ///< true damping where it is not the nominal one
  double eccentricity_rad = 0.0;   ///< 2β + 2·eccentricity·sin(N·x2 + φ)
  double eccentricity_phase_rad = 0.0;
  double eccentricity_periods = 1.0;  ///< N
  double growth_rad_s = 0.0;  ///< initial rate of 2β, which then saturates: rate·T·(1 − exp(−t/T))
  double growth_time_s = kInfinity;       ///< T; infinite: linear growth
  double release_nm = 0.0;                ///< tensile torque at which a closed contact lets go
  double hardening_per_rad2 = 0.0;        ///< k·p·(1 + hardening·p²/(1 + (p/knee)²))
  double hardening_knee_rad = kInfinity;  ///< infinite: a cubic spring
};

struct CommandEffects {
  AngleHarmonic ripple;                ///< Km·u·(1 + ripple)
  double saturation_knee = kInfinity;  ///< knee·tanh(u/knee) [unit of u]
  double dead_zone = 0.0;              ///< half width [unit of u], subtracted beyond
  double delay_s = 0.0;
  double lag_s = 0.0;      ///< time constant of a first-order torque loop
  double jitter_s = 0.0;   ///< every update late by a uniform share of it, < sample (outside the catalogue)
  double noise = 0.0;      ///< rms of what is added to every command, unrecorded (outside the catalogue)
  double sag_per_w = 0.0;  ///< torque·(1 + sag·P/n)^−n under the power P > 0 that the motor gives [1/W]
  double sag_exponent = 1.0;  ///< n
  double wander_ratio = 0.0;  ///< torque·(1 − ratio·(1 − cos(2π·t/period))/2) (outside the catalogue)
  double wander_period_s = 2.0;
};

struct SensorEffects {
  double eccentricity_rad = 0.0;  ///< x1 + e·sin(N·x1 + φ)
  double eccentricity_phase_rad = 0.0;
  double eccentricity_periods = 1.0;  ///< N
  double quantum_rad = 0.0;           ///< the real quantum where it is coarser than that of the sheet
  double lag_s = 0.0;                 ///< first-order filter on the angle
  int lost_count_times = 0;           ///< how often counts are lost (outside the catalogue)
  int lost_counts = 0;                ///< how many each time; the sign is drawn
};

/// What no effect of the catalogue is, beside what the sides above have of it. The first three are functions
/// of speed, position and input; the next three are made of two quantities, the last two are of time.
struct OutsideEffects {
  double hump_nm = 0.0;  ///< −hump·y·exp((1 − y²)/2), y = w1/hump_speed: a friction with a maximum
  double hump_speed_rad_s = 1.0;  ///< where that is
  double cable_nm = 0.0;          ///< −cable·sinh(3y)/sinh(3), y = (x1 − cable_from)/cable_reach
  double cable_from_rad = 0.0;
  double cable_reach_rad = 1.0;
  double one_sided_gain = 0.0;          ///< u·(1 + gain·tanh(u/gain_input))
  double gain_input = 1.0;              ///< [unit of u]
  double weak_speed_rad_s = kInfinity;  ///< torque/(1 + (w1/weak_speed)²)
  double tight_nm = 0.0;  ///< −tight·tanh(w1/tight_speed)·(1 + sin(x1 + φ))/2: friction over the angle
  double tight_speed_rad_s = 1.0;
  double tight_phase_rad = 0.0;
  AngleHarmonic worn{};  ///< −worn·(t/worn_time)²: detents that come with time
  double worn_time_s = 1.0;
  double stray_nm = 0.0;  ///< stray·sin(2π·stray_hz·t + φ) on the motor
  double stray_hz = 1.0;
  double stray_phase_rad = 0.0;
  double snag_nm = 0.0;  ///< snag·(1 + tanh((t − snag_time)/snag_rise))/2 on the motor
  double snag_time_s = 0.0;
  double snag_rise_s = 0.1;
};

struct Effects {
  MotorEffects motor;
  LoadEffects load;
  ContactEffects contact;
  CommandEffects command;
  SensorEffects sensor;
  OutsideEffects outside;
};

}  // namespace gapscope::independent_plant
