// When the balance of slow torques is told.
#include <gtest/gtest.h>

#include "diagnosis/tell_budget.h"

namespace gapscope {
namespace {

/// Of a balance that leaves 16 mN·m of 45, beside a motion that an observer has to correct by so much.
/// @param remains  of the simulated motion [floor]
/// @param floor  of the balance [N m]
Diagnosis told(double remains, double correcting, const std::vector<std::string>& effects,
               double floor = 0.01) {
  using namespace internal::diagnosis;
  const DiagnosisOptions options;
  const Study study{{}, {}, {}, {}, kMeasure.slow_hz, 0.0, {}, options};
  internal::torque_view::Budget budget;
  budget.band.hz = 1.4;
  budget.input_rms = 0.045;
  budget.nominal_rms = budget.addable_rms = budget.rms = 0.016;
  budget.floors.encoder = floor;
  Diagnosis d;
  d.effects = effects;
  d.mismatch.remains = remains, d.mismatch.after_torque = correcting;
  tell_budget(study, budget, d);
  return d;
}

TEST(TellBudget, IsTheSizeOfTheMismatch) {
  const Diagnosis d = told(5.0, 1e-4, {});
  EXPECT_TRUE(d.budget.exists());
  EXPECT_EQ(d.mismatch.before_torque, 0.016);
  EXPECT_EQ(d.mismatch.input_torque, 0.045);
}

TEST(TellBudget, IsNotToldWhereTheMotionShowsNothingOfWhatItLeaves) {
  for (const std::vector<std::string>& effects : {std::vector<std::string>{}, {"input_delay"}}) {
    const Diagnosis d = told(1.1, 1e-4, effects);
    EXPECT_FALSE(d.budget.exists());
    EXPECT_EQ(d.mismatch.after_torque, 1e-4) << "the observer's";
  }
}

TEST(TellBudget, IsNotToldWhereItLeavesFarMoreThanItsOwnFloorOfAMotionThatIsExplained) {
  EXPECT_FALSE(told(1.1, 0.01, {}, 1e-4).budget.exists());
  EXPECT_TRUE(told(5.0, 0.01, {}, 1e-4).budget.exists()) << "the motion shows what it leaves";
}

TEST(TellBudget, IsToldAtTheFloorWhereAnObserverCorrectsAsMuch) {
  EXPECT_TRUE(told(1.1, 0.01, {}).budget.exists());
  const Diagnosis delayed = told(1.1, 0.01, {"input_delay"});
  EXPECT_EQ(delayed.budget.uncounted, std::vector<std::string>{"input_delay"});
  EXPECT_EQ(delayed.mismatch.after_torque, 0.01) << "the balance does not count the delay";
}

}  // namespace
}  // namespace gapscope
