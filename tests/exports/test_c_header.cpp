// The C header, compiled by a C compiler that knows nothing else, moves as the simulator does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "exports/export.h"
#include "exports/exported_drives.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/simulate.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using testing::kTwoBodies;
using testing::random_drive_configuration;
using testing::rig_configuration;

constexpr const char* kProgram = R"(#include <stdio.h>
#include "drive.h"
int main(void) {
  STEM_state drive;
  double u;
  STEM_start(&drive);
  printf("%.17g\n", drive.x1);
  while (scanf("%lf", &u) == 1) printf("%.17g\n", STEM_step(&drive, u));
  return 0;
}
)";

/// x1 at the samples and once more, by the header alone.
std::vector<double> c_program_motion(const ExportedFile& header, const std::vector<double>& u) {
  const testing::TemporaryFile place("", "mark");
  const std::string folder = place.folder().string(), stem = header.name.substr(0, header.name.find('.'));
  std::string program = kProgram;
  for (auto at = program.find("STEM"); at != program.npos; at = program.find("STEM"))
    program.replace(at, 4, stem);
  std::ofstream(folder + "/drive.h") << header.text;
  std::ofstream(folder + "/main.c") << program;
  {
    std::ofstream input(folder + "/u");
    for (const double value : u) input << fmt::format("{:.17g}\n", value);
  }
  const std::string run =
      "cd " + folder +
      " && cc -std=c99 -O1 -Wall -Wextra -Werror -pedantic main.c -o main -lm && ./main <u >x1";
  EXPECT_EQ(std::system(run.c_str()), 0);
  std::vector<double> x1;
  std::ifstream output(folder + "/x1");
  for (double value; output >> value;) x1.push_back(value);
  return x1;
}

/// The largest difference between header and simulator at the samples [rad].
double distance(const Configuration& c, DriveExport* exported = nullptr) {
  const SimulationConfig& s = *c.simulation;
  const std::vector<double> u = sample(s.excitation, s.rate, s.samples(), s.seed);
  SimulationOptions options;
  options.rate = s.rate;
  options.initial = {s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2};
  const std::vector<double> expected = simulate(s.plant.plant_model(), u, options).x1;
  const DriveExport drive = export_drive(c, ExportFormat::kC);
  const std::vector<double> moved = c_program_motion(drive.files[0], u);
  if (exported != nullptr) *exported = drive;
  EXPECT_EQ(moved.size(), expected.size() + 1);
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(expected.size(), moved.size()); ++i)
    worst = std::max(worst, std::abs(moved[i] - expected[i]));
  return worst;
}

constexpr double kSame = 1e-9;  // rad

TEST(CHeader, MovesAsTheSimulatorDoesOnTheExperiment) {
  DriveExport drive;
  EXPECT_LE(
      distance(load_configuration(std::string(GAPSCOPE_SOURCE_DIR) + "/configs/02_experiment.yaml"), &drive),
      kSame);
  for (const CarriedPart& part : drive.certificate.parts)
    EXPECT_EQ(part.fidelity, Fidelity::kExact) << part.part;
  EXPECT_LE(drive.certificate.errors.at(0).max, kSame);
}

TEST(CHeader, MovesAsTheSimulatorDoesOnRandomDrives) {
  for (std::uint64_t seed = 301; seed <= 304; ++seed)
    EXPECT_LE(distance(random_drive_configuration(seed)), kSame) << seed;
}

TEST(CHeader, MovesAsTheSimulatorDoesWithEveryStructure) {
  EXPECT_LE(distance(rig_configuration(", mass_ratio: 0")), kSame);
  EXPECT_LE(distance(rig_configuration(", gap: 0.019, contact_stiffness: 200, contact_damping: 0.05",
                                       "  load: locked\n")),
            kSame);
}

// Several at once: to compile a program takes longer than to run it, and one that is wrong moves x1 by far
// more.
TEST(CHeader, MovesAsTheSimulatorDoesWithEveryEffectThatItSaysIsExact) {
  constexpr const char* kMotor[] = {
      "{motor_coulomb_friction: {level_nm: 0.01}}, {quadratic_drag: {coefficient_nms2: 0.01}}, "
      "{cogging_torque: {amplitude_nm: 0.01, periods_per_turn: 24, phase_rad: 0.3}}, "
      "{torque_saturation: {knee: 0.7, sharpness: 3}}, {input_delay: {delay_s: 1.3e-3}}",
      "{friction_asymmetry: {level_nm: 0.01, coulomb_ratio: 0.4, viscous_ratio: 0.2}}, "
      "{cogging_torque: {amplitude_nm: 0.01, periods_per_turn: 24, second_harmonic: 0.3, "
      "second_harmonic_cos: -0.2, third_harmonic: 0.1, third_harmonic_cos: 0.2}}, "
      "{load_unbalance: {amplitude_nm: 0.02, periods_per_turn: 2.5}}, {input_dead_zone: {width: 0.05}}, "
      "{actuator_lag: {time_constant_s: 2.0e-3}}",
      "{stribeck_friction: {level_nm: 0.01, stiction_ratio: 0.5, stribeck_speed_rad_s: 0.1}}, "
      "{torque_ripple: {ratio: 0.1, periods_per_turn: 12, second_harmonic: 0.2}}, "
      "{load_unbalance: {amplitude_nm: 0.02, phase_rad: 0.7}}, {constant_load_torque: {torque_nm: 0.01}}"};
  constexpr const char* kContact[] = {"{shaft_compliance: {stiffness_nm_rad: 90}}",
                                      "{contact_adhesion: {release_nm: 0.01}}"};
  const auto expect_same = [](const std::string& numbers, const char* effects) {
    DriveExport drive;
    EXPECT_LE(distance(rig_configuration(numbers, fmt::format("  effects: [{}]\n", effects)), &drive), kSame)
        << effects << numbers;
    for (const CarriedPart& part : drive.certificate.parts)
      EXPECT_EQ(part.fidelity, Fidelity::kExact) << part.part << numbers;
  };
  for (const char* effects : kMotor)
    for (const std::string& numbers : {kTwoBodies, std::string(", mass_ratio: 0")})
      expect_same(numbers, effects);
  for (const char* effects : kContact) expect_same(kTwoBodies, effects);
}

TEST(CHeader, HidesNoHeaderOfTheSystem) {
  Configuration c = rig_configuration(", mass_ratio: 0");
  const auto file_of = [&](const char* name) {
    c.name = name;
    return export_drive(c, ExportFormat::kC).files[0].name;
  };
  EXPECT_EQ(file_of("rig"), "rig.h");
  for (const char* name : {"math", "string", "Time", "features"})
    EXPECT_EQ(file_of(name), "drive_" + std::string(name) + ".h");
}

TEST(CHeader, NamesWhatItsCodeDoesNotHave) {
  const DriveExport drive = export_drive(
      rig_configuration(kTwoBodies, "  effects: [{gap_eccentricity: {amplitude_rad: 1.0e-3}}]\n"),
      ExportFormat::kC);
  EXPECT_EQ(drive.certificate.parts.back().fidelity, Fidelity::kLeftOut);
  EXPECT_GT(drive.certificate.errors.at(0).max, 1e-5);
}

}  // namespace
}  // namespace gapscope
