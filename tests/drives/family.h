#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "drives/chain_run.h"

namespace gapscope::independent_plant {

/// Everything that makes one recording of a chain.
struct ChainCase {
  std::string family;
  ChainDrive drive;
  std::variant<BlindExcitation, PositionTask> task;
  double torque_nm = 0.1;       ///< friction is drawn in shares of it; of a torque input its amplitude [N·m]
  double least_travel = 1.5;    ///< of the motor, peak to peak [gaps]
  double wanted_travel = kNaN;  ///< the same, met; NaN: there is no such wish [gaps]
  double nominal_gap = 0.0;     ///< that it is known for; its gap, but where that has been closed [rad]
  BlindSensor sensor;
  BlindOptions options;
};

ChainRun simulate_chain(const ChainCase& c);

/// Families of drives by fixed laws, most of which no estimator knows. All but what is told of each:
///   m1 log-uniform 0.3–3 g·m²; m2/m1 log-uniform 0.1–10; Km log-uniform 0.05–1 N·m per unit of u;
///   torque amplitude uniform 57–228 N·m for each kg·m² of m1 (0.05–0.2 N·m of the paper's motor);
///   d1/m1 log-uniform 14–140/s, d2/m1 8–80/s; gap log-uniform 5–50 mrad, the load anywhere in it;
///   linear contact, k/m1 log-uniform 6e4–6e6/s², damping ratio uniform 0.05–0.4;
///   Coulomb friction of the load uniform 2–60 % of the torque, of every second motor 2–20 %;
///   sine, triangle, trapezoid or multisine of four harmonics, uniform 0.5–3 Hz, 8–12 periods, raised
///   in steps of 25 % (all friction with it) until the motor travels 1.5 gaps;
///   0.5, 1, 2, 2.5, 5 or 10 kHz; 12, 14, 16, 18 or 20 bit, of these those with 40 quanta in the gap;
///   every second encoder with noise of 0.3–1.5 quanta.
///
/// as_model            no more than that
/// low_travel          travel of 1.2–4 gaps, load friction 60–98 % of the torque; a third of them with
///                     adhesion of 20–90 % of it, a third need 1.05–1.5 times the friction to break
///                     away; sine or triangle, 0.5–1.5 Hz, 16, 18 or 20 bit without noise
/// hunt_crossley       push pⁿ·(k + h·ṗ), n = 1.5, as stiff as above at the torque, h/k log-uniform
///                     0.02–0.2 s/rad
/// soft_hunt_crossley  the same, k of the linear contact twenty times softer
/// hardening           k·p + k3·p³, the second 0.5–10 times the first at the torque
/// stribeck_load       breakaway 1.1–2 times the load's Coulomb friction, below 98 % of the torque,
///                     Stribeck speed log-uniform 0.02–1 rad/s
/// lugre               bristles of the load and of motors that rub, 1–30 % of the gap long, breakaway
///                     1–1.5 times Coulomb's
/// grease              drag of 34–400 N·m·s/rad for each kg·m² of m1 while the gap is open
/// two_gaps            a body of 0.1–1 m1 between; both joints drawn as the first, 5–30 mrad each
/// slow_position       PD position loop of 2–12 Hz on the encoder at 0.05–0.2 Hz over 4–40 gaps, 3–5
///                     periods, 0.1–2 kHz; every second with compensation of 0.5–1.5 times the gap
/// pd_joint            the same at 0.3–2 Hz over 3–20 gaps of 10–100 mrad, 0.5–2 kHz; a load that
///                     coasts: m2/m1 1–20, friction 0.2–5 % of the torque, a tenth of the damping
/// heavy_wide          m2/m1 10–60, gap 50–150 mrad, sine or triangle, 0.2–1 Hz, 0.1–2 kHz
/// varying_gap         gap·(1 + share·cos(2π·x2/period)), share 10–60 %, period 0.05–2π rad
/// belt                k twenty times softer, damping ratio 0.02–0.2; without its gap it is a belt
/// gravity_shut        a pd_joint with gravity on its load, raised until the contact never opens
/// high_friction       the load rubs with 60–98 % of the torque or, as often, the motor with 40–90 %;
///                     half of them need 1.05–1.5 times that to break away
const std::vector<std::string>& family_names();

/// @param gap_free  the same drive and the same task with its gaps closed; the joint pulls as it pushes then
/// @throws std::logic_error for a family that is not there.
ChainCase draw_family(const std::string& family, std::uint64_t seed, bool gap_free = false);

/// Smallest and largest gap of a drive over its turn, and the same of its first joint [rad].
Interval total_gap(const ChainDrive& drive);
Interval first_gap(const ChainDrive& drive);

/// What a data sheet has of a chain, as two bodies with a linear contact: every number but motor inertia and
/// torque constant off by a uniform share of up to `spread`.
struct ChainSheet {
  double motor_inertia = 0.0, torque_constant = 0.0;
  double motor_damping = 0.0, motor_coulomb = 0.0;
  double mass_ratio = 0.0, gap = 0.0, load_damping = 0.0, load_coulomb = 0.0;
  double contact_stiffness = 0.0;  ///< over the overlap at the torque of the case [N·m/rad]
  double contact_damping = 0.0;    ///< at half of that overlap [N·m·s/rad]
};
ChainSheet chain_sheet(const ChainCase& c, double spread = 0.2);

}  // namespace gapscope::independent_plant
