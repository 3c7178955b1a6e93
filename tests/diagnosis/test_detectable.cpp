// What would have been named, on drives of the independent plant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/among.h"
#include "diagnosis/one_inertia.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {
namespace {

using independent_plant::MotorEffects;

Diagnosis diagnosed(const MotorEffects& effects, const DiagnosisOptions& options = {}) {
  const blind::BlindPair pair = test::one_inertia(effects, 500031);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  return diagnose(train, held_out, pair.sheet, options);
}

const DetectableEffect& of(const Diagnosis& d, const std::string& effect) {
  const auto at = std::find_if(d.detectable.begin(), d.detectable.end(),
                               [&](const DetectableEffect& e) { return e.effect == effect; });
  EXPECT_NE(at, d.detectable.end()) << effect;
  return *at;
}

bool names(const Diagnosis& d, const std::string& effect) {
  return d.verdict == DiagnosisVerdict::kEffect && contains(d.effects, effect);
}

/// The amounts are foretold without a refit, and the diagnosis refits everything.
TEST(Detectable, NothingMissingAlwaysTellsItThreeTimesAsMuchIsNamedAndAThirdIsNot) {
  const Diagnosis none = diagnosed({});
  ASSERT_EQ(none.verdict, DiagnosisVerdict::kNone);
  EXPECT_GT(none.detectable.size(), 10u);
  for (const DetectableEffect& e : none.detectable) EXPECT_NE(e.can_be_shown(), !e.why.empty()) << e.effect;
  const DetectableEffect& cogging = of(none, "cogging_torque");
  const double level = of(none, "motor_coulomb_friction").smallest.value;
  const DiagnosisOptions few =
      test::among({"motor_coulomb_friction", "friction_asymmetry", "quadratic_drag", "cogging_torque"});
  MotorEffects friction, cogs;
  friction.friction.level_nm = level / 3.0;
  const Diagnosis less = diagnosed(friction, few);
  EXPECT_FALSE(names(less, "motor_coulomb_friction"));
  EXPECT_FALSE(less.detectable.empty());
  friction.friction.level_nm = 3.0 * level;
  const Diagnosis more = diagnosed(friction, few);
  EXPECT_TRUE(names(more, "motor_coulomb_friction"));
  EXPECT_TRUE(more.detectable.empty());
  cogs.cogging = {3.0 * cogging.smallest.value, cogging.at.front().value, 0.4, 0.0};
  EXPECT_TRUE(names(diagnosed(cogs, few), "cogging_torque"));
}

TEST(Detectable, IsToldOfAnEffectOnRequestAndTheSameForAnyNumberOfThreads) {
  MotorEffects friction;
  friction.friction.level_nm = 0.01;
  const blind::BlindPair pair = test::one_inertia(friction, 500031);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  const auto asked = [&](int threads) {
    DiagnosisOptions options = test::among({"motor_coulomb_friction", "quadratic_drag", "input_delay"});
    options.known.detectable = true, options.threads = threads;
    return diagnose(train, held_out, pair.sheet, options);
  };
  const Diagnosis one = asked(1), two = asked(2);
  ASSERT_EQ(one.detectable.size(), two.detectable.size());
  ASSERT_FALSE(one.detectable.empty());
  for (std::size_t i = 0; i < one.detectable.size(); ++i) {
    EXPECT_NE(one.detectable[i].effect, "motor_coulomb_friction");  // it is in the model
    EXPECT_EQ(one.detectable[i].why, two.detectable[i].why);
    if (!one.detectable[i].can_be_shown()) continue;
    EXPECT_EQ(one.detectable[i].smallest.value, two.detectable[i].smallest.value);
  }
}

}  // namespace
}  // namespace gapscope
