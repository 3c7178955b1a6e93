// A user's simulator beside the drive, as one types it: MuJoCo's own answer in a CSV.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "exports/mujoco_engine.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::text_of;
using testing::Workplace;

constexpr double kRowRate = 500.0;
constexpr int kRows = 1000, kStepsARow = 20;

std::string one_body(double inertia, const std::string& effects) {
  return fmt::format(
      "encoder: {{bits: 18}}\nmodel: {{parameters: {{torque_constant: 0.172, mass_ratio: 0, motor_inertia: "
      "{{value: {}, estimate: true}}, motor_damping: {{value: 0.05, estimate: true}}}}, effects: [{}]}}\n",
      inertia, effects);
}

std::string under(const std::string& excitation, const std::string& more = "") {
  return "simulation: {rate: 500, duration: 2, excitation: {" + excitation + "}" + more + "}\n";
}

/// Time, input and position of a recording, and MuJoCo's answer to it.
struct Rows {
  std::vector<double> t, u;
};

Rows rows_of(const std::filesystem::path& csv) {
  std::istringstream lines(text_of(csv));
  std::string line;
  std::getline(lines, line);
  Rows rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    double t = 0.0, u = 0.0;
    char comma = 0;
    cells >> t >> comma >> u;
    rows.t.push_back(t), rows.u.push_back(u);
  }
  return rows;
}

std::string answer(const std::string& mjcf, const Rows& to) {
  testing::MujocoEngineRun engine(mjcf);
  std::vector<double> u;
  for (const double row : to.u) u.insert(u.end(), kStepsARow, row);
  const std::vector<double> x1 = engine.motion(1.0 / kRowRate / kStepsARow, mjINT_RK4, u);
  std::string text = "t,u,x1\n";
  for (std::size_t i = 0; i < to.t.size(); ++i)
    text += fmt::format("{},{},{}\n", to.t[i], to.u[i], x1.at(i * kStepsARow));
  return text;
}

constexpr const char *kDriveHas = "{input_delay: {delay_s: 4.0e-3}}",
                     *kSimulatorHas = "{motor_coulomb_friction: {level_nm: 0.015}}";

/// A drive with a delay, and in MuJoCo a model of it without one, but with friction that the drive has not.
class Pair {
 public:
  Pair() {
    place.file("theirs.yaml", "name: theirs\n" + under("sine: {amplitude: 0.5, frequency: 1}") +
                                  one_body(2.0e-3, kSimulatorHas));
    EXPECT_EQ(place.run("export theirs.yaml --to mjcf -o theirs").status, 0);
    record("drive", "sine: {amplitude: 0.5, frequency: 1.5}");
    record("bench", "multisine: {amplitude: 0.4, lines: 5, low: 0.7, high: 5}");
    place.file("drive.yaml",
               "name: d\nrecording: {file: drive.csv, held_out: bench.csv}\n" + one_body(1.8e-3, ""));
  }
  Workplace place;

 private:
  void record(const std::string& name, const std::string& excitation) {
    place.file("c.yaml", "name: c\n" + under(excitation, ", noise: 1.0e-5") + one_body(2.0e-3, kDriveHas));
    const auto made = place.run("simulate c.yaml -o " + name + ".csv");
    ASSERT_EQ(made.status, 0) << made.err;
    const Rows rows = rows_of(place.folder() / (name + ".csv"));
    ASSERT_EQ(rows.t.size(), static_cast<std::size_t>(kRows));
    place.file("mujoco_" + name + ".csv", answer(text_of(place.folder() / "theirs/theirs.xml"), rows));
  }
};

/// Of the table in diagnosis.json.
nlohmann::json row_named(const nlohmann::json& simulated, const std::string& name) {
  for (const auto& row : simulated["rows"])
    if (row["name"] == name) return row;
  return nullptr;
}

