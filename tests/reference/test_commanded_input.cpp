// The input from target and position, where a drive of the independent plant ran under a controller of its
// own code.
#include <gtest/gtest.h>

#include "drives/closed_loop.h"
#include "gapscope/recording/controller.h"
#include "reference/model_fit.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;
using independent_plant::ControllerSettings;
using independent_plant::LoopRun;

/// Proportional to the position error and its slope: no integral, the speed as it is.
ControllerSettings stiff_servo(double dead_time) {
  return {.rate = 1000.0,
          .position_gain = 40.0,
          .speed_forward = 1.0,
          .speed_gain = 0.05,
          .dead_time_s = dead_time};
}

DriveController same_servo(double delay) {
  DriveController c;
  c.gain = 40.0 * 0.05, c.derivative = 0.05, c.rate = 1000.0, c.delay = delay;
  return c;
}

independent_plant::BlindDrive one_body() {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  return drive;
}

LoopRun under_control(const ControllerSettings& servo) {
  const independent_plant::BlindOptions options{.duration = 6.0, .seed = 5, .tolerance = 1e-9};
  return simulate_closed_loop(one_body(),
                              {.course = independent_plant::Course::kSines, .travel = 2.0, .speed = 4.0},
                              servo, independent_plant::BlindSensor::with_bits(18), {.lead_s = 0.5}, options);
}

CommandRows rows_of(const LoopRun& loop) {
  CommandRows rows{loop.stamps, {}, loop.run.recording.x1, {}};
  for (const auto& t : loop.target) rows.target.push_back(t.x);
  rows.supply.assign(rows.t.size(), 1.0);
  return rows;
}

std::vector<double> commanded(const LoopRun& loop, const DriveController& controller) {
  return commanded_input(controller, rows_of(loop));
}

TEST(CommandedInput, IsWhatTheDrivesOwnControllerSent) {
  const LoopRun loop = under_control(stiff_servo(0.0));
  const InputComparison same = compare_inputs(loop.run.recording.u, commanded(loop, same_servo(0.0)));
  EXPECT_NEAR(same.scale, 1.0, 2e-3);
  EXPECT_LT(same.left, 0.02);
  DriveController other = same_servo(0.0);
  other.gain *= 2.0;
  EXPECT_GT(compare_inputs(loop.run.recording.u, commanded(loop, other)).left, 0.05);
}

/// Bounds below what a sample can show are narrowed to one value, not turned round.
TEST(CommandedInput, OfAVeryShortDelayKeepsItsBoundsInOrder) {
  const LoopRun loop = under_control(stiff_servo(0.0));
  const CommandRows rows = rows_of(loop);
  MotorTrace trace = loop.run.recording.motor_trace();
  trace.command = &rows;
  ReferenceModel model = known_model(one_body());
  model.structure.has_load = false;
  ParameterSetting& delay =
      model.controller.emplace(ControllerModel::known(same_servo(0.0))).numbers[controller_place::kDelay];
  delay.estimate = true, delay.low = 0.0, delay.high = 1e-7;
  const internal::reference::ModelFit fit({&trace, 1}, model, {}, 2.5);
  const Interval bounds = fit.bounds(internal::reference::number_of_controller(controller_place::kDelay));
  EXPECT_LE(bounds.low, bounds.high);
  EXPECT_LE(bounds.high, 1e-3 * trace.dt);
}

TEST(CommandedInput, FitsTheDriveThatItMoved) {
  const LoopRun loop = under_control(stiff_servo(0.002));
  Recording r = loop.run.recording;
  r.u = commanded(loop, same_servo(0.002));
  r.x2.clear(), r.mode.clear();
  ReferenceModel model = known_model(one_body());
  model.structure.has_load = false;
  estimate(model, kMotorInertia, 2e-3);
  estimate(model, kMotorDamping, 0.03);
  const FitSummary summary = fit_one(r, model);
  EXPECT_NEAR(summary.find("motor_damping")->value, 0.062, 0.02 * 0.062) << summary.full_report();
  EXPECT_NEAR(summary.find("motor_inertia")->value, 8.78e-4, 0.02 * 8.78e-4) << summary.full_report();
}

/// Mean square of what the free run of the true drive leaves, each number known [floor²].
double left_by_the_truth(const MotorTrace& trace) {
  ReferenceModel model = known_model(one_body());
  model.structure.has_load = false;
  const internal::reference::ModelFit fit({&trace, 1}, model, {}, 0.0);
  return fit.refine(fit.given_point(), {}).mean_cost;
}

/// A delay of 0.46 of a row: the means of the intervals alone have the drive elsewhere at their ends.
TEST(CommandedInput, MovesTheDriveExactlyWhereItActsWithinARow) {
  const double dead_time = 2.3e-3;
  const LoopRun loop = under_control({.rate = 200.0,
                                      .position_gain = 40.0,
                                      .speed_forward = 0.0,
                                      .speed_gain = 0.3,
                                      .dead_time_s = dead_time});
  Recording r = loop.run.recording;
  r.x2.clear(), r.mode.clear();
  r.command = std::make_shared<CommandRows>(rows_of(loop));
  DriveController controller;
  controller.kind = ControllerKind::kCascade;
  controller.gain = 40.0, controller.speed_gain = 0.3, controller.delay = dead_time;
  command_by(controller, r);
  Recording later = part(r, 10, r.size() - 10);  // of the first row the speed before it is not known
  EXPECT_LT(left_by_the_truth(later.motor_trace()), 1.5);
  later.sent.clear();
  EXPECT_GT(left_by_the_truth(later.motor_trace()), 5.0);
}

}  // namespace
}  // namespace gapscope
