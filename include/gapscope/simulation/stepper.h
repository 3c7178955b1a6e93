#pragma once

#include <array>
#include <memory>

#include "gapscope/plant/effect_hooks.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

/// The discrete part of the state: which affine flow is active.
struct ContactMode {
  int contact = 0;  ///< closed contact: −1, +1; 0 open
  int outside = 0;  ///< open, but still beyond the gap's edge on this side (released under tension)
  int load = 1;     ///< 0 sticks, ±1 slips in that direction (only followed when the load has friction)
  int motor = 1;    ///< the same for the motor
  bool operator==(const ContactMode&) const = default;
};

namespace internal::simulation {
template <class T>
struct StepperImpl;
}

/// Advances the two-inertia drive from sample to sample, exactly:
///   m1 ẇ1 = Km u − d1 w1 − τc − Fc1 sign(w1),   m2 ẇ2 = τc − d2 w2 − Fc2 sign(w2)
///   τc = 0 while |δ| ≤ β, else k(δ ∓ β) + c δ̇, never pulling;   δ = x1 − x2
/// sign is set-valued at zero. Between events the drive is affine: a full sample is one precomputed
/// transition; closing and opening of the contact and every entry and exit of sticking are located by their
/// own Taylor polynomial and crossed with exact partial steps. With Jets each event time is polished by one
/// Newton step in Jet arithmetic, so that derivatives carry the jumps at events. u is held constant over a
/// sample. step() does not allocate. Steps of their own length follow the Taylor polynomials throughout.
template <class T>
class DriveStepper {
 public:
  /// @param dt sampling interval, of uneven sampling the mean one [s]
  /// @param shortest  of the steps to come, where they have their own lengths [s]; 0: all of dt. Of inputs
  /// that
  ///   come closer while a delay holds them back, the oldest is passed over.
  /// @throws std::logic_error unless inertias are positive and friction, stiffness and damping not negative.
  DriveStepper(const PlantModel<T>& model, double dt, double shortest = 0.0);
  ~DriveStepper();
  DriveStepper(DriveStepper&&) noexcept;
  DriveStepper& operator=(DriveStepper&&) noexcept;
  DriveStepper(const DriveStepper&);  ///< a twin that goes on from the same state, time and memory
  DriveStepper& operator=(const DriveStepper&);

  void reset(const DriveState<T>& state);

  /// One sample with input u [unit of u].
  void step(const T& u);
  /// One sample that lasts dt [s]. With a delayed input only a stepper that was told the shortest step takes
  /// these, and no others.
  void step(const T& u, double dt);

  /// Moves position and speed of the body with the encoder, the other one with it while in contact (output
  /// injection of an observer). A body that sticks keeps its speed of zero.
  void inject(const T& dx, const T& dw);

  const DriveState<T>& state() const;
  /// The position that the encoder would read without noise and resolution: with the sensing effects [rad].
  T measured() const;
  const ContactMode& mode() const;
  bool has_load() const;             ///< else it is one body, and mode() means nothing
  bool closed_in_last_step() const;  ///< a contact closed within the last sample
  long events() const;               ///< located since reset()
  long pieces() const;               ///< since reset(), along which smooth effects were followed
  /// False once the motion left the numbers that a double can hold, or events piled up at one instant.
  bool healthy() const;

 private:
  std::unique_ptr<internal::simulation::StepperImpl<T>> impl_;
};

/// The mode in which the last step ended, an impact where a contact closed within it; of one body kOneBody.
Mode mode_of(const DriveStepper<double>& stepper);

extern template class DriveStepper<double>;
extern template class DriveStepper<Jet<4>>;
extern template class DriveStepper<Jet<8>>;
extern template class DriveStepper<Jet<12>>;

}  // namespace gapscope
