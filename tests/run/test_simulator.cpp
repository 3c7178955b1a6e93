// A user's simulator beside the drive, from files to sentences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <utility>

#include "base/interrupt.h"
#include "base/random.h"
#include "base/text.h"
#include "gapscope/recording/recording_file.h"
#include "results/scratch_folder.h"
#include "run/run_diagnosis.h"
#include "run/run_simulator.h"
#include "support/paper_model.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

std::string simulation_of(const std::string& gap, const std::string& noise, const std::string& amplitude) {
  return "encoder: {bits: 18}\nsimulation: {rate: 500, duration: 3, excitation: {sine: {amplitude: " +
         amplitude + ", frequency: 1}}, noise: " + noise +
         "}\nmodel: " + replaced(testing::kPaperModel, "0.019,", gap + ",");
}

/// A drive with a gap of 19 mrad and a simulator of it, each in its file.
class DriveAndSimulator {
 public:
  /// @param effects  of both, which the model does not have
  explicit DriveAndSimulator(const std::string& simulated_gap, const std::string& simulated_input = "0.58",
                             const std::string& effects = "") {
    const auto with_effects = [&](const std::string& simulation) {
      return replaced(effects.empty() ? simulation : replaced(simulation, "duration: 3", "duration: 1.5"),
                      "contact_damping: 0.05}", "contact_damping: 0.05}" + effects);
    };
    record("drive.csv", with_effects(simulation_of("0.019", "1.0e-5", "0.58")));
    record("sim.csv", with_effects(simulation_of(simulated_gap, "0", simulated_input)));
    std::ofstream(at("drive.yaml"))
        << "recording: {file: drive.csv, simulated: sim.csv}\nencoder: {bits: 18}\nmodel: "
        << testing::kPaperModel;
  }
  /// The same files of an encoder that is on the load of a drive of one body.
  void read_from_load() const {
    std::ofstream(at("drive.yaml"))
        << "recording: {file: drive.csv, simulated: sim.csv, columns: {position: x1}}\n"
           "encoder: {bits: 18, side: load}\nmodel: {parameters: {motor_inertia: 1.0e-3, torque_constant: 1, "
           "motor_damping: {estimate: true}, mass_ratio: 0}}\n";
  }
  /// The drive's own recording in the simulator's place.
  /// @param changed  of the position of row i
  void copy_drive(const std::function<double(std::size_t i, double x1)>& changed) const {
    Recording r = read_recording(at("drive.csv"), ReadOptions());
    for (std::size_t i = 0; i < r.size(); ++i) r.x1[i] = changed(i, r.x1[i]);
    write_csv(at("sim.csv"), r);
  }
  /// What the simulator wrote, in another unit.
  void rescale_simulator(double times) const {
    Recording r = read_recording(at("sim.csv"), ReadOptions());
    for (double& x : r.x1) x *= times;
    write_csv(at("sim.csv"), r);
  }
  internal::run::SimulatedRecordings read() const {
    const Configuration c = load_configuration(at("drive.yaml"));
    const Progress quiet = [](const std::string&) {};
    return internal::run::load_simulated(c, load_for_diagnosis(c, quiet), quiet);
  }
  /// Of the parameters alone: no effect is a candidate.
  DiagnosisResult diagnosed(const Progress& progress) const {
    const Configuration c = load_configuration(at("drive.yaml"));
    DiagnosisOptions options = diagnosis_options(c);
    for (const EffectEntry* e : effect_table()) options.excluded.emplace_back(e->name);
    options.progress = progress;
    return run_diagnosis(c, options).result;
  }
  SimulatorComparison compared() const {
    return *diagnosed([](const std::string&) {}).simulated;
  }

 private:
  std::string at(const char* name) const { return (folder_.path / name).string(); }
  void record(const char* name, const std::string& configuration) const {
    write_csv(at(name), simulated_recording(parse_configuration(configuration, "s.yaml")));
  }
  ScratchFolder folder_;
};

const SimulatorRow& row_of(const SimulatorComparison& c, const std::string& name) {
  return *std::find_if(c.rows.begin(), c.rows.end(), [&](const SimulatorRow& r) { return r.name == name; });
}

TEST(Simulator, OfTheSamePhysicsLacksNothing) {
  const SimulatorComparison c = DriveAndSimulator("0.019").compared();
  EXPECT_EQ(c.rows.size(), 2u);
  for (const SimulatorRow& row : c.rows) EXPECT_FALSE(row.differs) << row.name << " by " << row.floors;
  EXPECT_THAT(c.sentence, HasSubstr("lacks nothing"));
  EXPECT_TRUE(std::isnan(c.shrink));
}

