// What a row of the user's simulator says of the simulator's own steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/simulator.h"
#include "gapscope/telling/card.h"
#include "support/told.h"

namespace gapscope {
namespace {

constexpr double kSample = 2e-3;  // s

SimulatorRow number_row(const std::string& name, double drive, double simulator) {
  SimulatorRow row;
  row.name = name, row.differs = true;
  row.numbers = {{name, "kg m^2", drive, simulator, {}, {}}};
  return row;
}

SimulatorRow delay_row(double drive, double simulator) {
  SimulatorRow row;
  row.name = "input_delay", row.is_effect = row.differs = true;
  row.numbers = {{"delay_s", "s", drive, simulator, {}, {}}};
  return row;
}

std::string said(const SimulatorRow& row) {
  SimulatorComparison c;
  c.state = ComparisonState::kRead, c.dt = kSample;
  c.rows = {row, number_row("motor_damping", 0.08, 0.08)};
  put_into_words(c, Coordinates());
  return c.rows.front().sentence;
}

TEST(SimulatorWords, NameTheInertiaThatImplicitDampingAdds) {
  EXPECT_TOLD(said(number_row("motor_inertia", 2.0e-3, 2.04e-3)));
  EXPECT_TOLD(said(number_row("motor_inertia", 2.0e-3, 2.08e-3)));
  for (const double other : {1.9e-3, 2.06e-3, 2.3e-3})
    EXPECT_TOLD(said(number_row("motor_inertia", 2.0e-3, other))) << other;
}

TEST(SimulatorWords, NameTheHalfStepThatEulerIsAhead) {
  EXPECT_TOLD(said(delay_row(3.0e-3, 2.0e-3)));
  EXPECT_TOLD(said(delay_row(3.0e-3, 2.5e-3)));
  EXPECT_TOLD(said(delay_row(3.0e-3, 2.2e-3)));
  EXPECT_TOLD(said(delay_row(2.507e-3, 2.253e-3)));
  EXPECT_TOLD(said(delay_row(3.0e-3, 5.0e-3)));
  SimulatorRow lag = delay_row(3.081e-3, 2.843e-3);  // a delay may be told as a lag
  lag.name = "actuator_lag";
  EXPECT_TOLD(said(lag));
  lag.numbers.front().simulator = 2.2e-3;
  EXPECT_TOLD(said(lag));
}

TEST(SimulatorWords, WriteAmountsAsPeopleReadThem) {
  SimulatorRow row = number_row("motor_damping", 2e-3, 1200.0);
  row.numbers.front().unit = "N m s/rad";
  EXPECT_TOLD(said(row));
}

TEST(SimulatorWords, SayWhatThereIsOfAnEffectAndNotWhatIsNone) {
  SimulatorRow row;
  row.name = "load_dependent_friction", row.is_effect = row.differs = true, row.found_in = FoundIn::kDrive;
  row.numbers = {{"level_nm", "N m", 0.0, 0.0, {}, {}}, {"ratio", "-", 0.3, 0.0, {}, {}}};
  EXPECT_TOLD(said(row));
  row.numbers[0].drive = 0.02;
  EXPECT_TOLD(said(row));
}

std::string beside(SimulatorComparison c, double drive_floors, double simulator_floors) {
  c.state = ComparisonState::kRead, c.drive_floors = drive_floors, c.simulator_floors = simulator_floors;
  put_into_words(c, Coordinates());
  return c.sentence;
}

/// Nothing that would have to show differs; but where the model itself misses a side by far, nobody knows.
TEST(SimulatorWords, SayThatSomethingMayHideWhereTheModelMissesASide) {
  SimulatorComparison c;
  c.errors.simulator = 3e-3;
  c.rows = {number_row("motor_inertia", 1.0, 1.0)};
  c.rows.front().differs = false;
  EXPECT_TOLD(beside(c, 2.0, 1.0));
  EXPECT_TOLD(beside(c, 35.0, 1.0));
  for (const double drive : {1.0, 60.0}) EXPECT_TOLD(beside(c, drive, 35.0));
  c.floor = 1e-3;
  EXPECT_TOLD(beside(c, 2.0, 1.0));
  c.floor = 1.6e-3;
  EXPECT_TOLD(beside(c, 2.0, 1.0));
  c.rows.front().differs = true;
  EXPECT_TOLD(beside(c, 35.0, 1.0));
}

}  // namespace
}  // namespace gapscope
