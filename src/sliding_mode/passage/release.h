#pragma once

#include <cstddef>

namespace gapscope::internal::sliding_mode {

struct PassageContext;
struct ImpactTime;
class FlightLaw;

/// Where x1 turned round before an impact.
struct Reversal {
  int direction = 0;      ///< of the passage that follows
  std::size_t first = 0;  ///< first sample of the stay at the extremum, within the encoder's resolution
  std::size_t last = 0;   ///< last extreme sample
  double position = 0.0;  ///< extreme x1 [rad]
  double rise = 0.0;      ///< from there to the impact [rad]
};

/// The instant at which contact was lost, and what the load does after it.
struct Release {
  bool found = false;
  bool dwell = false;              ///< the motor rested at it: the load does not move
  double time = 0.0;               ///< t1 [samples]
  double first = 0.0, last = 0.0;  ///< that fit almost as well [samples]
  double position = 0.0;           ///< x1(t1) [rad]
  double load_travel = 0.0;        ///< s, against the passage, between t1 and t2 [rad]
  double travel_half_width = 0.0;  ///< of s [rad]
  bool far_flank = true;           ///< the contact before t1 was with the flank that the passage leaves
  double contradiction = 0.0;      ///< of the gap, by the state just before t1 and that just after it [rad]
  /// Speed of both along the passage at t1, the least that the time around it allows [rad/s].
  double along = 0.0;
  bool passive = true;      ///< the load slowed down when it was released
  double half_width = 0.0;  ///< of the gap, from t1 and s together [rad]
};

/// Travel of a passive load from speed w and deceleration a within the time D, of which at first the share q
/// is viscous and the rest dry friction [rad, rad/s, rad/s², s].
double load_travel(double w, double a, double D, double q);

/// The load at rest: x1 dwells at the reversal and leaves along (t − t1)³ or (t − t1)². The load in motion:
/// at separation the contact torque is zero, so both bodies share speed w and deceleration a there, and a
/// passive load then travels between w²/2a (constant deceleration) and (w²/a)(1 − e^(−aD/w)) (viscous) within
/// D.
Release find_release(const PassageContext& context, const FlightLaw& law, const ImpactTime& impact);

}  // namespace gapscope::internal::sliding_mode