/// What a search that was stopped had not come to would be told as the same in both.
TEST(Simulator, OfWhichTheSearchIsStoppedIsToldNothing) {
  for (const char* when : {"simulator: ", "laying drive and simulator"}) {
    const FinishFirst first;
    const DiagnosisResult r = DriveAndSimulator("0.016").diagnosed([&](const std::string& what) {
      if (what.starts_with(when)) request_finish();
    });
    EXPECT_TRUE(finish_requested()) << when;
    EXPECT_FALSE(r.simulated) << when;
    EXPECT_FALSE(r.diagnosis.stopped) << "of the drive all was told by then";
    EXPECT_THAT(r.diagnosis.warnings,
                ::testing::Contains(HasSubstr("stopped before the simulator was looked at to the end")));
  }
}

TEST(Simulator, ThatIsACopyOfTheRecordingIsRefused) {
  const DriveAndSimulator pair("0.019");
  const double quantum = 2.0 * kPi / std::exp2(18.0);
  auto random = random_stream(7, "copy");
  const std::pair<const char*, std::function<double(std::size_t, double)>> copies[] = {
      {"to the last digit", [](std::size_t, double x) { return x; }},
      {"one row changed", [&](std::size_t i, double x) { return i == 700 ? x + quantum : x; }},
      {"moved", [](std::size_t, double x) { return x + 1e-9; }},
      {"begun at zero", [](std::size_t, double x) { return x - 0.2; }},
      {"of seven digits", [](std::size_t, double x) { return std::round(1e7 * x) / 1e7; }},
      {"with noise", [&](std::size_t, double x) { return x + quantum / 6.0 * normal(random); }}};
  for (const auto& [how, changed] : copies) {
    pair.copy_drive(changed);
    EXPECT_THAT(testing::refusal([&] { pair.read(); }), HasSubstr("that is the recording, expected what"))
        << how;
  }
}

TEST(Simulator, WithAnotherGapIsToldSoAndWhatMendingItTakes) {
  const SimulatorComparison c = DriveAndSimulator("0.016").compared();
  ASSERT_EQ(c.rows.front().name, "gap");
  EXPECT_TRUE(c.rows.front().differs);
  EXPECT_FALSE(row_of(c, "motor_damping").differs);
  const ComparedNumber& gap = c.rows.front().numbers.front();
  EXPECT_NEAR(gap.drive, 0.019, 5e-5);
  EXPECT_NEAR(gap.simulator, 0.016, 5e-5);
  EXPECT_LT(gap.simulator_ci95.high, gap.drive_ci95.low);
  EXPECT_THAT(c.sentence, HasSubstr("its gap is 16"));
  EXPECT_GT(c.shrink, 0.8);
  EXPECT_LT(c.errors.stand_in_miss, 0.1 * c.errors.simulator) << "the stand-in is the simulator";
  ASSERT_EQ(c.traces.size(), 1u);
  EXPECT_EQ(c.traces[0].simulator.size(), c.traces[0].stand_in.size());
}

TEST(Simulator, ThatItsModelMissesByMoreThanItDiffersIsToldNoRow) {
  const std::string detents =
      ", effects: [{cogging_torque: {amplitude_nm: 0.006, periods_per_turn: 20, phase_rad: 0.4}}]";
  const SimulatorComparison c = DriveAndSimulator("0.0189", "0.58", detents).compared();
  EXPECT_GT(c.errors.stand_in_miss, c.errors.simulator);
  for (const SimulatorRow& row : c.rows) EXPECT_FALSE(row.differs) << row.name << " by " << row.floors;
  EXPECT_THAT(c.sentence, HasSubstr("no row can be compared"));
  EXPECT_TRUE(std::isnan(c.shrink));
}

TEST(Simulator, OfADriveWhoseEncoderIsOnTheLoadIsRead) {
  const DriveAndSimulator pair("0.016");
  pair.read_from_load();
  const internal::run::SimulatedRecordings read = pair.read();
  ASSERT_EQ(read.train.recordings.size(), 1u);
  const Recording& r = read.train.recordings.front();
  EXPECT_EQ(r.encoder, EncoderSide::kLoad);
  EXPECT_TRUE(r.x1.empty());
  EXPECT_EQ(r.size(), r.u.size());
  pair.rescale_simulator(1e-3);
  EXPECT_THAT(testing::refusal([&] { pair.read(); }), HasSubstr("moves 0.001 times as far"));
}

TEST(Simulator, OfAnotherInputIsRefusedByFileAndLine) {
  EXPECT_THAT(testing::refusal([] { DriveAndSimulator("0.019", "0.7").compared(); }),
              HasSubstr("sim.csv:3: the input is"));
}

TEST(Simulator, ThatWritesAnotherUnitIsRefusedWithTheReason) {
  const DriveAndSimulator pair("0.016");
  pair.rescale_simulator(180.0 / 3.14159265358979);
  EXPECT_THAT(
      testing::refusal([&] { pair.compared(); }),
      HasSubstr("sim.csv: moves 57.3 times as far as drive.csv and else alike: its position looks like "
                "deg where the recording has rad"));
  pair.rescale_simulator(1e-3 * 3.14159265358979 / 180.0);
  EXPECT_THAT(testing::refusal([&] { pair.compared(); }), HasSubstr("moves 0.001 times as far"));
}

}  // namespace
}  // namespace gapscope
