// A servo that takes goals: from its recording to a model under its controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "cli/executable.h"
#include "support/data.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::text_of;
using testing::Workplace;

const char* const kLoop =
    "name: servo\nencoder: {bits: 16}\n"
    "simulation: {rate: 500, duration: 3, initial: {x1: 0, w1: 0, x2: 0, w2: 0}, excitation: {multisine: "
    "{amplitude: 0.5, low: 0.5, high: 4, lines: 6}}}\n"
    "model:\n  parameters: {motor_inertia: 0.001, torque_constant: 0.1, mass_ratio: 0, motor_damping: 0.02}\n"
    "controller: {position: {gain: 3, derivative: 0.05}}\n";

/// A column of a CSV.
std::vector<double> column(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  std::string line, field;
  std::getline(lines, line);
  std::istringstream header(line);
  std::ptrdiff_t at = -1, i = 0;
  for (; std::getline(header, field, ','); ++i)
    if (field == name) at = i;
  std::vector<double> values;
  while (at >= 0 && std::getline(lines, line)) {
    std::istringstream row(line);
    for (std::ptrdiff_t k = 0; k <= at; ++k) std::getline(row, field, ',');
    values.push_back(std::stod(field));
  }
  return values;
}

TEST(ServoOfGoals, IsSimulatedUnderItsControllerWhichFittedYamlHas) {
  Workplace place;
  place.file("loop.yaml", kLoop);
  const auto made = place.run("simulate loop.yaml -o servo.csv");
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string recorded = text_of(place.folder() / "servo.csv");
  EXPECT_THAT(recorded, HasSubstr("t,u,x1,target,mode"));
  place.file(
      "servo.yaml",
      "name: servo\nencoder: {bits: 16}\nrecording: {file: servo.csv, columns: {target: target}}\n"
      "controller: {position: {gain: {value: 2, estimate: true}, derivative: 0.05}}\n"
      "model:\n  parameters: {motor_inertia: 0.001, torque_constant: 0.1, mass_ratio: 0, motor_damping: "
      "{value: 0.01, estimate: true}}\n");
  const auto fit = place.run("fit servo.yaml -o fitted");
  ASSERT_EQ(fit.status, 0) << fit.err;
  const std::string yaml = text_of(place.folder() / "fitted/fitted.yaml");
  EXPECT_THAT(yaml, HasSubstr("controller:"));
  EXPECT_THAT(yaml, HasSubstr("input: \"target_rad\""));
  const auto again = place.run("simulate fitted/fitted.yaml -o model.csv");
  ASSERT_EQ(again.status, 0) << again.err;
  const std::vector<double> x = column(recorded, "x1"),
                            model = column(text_of(place.folder() / "model.csv"), "x1");
  ASSERT_EQ(x.size(), model.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(x[i] - model[i]));
  EXPECT_LT(worst, 0.01);  // of 0.5 rad
  EXPECT_EQ(place.run("run fitted/fitted.yaml -o again").status, 0);
}

/// The lines of "Your own drive" on such a servo, on a real one.
TEST(ServoOfGoals, TheDocumentedLinesRunOnARealOne) {
  GAPSCOPE_NEEDS_DATA();
  Workplace place;
  for (const auto& [name, motion] : {std::pair{"servo.csv", "sin_time_square_kp400.csv"},
                                     {"servo_other_motion.csv", "up_and_down_kp400.csv"}})
    place.file(name, text_of(testing::data_folder() / "xl330" / motion));
  const std::string page =
      std::regex_replace(text_of(std::filesystem::path(GAPSCOPE_SOURCE_DIR) / "docs/your_own_drive.md"),
                         std::regex("\\\\\n *"), "");
  std::smatch line;
  ASSERT_TRUE(std::regex_search(page, line, std::regex("gapscope (init servo.csv [^#\n]*--target[^#\n]*)")));
  const auto init = place.run(line[1]);
  ASSERT_EQ(init.status, 0) << init.err;
  const auto fit = place.run("fit goal.yaml -o reports/goal");
  ASSERT_EQ(fit.status, 0) << fit.err;
  const std::vector<double> stored =
      column(text_of(place.folder() / "reports/goal/traces/1_servo.csv"), "x1_rad");
  const auto simulated = place.run("simulate reports/goal/fitted.yaml -o model.csv");
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const std::vector<double> model = column(text_of(place.folder() / "model.csv"), "x1");
  double error = 0.0, motion = 0.0;
  for (std::size_t i = 0; i < std::min(stored.size(), model.size()); ++i) {
    error += std::pow(stored[i] - model[i], 2);
    motion += stored[i] * stored[i];
  }
  EXPECT_LT(error, 0.1 * motion) << "the model under its controller follows the goal as the servo does";
}

}  // namespace
}  // namespace gapscope
