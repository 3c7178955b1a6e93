// Recovered truth from steps of their own length; the recordings are those of the independent plant.
#include <gtest/gtest.h>

#include "reference/observer.h"
#include "reference/rigs.h"
#include "support/uneven.h"

namespace gapscope {
namespace {

using namespace test;

const auto kSensor = independent_plant::BlindSensor::with_bits(20);

double sine(double t) { return 0.5814 * std::sin(2.0 * kPi * t); }

ReferenceModel rig_to_fit(const independent_plant::BlindDrive& drive) {
  ReferenceModel model = known_model(drive);
  estimate(model, kGap, 0.022);
  estimate(model, kMotorDamping, 0.05);
  estimate(model, kMassRatio, 1.2);
  return model;
}

struct Width {
  double gap, damping, mass_ratio;
};

/// Every number within its interval. @returns how wide the intervals are
Width expect_truth(const Recording& recording, const independent_plant::BlindDrive& drive) {
  const FitSummary fit = fit_one(recording, rig_to_fit(drive));
  EXPECT_EQ(fit.status, FitStatus::kConverged) << fit.full_report();
  EXPECT_TRUE(contains(fit, "gap", drive.gap)) << fit.full_report();
  EXPECT_TRUE(contains(fit, "motor_damping", drive.motor_damping)) << fit.full_report();
  EXPECT_TRUE(contains(fit, "mass_ratio", 1.0)) << fit.full_report();
  EXPECT_LT(fit.rmse, 1.2 * fit.floor) << fit.full_report();
  EXPECT_EQ(fit.objective_hz, 0.0) << "the free run, to the floor of the encoder";
  const auto width = [&](const char* key) {
    const Interval& ci = fit.find(key)->ci95;
    return ci.high - ci.low;
  };
  return {width("gap"), width("motor_damping"), width("mass_ratio")};
}

TEST(FitOfUnevenSteps, FindsTheDriveAsWellAsFromEvenOnes) {
  const independent_plant::BlindDrive drive;
  const Width even = expect_truth(even_recording(drive, sine, kSensor, {}), drive);
  const Width uneven = expect_truth(uneven_recording(drive, sine, kSensor, {}), drive);
  EXPECT_LT(uneven.gap, 1.5 * even.gap);
  EXPECT_LT(uneven.damping, 1.5 * even.damping);
  EXPECT_LT(uneven.mass_ratio, 1.5 * even.mass_ratio);
}

TEST(FitOfUnevenSteps, FindsTheDriveWhereRowsAreLostWhileTheInputIsHeld) {
  // Steps of the input last 50 rows: what a lost row would have said is what the row before it said.
  const independent_plant::BlindDrive drive;
  UnevenClock clock;
  clock.lost = 0.02;
  const auto held = [&](double t) { return sine(0.05 * std::floor(t / 0.05)); };
  expect_truth(uneven_recording(drive, held, kSensor, clock), drive);
}

TEST(FitOfUnevenSteps, IsNearTheDriveWhereLostRowsTookTheirInputsWithThem) {
  const independent_plant::BlindDrive drive;
  UnevenClock clock;
  clock.lost = 0.02;
  const FitSummary fit = fit_one(uneven_recording(drive, sine, kSensor, clock), rig_to_fit(drive));
  EXPECT_NEAR(fit.find("gap")->value / drive.gap, 1.0, 1e-3) << fit.full_report();
  EXPECT_NEAR(fit.find("motor_damping")->value / drive.motor_damping, 1.0, 1e-3);
  EXPECT_NEAR(fit.find("mass_ratio")->value, 1.0, 0.01);
}

TEST(FitOfUnevenSteps, KnowsADelayAsATime) {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  const auto multisine = [](double t) {
    return 0.3 * std::sin(2.0 * kPi * 1.1 * t) + 0.2 * std::sin(2.0 * kPi * 4.3 * t) +
           0.1 * std::sin(2.0 * kPi * 17.0 * t);
  };
  UnevenClock clock;
  drive.effects.command.delay_s = 3.3e-3;
  const Recording r = uneven_recording(drive, multisine, kSensor, clock);
  ReferenceModel model;
  model.structure.has_load = false;
  model.set("motor_inertia", ParameterSetting::sought(1e-3));
  model.set("torque_constant", ParameterSetting::known(drive.torque_constant));
  model.set("motor_damping", ParameterSetting::sought(0.05));
  ModelEffect delay{find_effect("input_delay"), {}};
  delay.parameters[0] = ParameterSetting::sought(2e-3);
  model.effects = {delay};
  const FitSummary fit = fit_one(r, model);
  EXPECT_NEAR(fit.find("motor_inertia")->value / drive.motor_inertia, 1.0, 1e-3) << fit.full_report();
  EXPECT_NEAR(fit.find("input_delay.delay_s")->value, 3.3e-3, 1e-5);
}

}  // namespace

namespace internal::reference {
namespace {

TEST(ObserverGains, PutBothPolesOfAFreeMassAtTheirPlaceWhateverTheSteps) {
  // Error (x, w) after an interval h and its correction: the matrix of both has trace 2 p and determinant p².
  for (const double h : {1e-6, 0.7e-3, 1e-3, 0.3}) {
    Recording r;
    r.stamps = {0.0, 1e-3, 1e-3 + h};
    r.dt = 1e-3, r.x1.assign(3, 0.0);
    const ObserverGain g = ObserverGains(5.0, r.motor_trace()).at(2);
    const double p = std::exp(-2.0 * kPi * 5.0 * (r.stamps[2] - r.stamps[1]));
    const double trace = (1.0 - g.position) + (1.0 - g.speed * (r.stamps[2] - r.stamps[1]));
    EXPECT_NEAR(trace, 2.0 * p, 1e-12) << h;
    EXPECT_NEAR(1.0 - g.position, p * p, 1e-12) << h;
  }
}

TEST(ObserverGains, AGapOfManyStepsIsCorrectedByItsOwnLength) {
  Recording r;
  for (int i = 0; i < 50; ++i) r.stamps.push_back(1e-3 * i + (i < 30 ? 0.0 : 0.2));
  r.dt = r.stamps.back() / 49.0;
  r.x1.assign(50, 0.0);
  const ObserverGains gains(3.0, r.motor_trace());
  EXPECT_DOUBLE_EQ(gains.at(30).position, ObserverGain::poles(3.0, r.stamps[30] - r.stamps[29]).position);
  EXPECT_NEAR(gains.at(29).speed, ObserverGain::poles(3.0, 1e-3).speed, 1e-12);
  EXPECT_DOUBLE_EQ(gains.interval(30), r.stamps[30] - r.stamps[29]);
}

}  // namespace
}  // namespace internal::reference
}  // namespace gapscope
