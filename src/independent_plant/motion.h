#pragma once

#include <vector>

#include "independent_plant/dynamics.h"
#include "independent_plant/event_stepper.h"

namespace gapscope::independent_plant {

/// A contact was closed or lost (its torque reached zero).
struct ContactEvent {
  double time = 0.0;  ///< [s]
  bool closed = false;
  int flank = 1;                                  ///< +1: the motor pushes the load forward
  double x1 = 0.0, w1 = 0.0, x2 = 0.0, w2 = 0.0;  ///< just before [rad, rad/s]
};

/// The drive moving through time: adaptive Dormand–Prince steps within a regime, and every change of regime
/// located to 1e-14 s by repeating the last step up to it (no grid, no interpolated states).
class Motion {
 public:
  /// @param tolerance  local error per step of a position [rad]; speeds count a thousandfold in rad/s.
  Motion(const Dynamics& dynamics, double tolerance);

  void hold(double command);  ///< acts from now on [unit of u]
  void advance(double t_end);

  double time() const { return now_.t; }
  const State& state() const { return now_.s; }
  const Regime& regime() const { return regime_; }
  int flank_in_contact() const;  ///< −1, 0, +1
  double energy() const { return dynamics_.stored_energy(now_.t, now_.s, regime_); }
  const std::vector<ContactEvent>& contact_events() const { return contact_events_; }
  long steps() const { return now_.steps; }

 private:
  void advance_smoothly(double t_end);
  template <int Size>
  void advance_sized(double t_end);
  void settle();
  void change_regime(int guard);
  void change_contact(int guard);
  void collide(int flank);
  void close(int flank);
  void open();
  void rest(int guard);
  void note(bool closed, int flank);

  const Dynamics& dynamics_;
  TimedState now_;
  Regime regime_;
  double held_ = 0.0;
  std::vector<ContactEvent> contact_events_;
  std::size_t next_kink_ = 0;
};

}  // namespace gapscope::independent_plant
