#include <gtest/gtest.h>

#include <algorithm>

#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/stepper.h"
#include "simulation/drives.h"

namespace gapscope {
namespace {

using test::geared_axis;
using test::heavy_load;
using test::held;
using test::paper_rig;
using test::several_sines;
using test::sine;

struct Motion {
  std::vector<DriveState<double>> states;
  long events = 0;
};

Motion run(const PlantModel<double>& model, const std::vector<double>& u, double dt, int every = 1,
           DriveState<double> initial = {}) {
  DriveStepper<double> stepper(model, dt);
  stepper.reset(initial);
  Motion motion;
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (i % static_cast<std::size_t>(every) == 0) motion.states.push_back(stepper.state());
    stepper.step(u[i]);
  }
  EXPECT_TRUE(stepper.healthy());
  motion.events = stepper.events();
  return motion;
}

double largest_difference(const Motion& a, const Motion& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.states.size(), b.states.size()); ++i)
    largest = std::max(
        {largest, std::abs(a.states[i].x1 - b.states[i].x1), std::abs(a.states[i].x2 - b.states[i].x2)});
  return largest;
}

PlantModel<double> plain(const DriveParameters<double>& drive) { return plant_model(drive, {}); }

PlantModel<double> with_motor_friction(const DriveParameters<double>& drive, double level) {
  PlantModel<double> model = plain(drive);
  model.motor_friction_plus = model.motor_friction_minus = level;
  model.motor_sticks = true;
  return model;
}

/// The same motion at Ts and Ts/64 with the same held input: exact up to round-off, amplified by the impacts.
void expect_exact(const PlantModel<double>& model, const std::vector<double>& u, double rate) {
  const Motion coarse = run(model, u, 1.0 / rate);
  const Motion fine = run(model, held(u, 64), 1.0 / (64.0 * rate), 64);
  EXPECT_GT(coarse.events, 20);
  EXPECT_LT(largest_difference(coarse, fine), 1e-9);
}

TEST(Stepper, SamplingDoesNotChangeTheMotionOfThreeRigs) {
  expect_exact(plain(paper_rig()), sine(0.6, 1.0, 2000, 8), 2000);
  expect_exact(plain(paper_rig()), several_sines(0.6, 2000, 8), 2000);
  expect_exact(plain(geared_axis()), sine(1.0, 1.0, 1000, 8), 1000);
  expect_exact(plain(heavy_load()), sine(0.6, 1.0, 4000, 8), 4000);
}

TEST(Stepper, SamplingDoesNotChangeTheMotionOfASticKingMotor) {
  expect_exact(with_motor_friction(paper_rig(), 0.03), sine(0.9, 1.0, 2000, 8), 2000);
  expect_exact(with_motor_friction(paper_rig(), 0.03), several_sines(0.9, 2000, 8), 2000);
}

TEST(Stepper, SamplingDoesNotChangeTheMotionOfAStiffLightContactOfManyOscillationsPerSample) {
  DriveParameters<double> drive = paper_rig();
  drive.mass_ratio = 0.1;
  drive.contact_stiffness = 5000.0;
  drive.contact_damping = 0.0;
  expect_exact(plain(drive), sine(0.6, 1.0, 1000, 4), 1000);
}

TEST(Stepper, SamplingDoesNotChangeTheMotionBehindARigidContact) {
  PlantModel<double> model = plain(paper_rig());
  model.structure.contact = ContactLaw::kRigid;
  for (const double restitution : {0.0, 0.5, 0.8}) {
    model.structure.restitution = restitution;
    expect_exact(model, sine(0.6, 1.0, 2000, 8), 2000);
  }
}

TEST(Stepper, FreeMotorDecaysAsTheClosedFormSays) {
  // w = w0 exp(−d/m t), x = w0 m/d (1 − exp(−d/m t)).
  PlantModel<double> model;
  model.drive = paper_rig();
  model.structure.has_load = false;
  DriveStepper<double> stepper(model, 1e-3);
  stepper.reset({0.0, 2.0, 0.0, 0.0});
  for (int i = 0; i < 25; ++i) stepper.step(0.0);
  const double rate = 0.062 / 8.78e-4, t = 0.025;
  EXPECT_NEAR(stepper.state().w1, 2.0 * std::exp(-rate * t), 1e-14);
  EXPECT_NEAR(stepper.state().x1, 2.0 / rate * (1.0 - std::exp(-rate * t)), 1e-14);
}

