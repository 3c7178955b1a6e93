#pragma once

#include <array>
#include <vector>

#include "independent_plant/drive.h"
#include "independent_plant/integrator.h"

namespace gapscope::independent_plant {

/// Between two events every set-valued part of the drive is in one of these regimes and the equations are
/// smooth.
struct Regime {
  enum class Contact : char {
    kOpen,     ///< in the gap
    kParting,  ///< let go, but still inside the undeformed flank: the damper would have to pull
    kClosed
  };
  Contact contact = Contact::kOpen;
  int flank = 1;  ///< of the last contact: +1 where the motor pushes the load forward
  int motor = 0;  ///< direction of the dry friction, 0: stuck
  int load = 0;
  bool operator==(const Regime&) const = default;
};

/// A torque pulse from outside on the motor.
struct Knock {
  double start_s = 0.0;
  double torque_nm = 0.0;
};

/// The guards of a regime, which all stay ≥ 0 while it lasts. Unused slots hold 1.
///   open     0: distance to the + flank [rad]   1: to the − flank
///   parting  0: pull of the contact law [N·m]   1: what is left of the overlap [rad]
///   closed   0: push + release torque [N·m]     (rigid: the largest push that friction at rest allows)
///   2, 3     load: speed along its direction; stuck: friction in reserve against + and − motion
///   4, 5     motor: the same. Two bodies in rigid contact move as one and use 2 and 3.
using Guards = std::array<double, 6>;

/// Right-hand side, guards and friction regimes of one drive. `held` is the command that acts at present.
class Dynamics {
 public:
  /// @throws std::logic_error for numbers that make no drive, or effects that a rigid contact does not have.
  Dynamics(const BlindDrive& drive, std::vector<Knock> knocks);

  State rates(double t, const State& s, const Regime& regime, double held) const;
  Guards guards(double t, const State& s, const Regime& regime, double held) const;

  /// Finds which bodies stick and where the moving ones go, given the contact. A rigid contact that cannot
  /// push is opened here.
  void settle_friction(double t, const State& s, Regime& regime, double held) const;

  /// Command to torque loop: dead zone, then saturation [unit of u].
  double shape_command(double u) const;
  double measured_angle(double x1) const;  ///< eccentricity of the encoder

  double half_gap(double t, double x2) const;                     ///< β [rad]
  double overlap(double t, const State& s, int flank) const;      ///< p = ±(x1 − x2) − β [rad]
  double contact_law(double t, const State& s, int flank) const;  ///< k·p ± c·(w1 − w2), may pull [N·m]
  /// τc, compliant and bonded only.
  double contact_torque(double t, const State& s, const Regime& regime) const;

  /// Kinetic energy and that of the contact spring while it is pressed; no resonator [J].
  double stored_energy(double t, const State& s, const Regime& regime) const;

  bool is_rigid() const { return drive_.load != BlindLoad::kNone && drive_.contact == ContactKind::kRigid; }
  bool has_contact_events() const {
    return drive_.load != BlindLoad::kNone && drive_.contact != ContactKind::kBonded;
  }
  bool has_hidden_states() const { return hidden_states_; }
  const std::vector<double>& kinks() const {
    return kinks_;
  }  ///< times at which a law in t is not smooth [s]
  const BlindDrive& drive() const { return drive_; }
  double load_inertia(double t) const;   ///< m2 at t; infinite when locked [kg·m²]
  double motor_inertia(double t) const;  ///< m1; with one inertia it carries the load's variation

 private:
  bool is_joined(const Regime& r) const { return is_rigid() && r.contact == Regime::Contact::kClosed; }
  double motor_drive(double t, const State& s, int direction, double held) const;
  double load_on_one_body(const State& s) const;  ///< 0 where there are two
  double load_drive(const State& s) const;
  double load_torques(double x, double w, const State& s) const;
  /// @param gear_torque what the gears carry [N·m]
  double motor_level(int direction, double w, double gear_torque) const;
  double load_level() const;
  double gears_of_one_body(double drive, double w, int direction) const;
  void joined_rates(double t, const State& s, const Regime& r, double held, State& rate) const;
  double joined_push(double t, const State& s, const Regime& r, double held) const;
  void hidden_rates(const State& s, double held, State& rate) const;

  BlindDrive drive_;
  std::vector<Knock> knocks_;
  std::vector<double> kinks_;
  bool motor_signed_, load_signed_, hidden_states_;
};

}  // namespace gapscope::independent_plant
