// What a row of the user's simulator says of the simulator's own steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/simulator_words.h"

namespace gapscope::internal::diagnosis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
  const std::vector<SimulatorRow> rows = {row, number_row("motor_damping", 0.08, 0.08)};
  return row_sentence(row, rows, kSample, Coordinates());
}

TEST(SimulatorWords, NameTheInertiaThatImplicitDampingAdds) {
  EXPECT_THAT(said(number_row("motor_inertia", 2.0e-3, 2.04e-3)), HasSubstr("at a step of 1 ms"));
  EXPECT_THAT(said(number_row("motor_inertia", 2.0e-3, 2.08e-3)), HasSubstr("at a step of 2 ms"));
  for (const double other : {1.9e-3, 2.06e-3, 2.3e-3})
    EXPECT_THAT(said(number_row("motor_inertia", 2.0e-3, other)), Not(HasSubstr("at a step of"))) << other;
}

TEST(SimulatorWords, NameTheHalfStepThatEulerIsAhead) {
  EXPECT_THAT(said(delay_row(3.0e-3, 2.0e-3)), HasSubstr("at a step of 2 ms"));
  EXPECT_THAT(said(delay_row(3.0e-3, 2.5e-3)), HasSubstr("at a step of 1 ms"));
  EXPECT_THAT(said(delay_row(3.0e-3, 2.2e-3)), Not(HasSubstr("at a step of")));
  EXPECT_THAT(said(delay_row(2.507e-3, 2.253e-3)), HasSubstr("at a step of 0.5 ms"));
  EXPECT_THAT(said(delay_row(3.0e-3, 5.0e-3)), HasSubstr("a step late"));
  SimulatorRow lag = delay_row(3.081e-3, 2.843e-3);  // a delay may be told as a lag
  lag.name = "actuator_lag";
  EXPECT_THAT(said(lag), HasSubstr("at a step of 0.5 ms"));
  lag.numbers.front().simulator = 2.2e-3;
  EXPECT_THAT(said(lag), Not(HasSubstr("at a step of")));
}

TEST(SimulatorWords, WriteAmountsAsPeopleReadThem) {
  SimulatorRow row = number_row("motor_damping", 2e-3, 1200.0);
  row.numbers.front().unit = "N m s/rad";
  EXPECT_EQ(said(row), "its motor damping is 1200 N·m s/rad where the drive's is 2 mN·m s/rad");
}

TEST(SimulatorWords, SayWhatThereIsOfAnEffectAndNotWhatIsNone) {
  SimulatorRow row;
  row.name = "load_dependent_friction", row.is_effect = row.differs = true, row.found_in = FoundIn::kDrive;
  row.numbers = {{"level_nm", "N m", 0.0, 0.0, {}, {}}, {"ratio", "-", 0.3, 0.0, {}, {}}};
  EXPECT_THAT(said(row), HasSubstr("the drive has (ratio 0.3)"));
  row.numbers[0].drive = 0.02;
  EXPECT_THAT(said(row), HasSubstr("the drive has (20 mN·m, ratio 0.3)"));
}

/// Nothing that would have to show differs; but where the model itself misses a side by far, nobody knows.
TEST(SimulatorWords, SayThatSomethingMayHideWhereTheModelMissesASide) {
  SimulatorComparison c;
  c.errors.simulator = 3e-3;
  c.rows = {number_row("motor_inertia", 1.0, 1.0)};
  c.rows.front().differs = false;
  EXPECT_THAT(sentence_beside(c, 2.0, 1.0, Coordinates()), HasSubstr("Your simulator lacks nothing"));
  EXPECT_THAT(sentence_beside(c, 35.0, 1.0, Coordinates()),
              ::testing::AllOf(HasSubstr("No row differs, but"), HasSubstr("leaves 35 floors on the drive"),
                               HasSubstr("3 mrad rms off the drive")));
  for (const double drive : {1.0, 60.0})
    EXPECT_THAT(sentence_beside(c, drive, 35.0, Coordinates()),
                ::testing::AllOf(HasSubstr("What differs is not told"),
                                 HasSubstr("35 floors on your simulator"), Not(HasSubstr("No row differs"))));
  c.floor = 1e-3;
  EXPECT_THAT(sentence_beside(c, 2.0, 1.0, Coordinates()),
              HasSubstr("What differs is not told: no row does, though your simulator is 3 floors off"));
  c.floor = 1.6e-3;
  EXPECT_THAT(sentence_beside(c, 2.0, 1.0, Coordinates()), HasSubstr("Your simulator lacks nothing"));
  c.rows.front().differs = true, c.rows.front().sentence = "its motor inertia is off";
  EXPECT_THAT(sentence_beside(c, 35.0, 1.0, Coordinates()), HasSubstr("differs from the drive: its motor"));
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