TEST(Stepper, CoulombFrictionStopsTheMotorAtTheClosedFormPlaceAndHoldsIt) {
  // Without damping: x = m w0²/(2 Fc), then at rest while |Km u| ≤ Fc.
  PlantModel<double> model;
  model.drive = paper_rig();
  model.drive.motor_damping = 0.0;
  model.structure.has_load = false;
  model.motor_friction_plus = model.motor_friction_minus = 0.02;
  model.motor_sticks = true;
  DriveStepper<double> stepper(model, 1e-3);
  stepper.reset({0.0, 1.0, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) stepper.step(0.0);
  EXPECT_EQ(stepper.state().w1, 0.0);
  EXPECT_NEAR(stepper.state().x1, 8.78e-4 / (2.0 * 0.02), 1e-15);
  for (int i = 0; i < 100; ++i) stepper.step(0.9 * 0.02 / 0.172);
  EXPECT_EQ(stepper.state().w1, 0.0);
  stepper.step(1.1 * 0.02 / 0.172);
  EXPECT_GT(stepper.state().w1, 0.0);
}

TEST(Stepper, ClosedUndampedContactOscillatesAtItsClosedFormFrequencyUntilItOpens) {
  // δ − β = Δw/ω sin ωt with ω² = k (1/m1 + 1/m2): open again after π/ω, speeds exchanged (equal masses).
  PlantModel<double> model = plain(paper_rig());
  DriveParameters<double>& p = model.drive;
  p.motor_damping = p.load_damping = p.load_coulomb_friction = p.contact_damping = 0.0;
  model.load_sticks = false;
  const double omega = std::sqrt(p.contact_stiffness * 2.0 / p.motor_inertia);
  DriveStepper<double> stepper(model, 1e-4);
  stepper.reset({0.5 * p.gap, 1.0, 0.0, 0.0});
  double last_closed = 0.0;
  for (int i = 1; i <= 100; ++i) {
    stepper.step(0.0);
    if (stepper.mode().contact != 0) last_closed = i * 1e-4;
  }
  EXPECT_NEAR(last_closed, kPi / omega, 1e-4);  // the sampling interval
  EXPECT_NEAR(stepper.state().w1, 0.0, 1e-12);
  EXPECT_NEAR(stepper.state().w2, 1.0, 1e-12);
  EXPECT_EQ(stepper.events(), 2);
}

TEST(Stepper, MomentumIsKeptWithoutDampersAndFriction) {
  for (const ContactLaw law : {ContactLaw::kCompliant, ContactLaw::kRigid}) {
    PlantModel<double> model = plain(geared_axis());
    DriveParameters<double>& p = model.drive;
    p.motor_damping = p.load_damping = p.load_coulomb_friction = 0.0;
    model.load_sticks = false;
    model.structure.contact = law;
    model.structure.restitution = 0.9;
    DriveStepper<double> stepper(model, 1e-3);
    stepper.reset({0.0, 1.0, 0.0, -2.0});
    const double momentum = 1.0 - 3.0 * 2.0;
    for (int i = 0; i < 2000; ++i) {
      stepper.step(0.0);
      ASSERT_NEAR(stepper.state().w1 + 3.0 * stepper.state().w2, momentum, 1e-11);
    }
    EXPECT_GT(stepper.events(), 5);
  }
}

TEST(Stepper, StoredEnergyNeverGrowsWithoutInput) {
  const PlantModel<double> model = with_motor_friction(geared_axis(), 1e-4);
  const DriveParameters<double>& p = model.drive;
  DriveStepper<double> stepper(model, 1e-3);
  stepper.reset({0.01, 3.0, 0.0, -2.0});
  double before = kInfinity;
  for (int i = 0; i < 3000; ++i) {
    const DriveState<double>& z = stepper.state();
    const double depth = std::max(0.0, std::abs(z.x1 - z.x2) - 0.5 * p.gap);
    const double stored = stepper.mode().contact != 0 ? 0.5 * p.contact_stiffness * depth * depth : 0.0;
    const double m1 = p.motor_inertia, m2 = m1 * p.mass_ratio;
    const double energy = 0.5 * m1 * z.w1 * z.w1 + 0.5 * m2 * z.w2 * z.w2 + stored;
    ASSERT_LE(energy, before * (1.0 + 1e-12));
    before = energy;
    stepper.step(0.0);
  }
  EXPECT_EQ(stepper.state().w1, 0.0);
  EXPECT_EQ(stepper.state().w2, 0.0);
}

TEST(Stepper, NegatingStateAndInputNegatesTheMotionBitForBit) {
  const PlantModel<double> model = with_motor_friction(paper_rig(), 0.01);
  const std::vector<double> u = several_sines(0.7, 2000, 3);
  std::vector<double> opposite;
  for (const double v : u) opposite.push_back(-v);
  const Motion a = run(model, u, 5e-4, 1, {0.001, 0.2, 0.0, 0.1});
  const Motion b = run(model, opposite, 5e-4, 1, {-0.001, -0.2, 0.0, -0.1});
  for (std::size_t i = 0; i < a.states.size(); ++i) ASSERT_EQ(a.states[i].x1, -b.states[i].x1) << i;
}

TEST(Stepper, ContactNeverPullsAndTheGapCarriesNoTorque) {
  const PlantModel<double> model = plain(paper_rig());
  DriveStepper<double> stepper(model, 4e-4);
  for (const double u : several_sines(0.8, 2500, 6)) {
    stepper.step(u);
    const DriveState<double>& z = stepper.state();
    const double delta = z.x1 - z.x2, beta = 0.5 * model.drive.gap;
    const int contact = stepper.mode().contact;
    if (contact == 0) {
      const double beyond = std::abs(delta) - beta;
      // Open: inside the gap, or beyond its edge and parting under what would be tension.
      ASSERT_TRUE(beyond < 1e-12 || 200.0 * beyond + 0.05 * (delta > 0 ? 1 : -1) * (z.w1 - z.w2) < 1e-9);
    } else {
      ASSERT_GT(contact * (200.0 * (delta - contact * beta) + 0.05 * (z.w1 - z.w2)), -1e-9);
    }
  }
}

TEST(Stepper, LockedLoadNeverMovesAndALoadlessDriveIgnoresIt) {
  PlantModel<double> model = plain(paper_rig());
  model.structure.load = LoadKind::kLocked;
  model.drive.mass_ratio = 0.0;
  const Motion locked = run(model, sine(0.6, 1.0, 2000, 3), 5e-4);
  double widest = 0.0;
  for (const auto& z : locked.states) {
    ASSERT_EQ(z.x2, 0.0);
    widest = std::max(widest, std::abs(z.x1));
  }
  // Peak torque over stiffness beyond the half gap, plus an overshoot below twice the static wind-up.
  EXPECT_GT(widest, 0.0094 + 0.5 * 0.6 * 0.172 / 200.0);
  EXPECT_LT(widest, 0.0094 + 2.0 * 0.6 * 0.172 / 200.0 + 0.01);
}

TEST(Stepper, AContactThatAnInjectionPartsIsOpenAndClosesAgain) {
  DriveParameters<double> p = paper_rig();
  p.contact_damping = 2.0;  // far more than k times the distance below
  DriveStructure structure;
  structure.load = LoadKind::kLocked;
  DriveStepper<double> stepper(plant_model(p, structure), 1e-3);
  stepper.reset({});
  for (int i = 0; i < 300; ++i) stepper.step(0.3);
  ASSERT_EQ(stepper.mode().contact, 1);
  stepper.inject(0.5 * p.gap - 1e-3 - stepper.state().x1, 0.5);
  EXPECT_EQ(stepper.mode().contact, 0);
  for (int i = 0; i < 300; ++i) stepper.step(0.3);
  EXPECT_TRUE(stepper.healthy());
  EXPECT_EQ(stepper.mode().contact, 1);
}

TEST(Stepper, ElasticRigidContactBouncesByEquation3) {
  PlantModel<double> model = plain(paper_rig());
  DriveParameters<double>& p = model.drive;
  p.motor_damping = p.load_damping = p.load_coulomb_friction = 0.0;
  p.mass_ratio = 2.5;
  model.load_sticks = false;
  model.structure.contact = ContactLaw::kRigid;
  DriveStepper<double> stepper(model, 1e-3);
  const double w1 = 3.0, w2 = 0.4, alpha = -2.5;
  stepper.reset({0.0, w1, 0.0, w2});
  for (int i = 0; i < 5; ++i) stepper.step(0.0);
  EXPECT_NEAR(stepper.state().w1, (w1 * (1 + alpha) - 2 * alpha * w2) / (1 - alpha), 1e-14);
}

/// The longest that the motor rests under a torque far above its friction [samples].
int longest_held(const Motion& motion, const std::vector<double>& torque, double level) {
  int longest = 0, held = 0;
  for (std::size_t i = 1; i < motion.states.size(); ++i) {
    const bool moves = std::abs(motion.states[i].x1 - motion.states[i - 1].x1) > 1e-12;
    held = moves || std::abs(torque[i - 1]) < 1.5 * level ? 0 : held + 1;
    longest = std::max(longest, held);
  }
  return longest;
}

TEST(Stepper, BodiesThatRestInTouchDoNotHoldEachOther) {
  constexpr double kLevel = 0.117;
  DriveParameters<double> drive;
  drive.motor_inertia = 0.0312, drive.motor_damping = 0.081, drive.torque_constant = 1.0;
  DriveStructure one_body;
  one_body.has_load = false;
  const std::vector<double> torque = several_sines(0.3, 1e3, 6.0);
  for (int k = 0; k < 20; ++k) {
    PlantModel<double> model = plant_model(drive, one_body);
    model.motor_friction_plus = model.motor_friction_minus = kLevel;
    model.motor_sticks = true;
    const double values[] = {0.01 + 1e-3 * k, 0.5};
    add_effect<double>(model, *find_effect("backlash"), values);
    EXPECT_LT(longest_held(run(model, torque, 1e-3), torque, kLevel), 3) << "gap " << values[0];
  }
}

}  // namespace
}  // namespace gapscope
