// A servo whose controller's gain is withheld: what a diagnosis says of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "base/text.h"
#include "drives/closed_loop.h"
#include "results/scratch_folder.h"
#include "run/run_diagnosis.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kSpeedGain = 0.05;  // [unit of u s/rad]

/// Target and position of a servo with an arm of 0.1 N m and dry friction, under its cascade.
void write_servo(const std::filesystem::path& path, std::uint64_t seed, double travel) {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  drive.motor_inertia = 8.78e-4, drive.torque_constant = 0.172, drive.motor_damping = 0.062;
  drive.effects.load.unbalance_nm = 0.1;
  drive.effects.motor.friction.level_nm = 0.03;
  const independent_plant::LoopRun loop = simulate_closed_loop(
      drive, {.course = independent_plant::Course::kSines, .travel = travel, .speed = 4.0},
      {.rate = 500.0, .position_gain = 40.0, .speed_forward = 0.0, .speed_gain = kSpeedGain},
      independent_plant::BlindSensor::with_bits(16), {}, {.duration = 4.0, .seed = seed, .tolerance = 1e-8});
  std::ofstream out(path);
  out.precision(12);
  out << "t,target,position\n";
  for (std::size_t i = 0; i < loop.stamps.size(); ++i)
    out << loop.stamps[i] << ',' << loop.target[i].x << ',' << loop.run.recording.x1[i] << '\n';
}

/// What the diagnosis says of the controller in the end, among some effects.
std::string said_of_gain(const std::vector<std::string>& candidates) {
  ScratchFolder folder;
  write_servo(folder.path / "train.csv", 5, 2.0);
  write_servo(folder.path / "held_out.csv", 6, 1.5);
  const Configuration c = parse_configuration(
      "recording:\n  file: train.csv\n  held_out: held_out.csv\n"
      "  columns: {time: t, target: target, position: position}\n"
      "encoder: {bits: 16}\n"
      "model: {parameters: {mass_ratio: 0, torque_constant: 0.172}}\n"
      "anchor: {mass: 0.203943243, arm: 0.05}\n"
      "controller: {velocity: {gain: estimate}, position: {gain: 40}}\n",
      (folder.path / "servo.yaml").string());
  DiagnosisOptions options;
  options.threads = 1;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* entry : table)
      if (!contains(candidates, entry->name)) options.excluded.emplace_back(entry->name);
  std::string said;
  for (const std::string& warning : run_diagnosis(c, options).result.diagnosis.warnings)
    if (warning.starts_with("the controller")) said = warning;
  return said;
}

TEST(WithheldGain, IsFoundWithWhatTheDiagnosisHasAdded) {
  const std::string said = said_of_gain({"motor_coulomb_friction", "quadratic_drag"});
  EXPECT_THAT(said, HasSubstr("fitted with what the diagnosis has added"));
  EXPECT_THAT(said, Not(HasSubstr("confounded")));
  EXPECT_THAT(said, HasSubstr("; these are of a last fit, which has their intervals, and `fitted.yaml` has "
                              "controller.velocity.gain "));
  double gain = 0.0;
  const std::string key = "controller.velocity.gain ";
  ASSERT_NE(said.find(key), std::string::npos) << said;
  std::sscanf(said.c_str() + said.find(key) + key.size(), "%lf", &gain);
  EXPECT_NEAR(gain, kSpeedGain, 0.02 * kSpeedGain) << said;
}

TEST(WithheldGain, IsSaidToBeConfoundedWithWhatTheModelStillLacks) {
  const std::string said = said_of_gain({"quadratic_drag", "input_delay"});
  EXPECT_THAT(said, HasSubstr("confounded with that")) << "without the friction that it lacks";
  EXPECT_THAT(said, Not(HasSubstr("["))) << "an interval of a model that nothing establishes";
}

}  // namespace
}  // namespace gapscope
