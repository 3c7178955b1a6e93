#pragma once

#include <array>
#include <vector>

#include "independent_plant/dynamics.h"

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

  double time() const { return t_; }
  const State& state() const { return s_; }
  const Regime& regime() const { return regime_; }
  int flank_in_contact() const;  ///< −1, 0, +1
  double energy() const { return dynamics_.stored_energy(t_, s_, regime_); }
  const std::vector<ContactEvent>& contact_events() const { return contact_events_; }
  long steps() const { return steps_; }

 private:
  /// Shares of a step at which the guards are looked at.
  static constexpr std::array kSamples{0.0, 0.07, 0.3, 0.5, 0.7, 0.93, 1.0};
  struct Crossing {
    int guard = -1;
    double theta = 1.0;  ///< share of the step
  };
  struct Bracket {
    double low, high;  ///< shares of the step: guard ≥ 0, guard < 0
  };

  void advance_smoothly(double t_end);
  template <int Size>
  void advance_sized(double t_end);
  bool adapt_step(double error, double h);
  template <class Step>
  Crossing first_crossing(const Step& step, double h) const;
  template <class Step>
  Bracket find_bracket(int i, const std::array<Guards, kSamples.size()>& g, const Step& step, double h) const;
  template <class Step>
  double locate(int guard, Bracket bracket, double h, const Step& step) const;
  void settle();
  void change_regime(int guard);
  void change_contact(int guard);
  void collide(int flank);
  void close(int flank);
  void open();
  void rest(int guard);
  void note(bool closed, int flank);

  const Dynamics& dynamics_;
  State tolerance_{};
  State s_{};
  Regime regime_;
  double t_ = 0.0, h_ = 1e-5, held_ = 0.0;
  std::vector<ContactEvent> contact_events_;
  std::size_t next_kink_ = 0;
  long steps_ = 0;
};

}  // namespace gapscope::independent_plant
