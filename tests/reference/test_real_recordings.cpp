// Recordings of real machines, where they are at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/recording/recording_file.h"
#include "reference/rigs.h"
#include "support/data.h"

namespace gapscope {
namespace {

using namespace test;

ModelEffect estimated(const char* name, double start) {
  ModelEffect e;
  e.entry = find_effect(name);
  e.parameters[0] = {start, true, kNaN, kNaN, {}};
  return e;
}

/// A ball-screw axis without a load of its own, from values of twice what was published.
FitSummary fit_axis(std::pair<double, double> window, bool with_load = true) {
  ReadOptions options;
  options.window = window;
  Recording recording = read_recording((testing::data_folder() / "emps/emps_train.csv").string(), options);
  recording.quantum = 5e-8;
  ReferenceModel model;
  model.structure.has_load = false;
  model.parameters[kTorqueConstant].value = 1.0;
  estimate(model, kMotorInertia, 190.0);
  estimate(model, kMotorDamping, 400.0);
  model.effects = {estimated("motor_coulomb_friction", 40.0)};
  if (with_load) model.effects.push_back(estimated("constant_load_torque", 6.0));
  return fit_one(recording, model);
}

struct Published {
  const char* key;
  double value, tolerance;
};
constexpr Published kAxis[] = {{"motor_inertia", 95.11, 0.01},
                               {"motor_damping", 203.5, 0.03},
                               {"motor_coulomb_friction.level_nm", 20.39, 0.03},
                               {"constant_load_torque.torque_nm", 3.16, 0.03}};

TEST(RealRecordings, ARunThatDriftsFromAClosedLoopIsNoReasonToSuspectTheSignOfTheInput) {
  GAPSCOPE_NEEDS_DATA();
  const FitSummary summary = fit_axis({0.0, 1e3}, false);
  EXPECT_GT(summary.rmse, 0.11) << "it drifts farther than the axis moves, whose rms is 0.083 m";
  EXPECT_EQ(summary.full_report().find("the sign and the unit of u"), std::string::npos);
}

TEST(RealRecordings, ABallScrewAxisIsFoundAsItWasPublished) {
  GAPSCOPE_NEEDS_DATA();
  const FitSummary summary = fit_axis({0.0, 1e3});
  EXPECT_EQ(summary.status, FitStatus::kConverged);
  for (const auto& [key, value, tolerance] : kAxis) {
    EXPECT_TRUE(contains(summary, key, value)) << summary.full_report();
    EXPECT_NEAR(summary.find(key)->value / value, 1.0, tolerance) << key;
  }
  // The model is not all there is, and the fit says so.
  EXPECT_TRUE(
      std::ranges::any_of(summary.warnings, [](const Remark& w) { return w.code() == "leaves_some"; }));
}

TEST(RealRecordings, TheHalvesOfARecordingAgree) {
  GAPSCOPE_NEEDS_DATA();
  const FitSummary first = fit_axis({0.0, 12.48}), second = fit_axis({12.48, 1e3});
  for (const auto& [key, value, tolerance] : kAxis) {
    const FittedParameter *a = first.find(key), *b = second.find(key);
    EXPECT_LT(std::abs(a->value - b->value), 2.5 * std::hypot(a->std, b->std)) << key;
  }
}

/// A cycloidal reducer behind a locked output; its reflected inertia is not known within a factor of ten.
FitSummary fit_reducer(const std::string& name, std::pair<double, double> window) {
  ReadOptions options;
  options.resample_rate = 200.0;
  options.window = window;
  Recording recording =
      read_recording((testing::data_folder() / ("cycloidal/" + name + ".csv")).string(), options);
  recording.quantum = 2.0 * kPi / 65536.0;
  ReferenceModel model;
  model.structure.load = LoadKind::kLocked;
  model.parameters[kTorqueConstant].value = 1.0;
  estimate(model, kMotorInertia, 0.1);
  estimate(model, kMotorDamping, 0.5);
  estimate(model, kGap, 0.02);
  estimate(model, kContactStiffness, 500.0);
  estimate(model, kContactDamping, 1.0);
  model.effects = {estimated("motor_coulomb_friction", 1.0)};
  FitOptions fit;
  fit.starts = 2;
  return fit_one(recording, model, fit);
}

TEST(RealRecordings, GapFrictionAndStiffnessMakeUpThePlayOfALockedReducer) {
  GAPSCOPE_NEEDS_DATA();
  const FitSummary summary = fit_reducer("baseline_pos1", {0.0, 20.31});
  const double gap = summary.find("gap")->value;
  const double friction = summary.find("motor_coulomb_friction.level_nm")->value;
  const double play = gap + 2.0 * friction / summary.find("contact_stiffness")->value;
  EXPECT_NEAR(play / 0.0335, 1.0, 0.1) << summary.full_report();
  EXPECT_LT(gap, play);
}

TEST(RealRecordings, AGapThatOnlyLargeRampsShowIsNoGap) {
  GAPSCOPE_NEEDS_DATA();
  const FitSummary summary = fit_reducer("splitpreload3_pos1", {0.0, 1e3});
  EXPECT_FALSE(summary.find("gap")->identifiable);
  EXPECT_NE(summary.full_report().find("reads as a gap is something else"), std::string::npos)
      << summary.full_report();
}

}  // namespace
}  // namespace gapscope
