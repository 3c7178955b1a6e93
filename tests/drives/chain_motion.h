#pragma once

#include <vector>

#include "drives/chain_dynamics.h"
#include "independent_plant/event_stepper.h"

namespace gapscope::independent_plant {

/// A contact of a joint was closed or lost.
struct JointEvent {
  double time = 0.0;  ///< [s]
  std::size_t joint = 0;
  bool closed = false;
  int flank = 1;  ///< +1: the body before pushes the next one forward
};

/// The chain moving through time, its events located as those of Motion are.
class ChainMotion {
 public:
  /// @param tolerance  local error per step of a position [rad]; speeds count a thousandfold in rad/s.
  ChainMotion(const ChainDynamics& dynamics, double tolerance);

  void hold(double command);  ///< acts from now on [unit of u]
  void advance(double t_end);

  double time() const { return now_.t; }
  const State& state() const { return now_.s; }
  const ChainRegime& regime() const { return regime_; }
  double energy() const { return dynamics_.stored_energy(now_.s, regime_); }
  const std::vector<JointEvent>& events() const { return events_; }
  long steps() const { return now_.steps; }

 private:
  template <int Size>
  void advance_sized(double t_end);
  void change_regime(int guard);
  void change_contact(std::size_t joint, bool second);
  void set_contact(std::size_t joint, Regime::Contact contact, int flank);

  const ChainDynamics& dynamics_;
  TimedState now_;
  ChainRegime regime_;
  double held_ = 0.0;
  std::vector<JointEvent> events_;
};

}  // namespace gapscope::independent_plant
