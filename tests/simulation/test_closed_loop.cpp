// The drive under its controller, beside the independent plant under a controller of its own code.
#include <gtest/gtest.h>

#include <cmath>

#include "drives/closed_loop.h"
#include "gapscope/simulation/closed_loop.h"

namespace gapscope {
namespace {

constexpr double kLoopRate = 1000.0, kSlope = 40.0, kGain = 0.05;

DriveParameters<double> loop_rig() {
  const independent_plant::BlindDrive d;
  return {d.motor_inertia,
          d.torque_constant,
          d.motor_damping,
          d.load_inertia / d.motor_inertia,
          d.gap,
          d.load_damping,
          d.load_coulomb,
          d.contact_stiffness,
          d.contact_damping};
}

independent_plant::LoopRun independent_loop(double dead_time, double integral_s) {
  return simulate_closed_loop({}, {.course = independent_plant::Course::kSines, .travel = 2.0, .speed = 4.0},
                              {.rate = kLoopRate,
                               .position_gain = kSlope,
                               .speed_forward = 0.0,
                               .speed_gain = kGain,
                               .integral_s = integral_s,
                               .dead_time_s = dead_time},
                              independent_plant::BlindSensor{}, {},
                              {.duration = 2.0, .seed = 4, .tolerance = 1e-11});
}

DriveController cascade(double delay, double integral_s) {
  DriveController c;
  c.kind = ControllerKind::kCascade;
  c.gain = kSlope, c.speed_gain = kGain, c.speed_integral = kGain / integral_s;
  c.rate = kLoopRate, c.delay = delay;
  return c;
}

Recording own_loop(const independent_plant::LoopRun& like, const DriveController& controller) {
  std::vector<double> target;
  for (const auto& t : like.target) target.push_back(t.x);
  SimulationOptions options;
  options.rate = kLoopRate;
  return simulate_under_controller(plant_model(loop_rig(), {}), controller, target, options);
}

double farthest_apart(const std::vector<double>& a, const std::vector<double>& b, std::size_t from = 0) {
  double most = 0.0;
  for (std::size_t i = from; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// Two codes of plant and controller; what is left is the integrator's tolerance over 2 s of motion.
TEST(ClosedLoop, MovesAsTheIndependentPlantDoes) {
  for (const auto& [delay, integral] : {std::pair{0.0, kInfinity}, {0.0023, kInfinity}, {0.0, 0.1}}) {
    const independent_plant::LoopRun like = independent_loop(delay, integral);
    const Recording own = own_loop(like, cascade(delay, integral));
    ASSERT_EQ(own.size(), like.run.recording.size());
    EXPECT_LT(farthest_apart(own.x1, like.run.truth.x1), 1e-6) << delay << " s, " << integral << " s";
    EXPECT_GT(farthest_apart(own.x1, own.x2), 0.4 * 18.8e-3);  // the gap is crossed
  }
}

/// But for the first delay, in which nothing acts yet where a recording takes up a loop at work.
TEST(ClosedLoop, RecordsWhatTheControllerMadeOfIt) {
  const Recording own = own_loop(independent_loop(0.0, kInfinity), cascade(0.0013, 0.2));
  const std::vector<double> made = commanded_input(cascade(0.0013, 0.2), *own.command);
  EXPECT_LT(farthest_apart(made, own.u, 2), 1e-9);
}

/// Nothing that was recorded after the first row but the targets and the volts counts.
TEST(ClosedLoop, GoesOnFromTheFirstRowOfARecordingAlone) {
  const DriveController c = cascade(0.0, kInfinity);
  const Recording own = own_loop(independent_loop(0.0, kInfinity), c);
  CommandRows rows = *own.command;
  rows.supply.assign(rows.t.size(), 0.5), rows.gain_times = 2.0;
  for (std::size_t i = 1; i < rows.t.size(); ++i) rows.position[i] = 17.0;
  MotorTrace beside = own.motor_trace();
  beside.command = &rows;
  const std::vector<double> again = positions_under_controller(plant_model(loop_rig(), {}), c, beside, {});
  ASSERT_EQ(again.size(), own.size());
  EXPECT_LT(farthest_apart(again, own.x1), 1e-9);
}

TEST(ClosedLoop, UpdatesBetweenTheRowsFromTheModelsOwnPosition) {
  std::vector<double> target(200, 0.3);
  SimulationOptions slow, fast;
  slow.rate = 100.0, fast.rate = 1000.0;
  DriveController c = cascade(0.0004, kInfinity);
  const Recording few = simulate_under_controller(plant_model(loop_rig(), {}), c, target, slow);
  target.assign(2000, 0.3);
  const Recording many = simulate_under_controller(plant_model(loop_rig(), {}), c, target, fast);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_NEAR(few.x1[i], many.x1[10 * i], 1e-9) << i;
}

}  // namespace
}  // namespace gapscope
