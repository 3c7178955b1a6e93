// What other laws of contact and friction make of a fit: its trust, and the interval of its gap.
#include <gtest/gtest.h>

#include <cmath>

#include "drives/family.h"
#include "gapscope/plant/effect_hooks.h"
#include "plant/rival_laws.h"
#include "reference/rigs.h"
#include "reference/structure.h"
#include "reference/trust.h"

namespace gapscope {
namespace {

using namespace test;
using internal::reference::FitOutcome;

/// A fit that is good but for what the outcome says.
FitSummary settled_fit() {
  FitSummary f;
  f.status = FitStatus::kConverged;
  f.floor = f.rmse = f.innovation_rmse = 1.0;
  FittedParameter gap;
  gap.key = "gap", gap.unit = "rad", gap.value = 0.019, gap.std = 0.0001, gap.estimated = true;
  gap.low = 0.0, gap.high = 1.0, gap.identifiable = true, gap.ci95 = {0.0188, 0.0192};
  f.parameters.push_back(gap);
  return f;
}

std::string code_of(FitOutcome outcome, FitSummary f) {
  outcome.information.correlation.lag1 = 0.0;
  internal::reference::TrustFacts facts;
  facts.coasting_rmse = 1e4, facts.without_gap_ratio = 100.0;
  judge_trust({}, outcome, facts, f);
  EXPECT_EQ(f.trust == FitTrust::kGood, f.why.code() == "at_the_floor");
  return f.why.code();
}

TEST(Structure, ANumberThatItsBoundKeepsFromABetterFitTakesGoodAway) {
  FitOutcome outcome;
  EXPECT_EQ(code_of(outcome, settled_fit()), "at_the_floor");
  outcome.pressed = {"contact_damping"};
  EXPECT_EQ(code_of(outcome, settled_fit()), "at_bound");
}

TEST(Structure, ALawThatExplainsMoreTakesGoodAwayAndOneThatExplainsAsMuchWidens) {
  FitOutcome outcome;
  outcome.rivals = {{"Hunt-Crossley contact", 0.0183, 0.2}, {"hardening contact", 0.05, -4.0}};
  FitSummary f = settled_fit();
  tell_structure({}, outcome, f);
  ASSERT_TRUE(f.structure);
  EXPECT_EQ(f.structure->laws, (std::vector<std::string>{"linear contact", "Hunt-Crossley contact"}));
  EXPECT_DOUBLE_EQ(f.structure->gap_low, 0.0183);
  EXPECT_DOUBLE_EQ(f.structure->gap_high, 0.019);
  EXPECT_NEAR(f.parameters[0].ci95.low, 0.0181, 1e-12) << "its own half width about either gap";
  EXPECT_NEAR(f.parameters[0].ci95.high, 0.0192, 1e-12);
  EXPECT_EQ(code_of(outcome, f), "at_the_floor");
  outcome.rivals[0].advantage = 1.5;
  EXPECT_EQ(code_of(outcome, f), "other_law");
}

TEST(Structure, AHuntCrossleyContactReplacesSpringAndDamper) {
  PlantModel<double> plant;
  const double k = plant.drive.contact_stiffness = 300.0, c = plant.drive.contact_damping = 0.5;
  const EffectEntry& law = *rival_law_table()[0];
  ASSERT_STREQ(law.name, "hunt_crossley_contact");
  const double length = 2e-4;
  for (const double p : {-3e-4, 1e-5, 2e-4, 1e-3})
    for (const double speed : {-1.0, 0.5}) {
      const double q = std::abs(p) / length;
      const double torque = k * p + c * speed + hooks_of<double>(law).contact(p, speed, plant, &length);
      const double damper = 0.05 + 0.95 * std::pow(q, 1.5);  // a twentieth stays linear
      EXPECT_NEAR(torque, k * p * std::sqrt(q) + c * damper * speed, 1e-5 * (k * std::abs(p) + c));
    }
}

/// The model that has the data sheet of a drive.
ReferenceModel by_sheet(const independent_plant::ChainCase& c) {
  const independent_plant::ChainSheet s = chain_sheet(c);
  ReferenceModel model;
  const double numbers[] = {s.motor_inertia, s.torque_constant, s.motor_damping,     s.mass_ratio,     s.gap,
                            s.load_damping,  s.load_coulomb,    s.contact_stiffness, s.contact_damping};
  for (int i = 0; i < kDriveParameterCount; ++i) {
    model.parameters[static_cast<std::size_t>(i)].value = numbers[i];
    model.parameters[static_cast<std::size_t>(i)].estimate = i != kMotorInertia && i != kTorqueConstant;
  }
  if (s.motor_coulomb > 0.0) {
    model.effects.push_back({find_effect("motor_coulomb_friction"), {}});
    model.effects[0].parameters[0] = ParameterSetting::sought(s.motor_coulomb);
  }
  return model;
}

TEST(Structure, OfSphereContactsNoGoodIntervalMissesTheGap) {
  const independent_plant::ChainCase c = independent_plant::draw_family("hunt_crossley", 7);
  const FitSummary f = fit_one(simulate_chain(c).recording, by_sheet(c));
  EXPECT_TRUE(f.trust != FitTrust::kGood || contains(f, "gap", total_gap(c.drive).low)) << f.full_report();
  ASSERT_TRUE(f.structure);
}

}  // namespace
}  // namespace gapscope
