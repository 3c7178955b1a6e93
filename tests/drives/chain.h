#pragma once

#include <vector>

#include "independent_plant/integrator.h"

/// Drives of other laws than those that are fitted: up to three bodies in a chain, joints with play between
/// neighbours. What a law is not asked for is zero.
namespace gapscope::independent_plant {

/// How strongly dry friction can resist at a speed:
///   coulomb + (breakaway − coulomb)·exp(−(|w|/v)^exponent),   v = stribeck_speed
struct FrictionLevel {
  double coulomb_nm = 0.0;            ///< [N·m]
  double breakaway_nm = 0.0;          ///< at rest; below Coulomb's: the same as Coulomb's [N·m]
  double stribeck_speed_rad_s = 0.1;  ///< [rad/s]
  double stribeck_exponent = 2.0;     ///< [-]
  double at(double w) const;          ///< [N·m]
  void scale(double factor);          ///< both torques
  bool any() const { return coulomb_nm > 0.0 || breakaway_nm > 0.0; }
};

/// A mass, its bearing and what pulls at it:
///   m·ẇ = τ − d·w − friction + torque,   τ of the joints and, of the first one, Km·u
/// Friction is set-valued at rest or, with a bristle length, LuGre's: with σ0 = coulomb/length
///   ż = w − σ0·|w|·z/level(w),   friction = σ0·z + bristle_damping·ż
struct ChainBody {
  double inertia = 8.78e-4;  ///< [kg·m²]
  double damping = 0.0;      ///< [N·m·s/rad]
  FrictionLevel friction;
  double bristle_length_rad = 0.0;   ///< 0: no bristles [rad]
  double bristle_damping_nms = 0.0;  ///< [N·m·s/rad]
  double torque_nm = 0.0;            ///< from outside, such as of gravity [N·m]
  double x = 0.0, w = 0.0;           ///< at the start [rad, rad/s]
  bool has_bristles() const { return bristle_length_rad > 0.0; }
  bool has_dry_friction() const { return !has_bristles() && friction.any(); }
};

/// What joins a body to the next one. Beyond the gap, with p = ±(x − x') − β(x') > 0 and ṗ = ±(w − w'):
///   push = k·pⁿ + k3·p³ + (c + h·pⁿ)·ṗ,   which does not pull but by what holds the faces together.
/// n = 1: spring and damper; k3: hardening; n = 1.5 and h alone: Hunt and Crossley. Without a gap the same
/// law pulls and pushes about zero.
///   β(x') = gap/2·(1 + share·cos(2π·x'/period + φ))
struct ChainJoint {
  double gap = 0.0;                 ///< mean 2β [rad]
  double gap_share = 0.0;           ///< by which it varies [-]
  double gap_period_rad = 1.0;      ///< [rad]
  double gap_phase_rad = 0.0;       ///< [rad]
  double stiffness = 200.0;         ///< k [N·m/radⁿ]
  double exponent = 1.0;            ///< n [-]
  double cubic = 0.0;               ///< k3 [N·m/rad³]
  double damping = 0.0;             ///< c [N·m·s/rad]
  double impact_damping = 0.0;      ///< h [N·m·s/radⁿ⁺¹]
  double release_nm = 0.0;          ///< pull that a closed contact bears before it lets go [N·m]
  double grease_nms = 0.0;          ///< drag between the sides while the gap is open [N·m·s/rad]
  double half_gap(double x) const;  ///< β [rad]
  bool is_bonded() const { return gap == 0.0; }

  double push(double p, double rate) const;  ///< odd in p and rate together [N·m]
  /// Has the sign of push + release where p > 0, and never touches zero without crossing it.
  double grip(double p, double rate) const;
  /// Whether push ends with p alone, so that a contact at p = 0 has no torque.
  bool ends_with_overlap() const { return damping == 0.0 && release_nm == 0.0; }
  double energy(double p) const;  ///< of the spring [J]
};

struct ChainDrive {
  double torque_constant = 0.172;  ///< Km [N·m per unit of u]
  std::vector<ChainBody> bodies;   ///< the motor first, the load last
  std::vector<ChainJoint> joints;  ///< one fewer
  ChainBody& motor() { return bodies.front(); }
  ChainBody& load() { return bodies.back(); }
  const ChainBody& motor() const { return bodies.front(); }
  const ChainBody& load() const { return bodies.back(); }
};

constexpr int kMostBodies = 3, kMostJoints = 2;

/// Places in the state of what a body has.
constexpr std::size_t angle_of(std::size_t body) { return 2 * body; }
constexpr std::size_t speed_of(std::size_t body) { return 2 * body + 1; }
constexpr std::size_t bristle_of(std::size_t body) { return 2 * kMostBodies + body; }
static_assert(bristle_of(kMostBodies - 1) < static_cast<std::size_t>(kStateSize));

/// @throws std::logic_error for numbers that make no drive.
void require_sound(const ChainDrive& drive);

}  // namespace gapscope::independent_plant
