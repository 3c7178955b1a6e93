// The user's simulator in the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/simulator.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::line_with;

SimulatorRow friction(FoundIn where, double drive, double simulator) {
  SimulatorRow row;
  row.name = "motor_coulomb_friction", row.is_effect = row.differs = true, row.found_in = where;
  row.numbers = {{"level_nm", "N m", drive, simulator, {drive - 1e-3, drive + 1e-3}, {}}};
  row.size = 4e-4, row.floors = 20.0, row.shrink = 0.75;
  return row;
}

DiagnosisResult beside(const SimulatorRow& row) {
  DiagnosisResult r{"rig", "0.1", "", {}, {}};
  SimulatorComparison& c = r.simulated.emplace();
  c.sentence = "Your simulator differs from the drive.";
  c.floor = 2e-5, c.errors = {0.01, 0.0101, 1e-5, 0.0025, 0.0025}, c.shrink = 0.75;
  SimulatorRow alike = row;
  alike.name = "gap", alike.is_effect = alike.differs = false, alike.floors = 0.0,
  alike.found_in = FoundIn::kBoth;
  c.rows = {row, alike};
  SimulatorTrace t;
  t.file = "held.csv", t.dt = 1e-3, t.scored_from = 1;
  t.x1 = {0.0, 1.0, 2.0}, t.simulator = {0.0, 1.5, 2.5}, t.fitted = {0.0, 1.0, 2.1};
  c.traces = {t};
  return r;
}

TEST(SimulatorReport, TellsInWhichOfBothAnEffectIs) {
  const std::string both = internal::report::simulator_table(beside(friction(FoundIn::kBoth, 0.05, 0.02)));
  EXPECT_TOLD(line_with(both, "| `motor_coulomb_friction` | 50.0"));
  EXPECT_TOLD(line_with(both, "| not separated"));
  const std::string drive = internal::report::simulator_table(beside(friction(FoundIn::kDrive, 0.05, 0.0)));
  EXPECT_TOLD(line_with(drive, "| 50.0 ± 1.0"));
  EXPECT_TOLD(line_with(drive, "misses your simulator by"));
}

TEST(SimulatorReport, ShowsOfWhatASideHasNotEveryAmountThatItsIntervalHolds) {
  SimulatorRow row = friction(FoundIn::kDrive, 0.05, 1e-4);
  row.numbers[0].simulator_ci95 = {-3e-4, 5e-4};
  EXPECT_TOLD(line_with(internal::report::simulator_table(beside(row)), "| none: 100 ±"));
  row.name = "load_dependent_friction";
  row.numbers = {{"level_nm", "N m", 0.0, 0.0, {}, {}},
                 {"ratio", "-", 0.3, 0.01, {0.28, 0.32}, {-0.01, 0.03}}};
  EXPECT_TOLD(line_with(internal::report::simulator_table(beside(row)), "| level 0 N·m,"));
  row.name = "cogging_torque";  // where a wave that is none begins says nothing
  row.numbers = {{"amplitude_nm", "N m", 0.05, 1e-4, {0.049, 0.051}, {-3e-4, 5e-4}},
                 {"phase_rad", "rad", 0.3, 1.0, {0.2, 0.4}, {-2.0, 4.0}}};
  EXPECT_TOLD(line_with(internal::report::simulator_table(beside(row)), "| none: amplitude 100"));
}

TEST(SimulatorReport, HasTheRowsInTheOrderOfItsSentenceAndNoMinusBeforeAZero) {
  DiagnosisResult r = beside(friction(FoundIn::kDrive, 0.05, 0.0));
  SimulatorRow larger = r.simulated->rows.front();
  larger.name = "cogging_torque", larger.size = 9e-4, larger.shrink = -1e-3;
  r.simulated->rows.insert(r.simulated->rows.begin() + 1, larger);
  const std::string text = internal::report::simulator_table(r);
  EXPECT_LT(text.find("| `motor_coulomb_friction`"), text.find("| `cogging_torque`"));
  EXPECT_TOLD(line_with(text, "| 900 µrad |"));
}

TEST(SimulatorReport, DrawsDriveSimulatorAndModelWithTheDifferencesBelow) {
  const auto figure = internal::report::diagnosis_simulator(beside(friction(FoundIn::kBoth, 0.05, 0.02)));
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[0].series.size(), 3u);
  ASSERT_EQ(figure.panels[1].series.size(), 2u);
  EXPECT_EQ(figure.panels[1].series[0].y, (std::vector<double>{0.5, 0.5})) << "what was fitted is not shown";
  DiagnosisResult without{"rig", "0.1", "", {}, {}};
  EXPECT_FALSE(internal::report::diagnosis_simulator(without).expected);
  EXPECT_EQ(internal::report::simulator_table(without), "");
}

}  // namespace
}  // namespace gapscope