TEST(SimulatorBeside, TellsWhatIsInTheDriveInTheSimulatorAndInNeither) {
  Pair pair;
  Workplace& place = pair.place;
  const auto told =
      place.run("diagnose drive.yaml -o d -j 1 --simulated mujoco_drive.csv --simulated mujoco_bench.csv" +
                testing::excluding_all_but({"motor_coulomb_friction", "input_delay", "input_dead_zone"}));
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("Your simulator differs from the drive"));
  const nlohmann::json simulated =
      nlohmann::json::parse(text_of(place.folder() / "d/diagnosis.json"))["simulated"];
  const nlohmann::json delay = row_named(simulated, "input_delay"),
                       friction = row_named(simulated, "motor_coulomb_friction");
  EXPECT_EQ(delay["found_in"], "drive");
  EXPECT_NEAR(delay["numbers"][0]["drive"].get<double>(), 4.0e-3, 1e-4);
  EXPECT_EQ(friction["found_in"], "simulator");
  EXPECT_NEAR(friction["numbers"][0]["simulator"].get<double>(), 0.015, 5e-4);
  EXPECT_NEAR(friction["numbers"][0]["drive"].get<double>(), 0.0, 5e-4);
  EXPECT_EQ(row_named(simulated, "motor_inertia")["differs"], false);
  EXPECT_GT(simulated["shrink_all"].get<double>(), 0.95);
  const std::string report = text_of(place.folder() / "d/report.md");
  EXPECT_THAT(report, AllOf(HasSubstr("only in the drive"), HasSubstr("only in the simulator")));
}

/// A second of a drive at 100 Hz, its third line another one.
std::string table(const std::string& third = "0.01,0.2,0.0001") {
  std::string text = "t,u,x1\n0,0.1,0\n" + third + "\n";
  for (int i = 2; i < 100; ++i) text += fmt::format("{},{},{}\n", 0.01 * i, i % 2 == 0 ? 0.1 : 0.2, 1e-4 * i);
  return text;
}

TEST(SimulatorBeside, IsRefusedByFileLineAndExpectation) {
  Workplace place;
  const std::string model = one_body(2.0e-3, "");
  place.file("drive.csv", table());
  place.file("drive.yaml", "name: d\nrecording: {file: drive.csv}\n" + model);
  place.file("late.csv", table("0.013,0.2,0.0001"));
  place.file("other.csv", table("0.01,0.25,0.0001"));
  place.file("broken.csv", table("0.01,0.2,fast"));
  place.file("copy.csv", table());
  place.file("named.yaml", "name: d\nrecording:\n  file: drive.csv\n  simulated: gone.csv\n" + model);
  for (const auto& [arguments, found, expected] :
       {std::tuple("drive.yaml --simulated late.csv", "late.csv:3: there is no row at 0.01 s",
                   "expected one at every time of drive.csv"),
        std::tuple("drive.yaml --simulated other.csv",
                   "other.csv:3: the input is 0.25 at 0.01 s where drive.csv has 0.2",
                   "expected the simulator's answer"),
        std::tuple("drive.yaml --simulated broken.csv", "broken.csv:3: ", "expected a finite number"),
        std::tuple("drive.yaml --simulated gone.csv", "--simulated: there is no simulated recording gone.csv",
                   "expected a file"),
        std::tuple("named.yaml", "named.yaml:4: there is no simulated recording gone.csv", "expected a file"),
        std::tuple("drive.yaml --simulated ./drive.csv",
                   "--simulated names ./drive.csv, which is named already",
                   "expected a file of its own with what the simulator answers"),
        std::tuple("drive.yaml --simulated copy.csv", "copy.csv: follows drive.csv to 0 rad where that moves",
                   "expected what the simulator answers to its input"),
        std::tuple("drive.yaml --simulated late.csv --simulated other.csv", "--simulated names 2 files",
                   "expected one for each of recording: file (1)")}) {
    const auto refused = place.run(std::string("diagnose ") + arguments + " -o d");
    EXPECT_EQ(refused.status, 2) << arguments;
    EXPECT_THAT(refused.err, AllOf(HasSubstr(found), HasSubstr(expected)));
  }
  EXPECT_FALSE(place.content().contains("d"));
}

}  // namespace
}  // namespace gapscope
