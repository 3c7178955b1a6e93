#pragma once

#include <algorithm>
#include <vector>

#include "base/require.h"
#include "plant/impact.h"
#include "simulation/guards.h"
#include "simulation/transition.h"

namespace gapscope::internal::simulation {

constexpr int kMostEventsPerSample = 2000;

/// A rigid contact whose next bounce would last less than this share of a sample stays closed: the height of
/// such a bounce, a quarter of its duration times its speed, is far below any encoder.
constexpr double kShortestBounce = 1e-3;

/// A dying torque divides a sample into at most so many pieces.
constexpr double kMostDecayPieces = 128.0;

/// Inputs that come closer than this share of a mean step share one place in what a delay holds back.
constexpr double kShortestStep = 1.0 / 64.0;

/// Passes by which the torques of smooth effects are brought in line with the motion that they cause.
constexpr int kCorrections = 2;

/// What the smooth effects add at one point.
template <class T>
struct Extra {
  T motor{}, load{}, half_gap{}, contact{};
};

struct Acting;

/// Modes that have a flow of their own: contact or none (where the gears rub, either side of it), load and
/// motor that slip or stick, and in which direction the motor goes.
constexpr int kFlows = 18;
inline int flow_index(const ContactMode& mode, bool gears_rub) {
  return (mode.contact == 0               ? 0
          : mode.contact < 0 && gears_rub ? 12
                                          : 6) +
         (mode.load != 0 ? 3 : 0) + (mode.motor + 1);
}

template <class T>
struct StepperImpl {
  // --- what does not change from sample to sample
  PlantModel<T> model;
  FlowConstants<T> f;
  double dt = 0.0;
  bool has_load = true, locked = false, load_friction = true, motor_friction = false;
  bool reads_load = false;                      ///< the encoder is on the load
  bool smooth = false;                          ///< an effect adds torque or gap
  bool adds_torque = false, moves_gap = false;  ///< which of both
  bool remembers = false;                       ///< an effect has memory
  bool varies_inertia = false;                  ///< an effect changes the inertia
  bool delayed = false;                         ///< an effect delays the input
  int decaying = -1;                            ///< effect with a dying torque; −1: none
  T decay_share{1.0};                           ///< of its amplitude, where its rate had to be limited
  T half_gap{};
  double inverse_m1 = 0.0, inverse_m2 = 0.0;  ///< of f, for the guards
  T delay{};                                  ///< of the input [s]
  T delay_rest{};             ///< part of a sample in which the older of two inputs still acts [s]
  std::vector<T> inputs;      ///< ring of the last inputs, as long as the delay needs
  std::vector<double> given;  ///< of steps of their own length: when each of them came [s]
  std::vector<T> memory;      ///< kMostEffectMemory per effect

  // --- the state
  DriveState<T> z;
  ContactMode mode;
  T now{};     ///< [s]
  T torque{};  ///< Km u in force [N m]
  T inertia_factor{1.0};
  std::size_t newest = 0;  ///< place of the newest input in the ring
  std::size_t acting = 0;  ///< of steps of their own length: place of the input that acts
  double clock = 0.0;      ///< of steps of their own length: time since the first one [s]
  bool started = false;    ///< the first input has been seen
  int touching_side = 0;   ///< side of an open contact whose guard starts at zero
  int contact_zeros = 0, load_zeros = 0, motor_zeros = 0;  ///< see Guard::zeros
  bool closed = false;
  bool healthy = true;
  long events = 0;
  long smooth_pieces = 0;  ///< along which smooth effects were followed
  /// Of each segment of a sample (two with a delay), each mode, and how often its pieces are halved.
  StateTransition<T> transitions[2][kFlows][kMostHalvings + 1];
  StateTransition<T> own_transition;  ///< of a step of its own length

  StepperImpl(const PlantModel<T>& m, double step, double shortest);

  // --- where things stand: stepper_state.h
  void set_decay();
  void reset(const DriveState<T>& state);
  void inject(const T& dx, const T& dw);
  T measured() const;
  DriveState<T> seen_by(const ActiveEffect<T>& effect, const DriveState<T>& state) const;
  double side_distance(int side) const;  ///< s δ − β [rad]
  T contact_torque(int side) const;      ///< of a closed rigid contact the holding torque
  T acting_torque() const { return mode.contact != 0 ? contact_torque(mode.contact) : T(0.0); }
  const T& motor_level(int direction) const {
    return direction < 0 ? model.motor_friction_minus : model.motor_friction_plus;
  }
  /// The level that a motor at rest overcomes, with what the gears add to it.
  T breaking_level(int direction, const Forcing<T>& on) const;

  // --- effects: stepper_effects.h
  EffectPoint<T> point(const DriveState<T>& state, const T& time, std::size_t effect) const;
  T dying_torque() const;
  T beyond_spring(const T& penetration, const T& speed) const;
  T rubbed_off(const DriveState<T>& state, const T& time, const T& extra) const;
  Extra<T> extra_at(const DriveState<T>& state, const T& time) const;
  Forcing<T> forcing_without_effects() const;
  Forcing<T> forcing_now() const;  ///< constant terms only, effects included
  void bend(Forcing<T>& on, const Extra<T>& start, const Extra<T>& middle, const Extra<T>& end,
            const T& inverse_h) const;
  double effect_rate() const;
  void remember_start();
  void advance_memory(const DriveState<T>& to, const T& end_time);
  void set_input(const T& u);
  void set_inertia(double span);

  // --- one sample: stepper_sample.h
  void begin(const T& u);
  void end();
  void step(const T& u);
  void segment(const T& span, const T& u, int index);
  void follow(const StateTransition<T>& whole, const T& span);
  StateTransition<T>& transition(const T& span, int index, int times_halved);
  int halvings(double h) const;
  void respond(const StateTransition<T>& step, const Forcing<T>& on, DriveState<T>& next) const;
  Forcing<T> with_hardening(Forcing<T> on) const;
  void respond_to_slopes(const StateTransition<T>& step, const Forcing<T>& on, DriveState<T>& next) const;
  void advance_smoothly(const StateTransition<T>& step, Forcing<T>& on, DriveState<T>& next) const;
  void accept(const DriveState<T>& next, const T& h);
  void advance(T span);
  void build_series(const T& h, int rough_order, PowerSeries<T>& series, Forcing<T>& on) const;

  // --- a sample of its own length: stepper_uneven.h
  void step(const T& u, double span);
  void delayed_inputs(const T& u, double span);
  void uneven_segment(const T& span, const T& u);
  void flow_for(const T& span);

  // --- whether an event may lie in a step: stepper_outlook.h
  bool may_leave(const DriveState<T>& next, const Acting& at_start, const Acting& at_end, double h) const;

  // --- events: stepper_events.h
  void collect(const PowerSeries<T>& series, const Forcing<T>& on, GuardSet& set) const;
  template <class Use>
  void with_terms(const Guard& guard, const PowerSeries<T>& flow, const Forcing<T>& on, const Use& use) const;
  T motor_coefficient(const Forcing<T>& on, int n) const;
  T polished(const Guard& guard, const PowerSeries<T>& series, const Forcing<T>& on, double time) const;
  void cross(const Guard& guard);
  void open(int side);
  void close(int side);
  void bounce(int side);
  void resolve_at_input_change();
  void resolve_contact();
  void resolve_load();
  void resolve_motor();
  void resolve_as_one();
  void forget_zeros() { contact_zeros = load_zeros = motor_zeros = touching_side = 0; }
};

inline int direction_of(double v) { return v > 0.0 ? 1 : v < 0.0 ? -1 : 0; }

}  // namespace gapscope::internal::simulation
