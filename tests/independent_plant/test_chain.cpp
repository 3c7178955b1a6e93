#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drives/chain_run.h"

namespace gapscope::independent_plant {
namespace {

constexpr double kTight = 1e-12;

/// Two bodies of 1 and 3 g·m² in the middle of a gap of 20 mrad, without any losses.
ChainDrive two_bodies() {
  ChainDrive d;
  d.torque_constant = 1.0;
  d.bodies.resize(2);
  d.motor().inertia = 1e-3, d.load().inertia = 3e-3;
  d.joints.resize(1);
  d.joints[0].gap = 0.02;
  return d;
}

/// A body between the two.
ChainBody& body_between(ChainDrive& d) {
  d.bodies.emplace(d.bodies.begin() + 1);
  d.bodies[1].inertia = 5e-4;
  return d.bodies[1];
}

double reduced_inertia(const ChainDrive& d) {
  return d.motor().inertia * d.load().inertia / (d.motor().inertia + d.load().inertia);
}

ChainMotion moved(const ChainDynamics& dynamics, double u, double until) {
  ChainMotion motion(dynamics, kTight);
  motion.hold(u);
  motion.advance(until);
  return motion;
}

double relative_speed(const ChainMotion& m) { return m.state()[speed_of(0)] - m.state()[speed_of(1)]; }

/// The largest overlap of a first impact, and what it lasts, seen on a fine grid.
struct FirstImpact {
  double deepest = 0.0, lasts = 0.0, leaves = 0.0;  ///< [rad], [s], share of the speed
};

FirstImpact first_impact(ChainDrive d, double speed) {
  d.motor().w = speed;
  d.motor().x = 0.5 * d.joints[0].gap;
  const ChainDynamics dynamics(d);
  ChainMotion motion(dynamics, kTight);
  FirstImpact impact;
  for (int k = 1; motion.events().size() < 2; ++k) {
    motion.advance(1e-6 * k);
    impact.deepest = std::max(impact.deepest, dynamics.overlap(motion.state(), 0, 1));
  }
  impact.lasts = motion.events()[1].time - motion.events()[0].time;
  impact.leaves = -relative_speed(motion) / speed;
  EXPECT_NEAR(
      d.motor().inertia * motion.state()[speed_of(0)] + d.load().inertia * motion.state()[speed_of(1)],
      d.motor().inertia * speed, 1e-11);
  return impact;
}

TEST(Chain, IsTheOtherPlantWhereTheirLawsAreTheSame) {
  BlindDrive blind;
  blind.effects.motor.friction.level_nm = 0.01;
  blind.effects.contact.release_nm = 0.02;
  ChainDrive d = two_bodies();
  d.torque_constant = blind.torque_constant;
  d.motor().inertia = blind.motor_inertia, d.motor().damping = blind.motor_damping;
  d.motor().friction.coulomb_nm = 0.01;
  d.load().inertia = blind.load_inertia, d.load().damping = blind.load_damping;
  d.load().friction.coulomb_nm = blind.load_coulomb;
  d.joints[0].gap = blind.gap;
  d.joints[0].stiffness = blind.contact_stiffness, d.joints[0].damping = blind.contact_damping;
  d.joints[0].release_nm = 0.02;
  const BlindOptions options{.rate = 1000.0, .duration = 3.0};
  const BlindRun one = simulate_blind(blind, {}, {}, options);
  const ChainRun other = simulate_chain(d, torque_input({}, options), {}, options);
  ASSERT_EQ(one.truth.x1.size(), other.x1.size());
  EXPECT_EQ(one.truth.contact_events.size(), other.events.size());
  for (std::size_t k = 0; k < other.x1.size(); ++k) {
    ASSERT_NEAR(one.truth.x1[k], other.x1[k], 1e-10) << k;
    ASSERT_NEAR(one.truth.x2[k], other.recording.x2[k], 1e-10) << k;
  }
}

TEST(Chain, SpheresPressAsDeepAndAsLongAsHertzSays) {
  ChainDrive d = two_bodies();
  d.joints[0].exponent = 1.5, d.joints[0].stiffness = 5e3;
  const double speed = 2.0;
  const FirstImpact impact = first_impact(d, speed);
  const double deepest = std::pow(1.25 * reduced_inertia(d) * speed * speed / d.joints[0].stiffness, 0.4);
  EXPECT_NEAR(impact.deepest, deepest, 1e-6 * deepest);
  EXPECT_NEAR(impact.lasts, 2.94328 * deepest / speed, 1e-5 * impact.lasts);
  EXPECT_NEAR(impact.leaves, 1.0, 1e-7);
}

/// Hunt and Crossley's relation: with r = h/k, (1 + e)·v·r = ln((1 + r·v)/(1 − r·e·v)).
TEST(Chain, HuntCrossleyDampingTakesWhatItsClosedFormSays) {
  for (const double speed : {0.5, 3.0}) {
    ChainDrive d = two_bodies();
    d.joints[0].exponent = 1.5, d.joints[0].stiffness = 5e3;
    d.joints[0].impact_damping = 0.1 * d.joints[0].stiffness;
    const double e = first_impact(d, speed).leaves, r = 0.1;
    EXPECT_NEAR((1.0 + e) * speed * r, std::log((1.0 + r * speed) / (1.0 - r * e * speed)), 1e-6);
    EXPECT_LT(e, 1.0 - 0.5 * r * speed / 1.5);
  }
}

TEST(Chain, HardeningSpringStopsWhereItsEnergyIsThatOfTheImpact) {
  ChainDrive d = two_bodies();
  ChainJoint& j = d.joints[0];
  j.cubic = 4e6;
  const double energy = 0.5 * reduced_inertia(d) * 9.0;
  const double square =
      (-j.stiffness + std::sqrt(j.stiffness * j.stiffness + 4.0 * j.cubic * energy)) / j.cubic;
  EXPECT_NEAR(first_impact(d, 3.0).deepest, std::sqrt(square), 1e-8);
}

TEST(Chain, GreaseSlowsBothSidesTowardsOneSpeed) {
  ChainDrive d = two_bodies();
  d.joints[0].gap = 10.0, d.joints[0].grease_nms = 0.02;
  d.motor().w = 2.0;
  const ChainDynamics dynamics(d);
  const ChainMotion motion = moved(dynamics, 0.0, 0.05);
  EXPECT_NEAR(relative_speed(motion), 2.0 * std::exp(-0.02 / reduced_inertia(d) * 0.05), 1e-8);
  EXPECT_NEAR(motion.state()[speed_of(0)] + 3.0 * motion.state()[speed_of(1)], 2.0, 1e-8);
  EXPECT_TRUE(motion.events().empty());
}

TEST(Chain, FacesThatStickLetGoAtTheirPull) {
  ChainDrive d = two_bodies();
  d.motor().damping = 0.05, d.load().friction.coulomb_nm = 1.0;
  d.joints[0].damping = 0.05, d.joints[0].release_nm = 0.1;
  const ChainDynamics dynamics(d);
  ChainMotion motion = moved(dynamics, 0.05, 1.0);
  const auto pull = [&](double from, double to) {  // slowly
    for (int k = 0; k <= 200; ++k) {
      motion.hold(from + (to - from) * k / 200.0);
      motion.advance(motion.time() + 0.01);
    }
  };
  pull(0.05, -0.099);
  EXPECT_EQ(motion.events().back().closed, true);
  EXPECT_GT(motion.state()[angle_of(0)], 0.0);
  pull(-0.099, -0.105);
  EXPECT_NEAR(motion.state()[angle_of(0)], -0.01 - 0.105 / 200.0, 1e-6);  // at the other flank
}

TEST(Chain, DryFrictionHoldsToItsBreakawayAndThenFallsWithTheSpeed) {
  ChainDrive d = two_bodies();
  d.joints[0].gap = 1e3;
  ChainBody& motor = d.motor();
  motor.damping = 0.02, motor.friction = {0.05, 0.1, 0.5, 2.0};
  const ChainDynamics dynamics(d);
  EXPECT_EQ(moved(dynamics, 0.0999, 1.0).state()[angle_of(0)], 0.0);
  const double w = moved(dynamics, 0.1001, 5.0).state()[speed_of(0)];
  EXPECT_NEAR(0.1001, motor.damping * w + motor.friction.at(w), 1e-9);
  EXPECT_NEAR(motor.friction.at(0.5), 0.05 + 0.05 * std::exp(-1.0), 1e-15);
}

TEST(Chain, BristlesAreASpringAtFirstAndTheLevelInTheEnd) {
  ChainDrive d = two_bodies();
  d.joints[0].gap = 1e3;
  ChainBody& motor = d.motor();
  motor.damping = 0.02, motor.friction = {0.05, 0.06, 0.5, 2.0};
  motor.bristle_length_rad = 1e-3, motor.bristle_damping_nms = 0.2;
  const ChainDynamics dynamics(d);
  const ChainMotion bent = moved(dynamics, 1e-4, 5.0);
  EXPECT_NEAR(bent.state()[bristle_of(0)], 1e-4 / 50.0, 1e-10);
  EXPECT_NEAR(bent.state()[angle_of(0)], 1e-4 / 50.0, 2e-8);  // a share of 2e-3 of the level is slip
  const double w = moved(dynamics, 0.1, 20.0).state()[speed_of(0)];
  EXPECT_NEAR(0.1, motor.damping * w + motor.friction.at(w), 1e-8);
}

/// Motor travel between rest on both sides under ± torque, with a load that does not move.
double play(ChainDrive d, double torque, double load_at) {
  d.motor().damping = 0.05;
  d.load().friction.coulomb_nm = 10.0;
  d.load().x = load_at;
  for (ChainBody& b : d.bodies) b.x = load_at;
  for (ChainJoint& j : d.joints) j.damping = 0.1;
  if (d.bodies.size() == 3) d.bodies[1].damping = 0.01;
  const ChainDynamics dynamics(d);
  ChainMotion motion = moved(dynamics, torque, 5.0);
  const double there = motion.state()[angle_of(0)];
  motion.hold(-torque);
  motion.advance(10.0);
  return there - motion.state()[angle_of(0)];
}

TEST(Chain, TwoGapsInSeriesAddUp) {
  ChainDrive d = two_bodies();
  body_between(d);
  d.joints.push_back({.gap = 0.013, .stiffness = 400.0});
  EXPECT_NEAR(play(d, 0.1, 0.0), 0.02 + 0.013 + 0.2 * (1.0 / 200.0 + 1.0 / 400.0), 1e-8);
}

TEST(Chain, GapThatVariesIsReadWhereTheLoadStands) {
  ChainDrive d = two_bodies();
  d.joints[0].gap_share = 0.4, d.joints[0].gap_period_rad = 0.5;
  EXPECT_NEAR(play(d, 0.1, 0.0), 0.02 * 1.4 + 0.2 / 200.0, 1e-9);
  EXPECT_NEAR(play(d, 0.1, 0.25), 0.02 * 0.6 + 0.2 / 200.0, 1e-9);
}

TEST(Chain, WithoutAGapTheJointSwingsAboutZero) {
  ChainDrive d = two_bodies();
  d.joints[0].gap = 0.0;
  d.motor().w = 1.0;
  const ChainDynamics dynamics(d);
  const double omega = std::sqrt(d.joints[0].stiffness / reduced_inertia(d));
  const ChainMotion motion = moved(dynamics, 0.0, 0.1);
  EXPECT_NEAR(motion.state()[angle_of(0)] - motion.state()[angle_of(1)], std::sin(0.1 * omega) / omega, 1e-9);
  EXPECT_TRUE(motion.events().empty());
}

TEST(Chain, LoadFallsThroughTheGapByItsOwnTorque) {
  ChainDrive d = two_bodies();
  d.motor().friction.coulomb_nm = 10.0;
  d.load().torque_nm = -0.03;
  const ChainDynamics dynamics(d);
  const ChainMotion motion = moved(dynamics, 0.0, 0.05);
  ASSERT_FALSE(motion.events().empty());
  EXPECT_NEAR(motion.events()[0].time, std::sqrt(2.0 * 0.01 / 10.0), 1e-10);
  EXPECT_EQ(motion.events()[0].flank, 1);
}

TEST(Chain, EnergyNeverGrowsAtZeroInput) {
  ChainDrive d = two_bodies();
  body_between(d).damping = 1e-4;
  d.joints.push_back({.gap = 0.01, .stiffness = 5e3, .exponent = 1.5, .impact_damping = 100.0});
  d.joints[0].cubic = 1e6, d.joints[0].damping = 0.01, d.joints[0].grease_nms = 1e-4;
  d.motor().friction = {1e-3, 2e-3, 0.2, 2.0};
  d.load().friction.coulomb_nm = 1e-3;
  d.load().bristle_length_rad = 2e-3, d.load().bristle_damping_nms = 1e-3;
  d.motor().w = 3.0, d.load().w = -1.0;
  const ChainDynamics dynamics(d);
  ChainMotion motion(dynamics, kTight);
  double last = motion.energy();
  for (int k = 1; k <= 20000; ++k) {
    motion.advance(5e-5 * k);
    ASSERT_LE(motion.energy(), last + 1e-11) << "at " << motion.time() << " s";
    last = motion.energy();
  }
  EXPECT_GT(motion.events().size(), 10u);
}

TEST(Chain, PositionLoopFollowsItsCourseAndLeadsByItsCompensation) {
  ChainDrive d = two_bodies();
  PositionTask task;
  task.course = {.course = Course::kTriangle, .travel = 1.0, .speed = 1.0, .dwell_s = 0.0};
  task.controller = {.rate = 1000.0, .position_gain = 20.0, .speed_gain = 0.2};
  task.compensation_rad = 0.05;
  const BlindOptions options{.rate = 1000.0, .duration = 3.0, .tolerance = kFastTolerance};
  const ChainRun run = simulate_chain(d, position_input(task, 3.0, 1), {}, options);
  const Reference course(task.course, 3.0, 1);
  EXPECT_NEAR(run.x1[1400] - course.at(1.4).x, -0.05, 2e-3);
  EXPECT_NEAR(run.x1[2400] - course.at(2.4).x, 0.05, 2e-3);
}

}  // namespace
}  // namespace gapscope::independent_plant
