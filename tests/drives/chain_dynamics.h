#pragma once

#include <array>

#include "drives/chain.h"
#include "independent_plant/dynamics.h"

namespace gapscope::independent_plant {

/// In what regime each joint and each body is between two events.
struct ChainRegime {
  std::array<Regime::Contact, kMostJoints> contact{};  ///< joints without a gap are closed for good
  std::array<int, kMostJoints> flank{1, 1};            ///< of the last contact
  std::array<int, kMostBodies> direction{};            ///< of the dry friction; 0: stuck
};

/// The guards of a regime, two for each joint, then two for each body; unused slots hold 1.
///   open     distance to the + flank, to the − flank [rad]
///   parting  pull of the contact law, what is left of the overlap [rad]
///   closed   grip of the contact law; the overlap, where the push ends with it [rad]
///   moving   speed along its direction [rad/s]
///   stuck    friction in reserve against + and − motion [N·m]
using ChainGuards = std::array<double, 2 * (kMostJoints + kMostBodies)>;
constexpr int kFirstBodyGuard = 2 * kMostJoints;

/// Right-hand side, guards and friction regimes of a chain. `held` is the command that acts at present.
class ChainDynamics {
 public:
  /// @throws std::logic_error for numbers that make no drive.
  explicit ChainDynamics(const ChainDrive& drive);

  State rates(const State& s, const ChainRegime& regime, double held) const;
  ChainGuards guards(const State& s, const ChainRegime& regime, double held) const;

  /// Finds which bodies stick and where the moving ones go, given the contacts.
  void settle_friction(const State& s, ChainRegime& regime, double held) const;

  double overlap(const State& s, std::size_t joint, int flank) const;  ///< p = ±(x − x') − β(x') [rad]
  /// What a joint takes from its body and gives to the next [N·m].
  double joint_torque(const State& s, std::size_t joint, const ChainRegime& regime) const;
  /// Kinetic energy, that of pressed contacts and of bent bristles [J].
  double stored_energy(const State& s, const ChainRegime& regime) const;

  const ChainDrive& drive() const { return drive_; }
  bool is_small() const { return small_; }  ///< two bodies without bristles: four numbers are its state

 private:
  /// All torques on a body but its set-valued friction [N·m].
  double torque_on(std::size_t body, const State& s, const ChainRegime& regime, double held) const;
  double bristle_rate(std::size_t body, const State& s) const;
  void joint_guards(std::size_t joint, const State& s, const ChainRegime& regime, double* guards) const;

  ChainDrive drive_;
  bool small_ = true;
};

}  // namespace gapscope::independent_plant
