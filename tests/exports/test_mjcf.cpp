// Every MJCF that is exported, run by MuJoCo itself: its certificate says beforehand what the engine does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "exports/export.h"
#include "exports/exported_drives.h"
#include "exports/mujoco_engine.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::kTwoBodies;
using testing::MujocoEngineRun;
using ::testing::Not;
using testing::random_drive_configuration;
using testing::rig_configuration;

/// The target against the simulator at every time that is a sample of one and a step of the other.
struct Measured {
  double rms = 0.0, max = 0.0;
  bool diverges = false;
};

/// A drive with what the simulator makes of it.
struct Judged {
  explicit Judged(const Configuration& c)
      : drive(export_drive(c, ExportFormat::kMjcf)), engine(drive.files[0].text) {
    const SimulationConfig& s = *c.simulation;
    u = sample(s.excitation, s.rate, s.samples(), s.seed);
    SimulationOptions options;
    options.rate = s.rate;
    options.initial = {s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2};
    x1 = simulate(s.plant.plant_model(), u, options).x1;
    dt = 1.0 / s.rate;
  }

  Measured measure(const TargetError& at) {
    const double ratio = at.step / dt;
    std::vector<double> input;
    for (std::size_t i = 0; static_cast<double>(i + 1) * ratio <= static_cast<double>(u.size()) + 1e-6; ++i)
      input.push_back(
          u[std::min(static_cast<std::size_t>(static_cast<double>(i) * ratio + 1e-7), u.size() - 1)]);
    const std::vector<double> moved =
        engine.motion(at.step, at.integrator == "RK4" ? mjINT_RK4 : mjINT_EULER, input);
    Measured m;
    m.diverges = moved.size() <= input.size();
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const double place = static_cast<double>(i) * ratio, sample = std::round(place);
      if (std::abs(place - sample) > 1e-6 || sample >= static_cast<double>(x1.size())) continue;
      const double e = moved[i] - x1[static_cast<std::size_t>(sample)];
      sum += e * e, count += 1.0, m.max = std::max(m.max, std::abs(e));
    }
    m.rms = std::sqrt(sum / count);
    return m;
  }

  DriveExport drive;
  MujocoEngineRun engine;
  std::vector<double> u, x1;
  double dt = 0.0;
};

bool is_one_of(double step, std::initializer_list<double> steps) {
  return std::any_of(steps.begin(), steps.end(), [&](double s) { return std::abs(step - s) < 1e-9; });
}

constexpr double kRounding = 1e-12;  // rad, that two ways to the same motion differ by

/// At 0.1, 0.4, 1 and 2 ms and wherever it diverges.
void expect_foretold(Judged& judged) {
  const Certificate& c = judged.drive.certificate;
  for (const TargetError& error : c.errors) {
    if (!error.diverges && !is_one_of(error.step, {1e-4, 4e-4, 1e-3, 2e-3})) continue;
    const Measured m = judged.measure(error);
    SCOPED_TRACE(c.name + " " + error.integrator + " " + std::to_string(error.step));
    EXPECT_EQ(error.diverges, m.diverges);
    if (error.diverges || m.diverges) continue;
    if (error.unstable) {  // a chaos in which no two engines agree but in size
      EXPECT_NEAR(std::log(error.rms), std::log(m.rms), std::log(3.0));
      continue;
    }
    EXPECT_NEAR(error.rms, m.rms, 0.25 * m.rms + kRounding);
    EXPECT_LE(m.max, 1.3 * error.max + kRounding);
  }
}

bool all_exact(const Certificate& c) {
  return std::all_of(c.parts.begin(), c.parts.end(),
                     [](const CarriedPart& p) { return p.fidelity == Fidelity::kExact; });
}

Fidelity fidelity_of(const Certificate& c, const std::string& part) {
  for (const CarriedPart& p : c.parts)
    if (p.part == part) return p.fidelity;
  ADD_FAILURE() << part << " is in no certificate";
  return Fidelity::kLeftOut;
}

TEST(Mjcf, OfTheExperimentDoesInMuJoCoWhatItsCertificateSays) {
  Configuration c = load_configuration(std::string(GAPSCOPE_SOURCE_DIR) + "/configs/02_experiment.yaml");
  c.simulation->duration = 4.0;
  Judged judged(c);
  expect_foretold(judged);
  const Certificate& certificate = judged.drive.certificate;
  const auto first = std::find_if(certificate.errors.begin(), certificate.errors.end(),
                                  [](const TargetError& e) { return e.diverges; });
  ASSERT_NE(first, certificate.errors.end());
  EXPECT_EQ(first->integrator, "Euler");
  EXPECT_DOUBLE_EQ(first->step, 4e-3);
  // Debian's engine and the measured table: within the encoder at 0.01 ms by either integrator.
  for (const StepLimits& l : certificate.limits) EXPECT_GE(l.within_encoder, 1e-5) << l.integrator;
  for (const TargetError& error : certificate.errors)
    if (error.within_encoder) {
      EXPECT_LE(judged.measure(error).rms, certificate.encoder_floor) << error.integrator << error.step;
    }
}

/// GAPSCOPE_RANDOM_DRIVES sets the number of random drives, 8 if it is not set.
std::uint64_t drives_wanted() {
  const char* given = std::getenv("GAPSCOPE_RANDOM_DRIVES");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 8;
}

TEST(Mjcf, OfRandomDrivesDoesInMuJoCoWhatItsCertificateSays) {
  int exact = 0, within = 0;
  for (std::uint64_t seed = 301; seed < 301 + drives_wanted(); ++seed) {
    Judged judged(random_drive_configuration(seed));
    expect_foretold(judged);
    const Certificate& c = judged.drive.certificate;
    exact += all_exact(c) ? 1 : 0;
    for (const TargetError& error : c.errors)
      if (error.within_encoder && is_one_of(error.step, {2e-5, 1e-4})) {
        ++within;
        EXPECT_LE(judged.measure(error).rms, c.encoder_floor) << c.name << error.integrator << error.step;
      }
  }
  RecordProperty("exact_at_0.1_ms", exact);
  RecordProperty("rows_within_the_encoder", within);
  EXPECT_GE(within, 1) << "a line that nothing is held to";
}

TEST(Mjcf, CarriesEveryStructureOfADrive) {
  const Configuration drives[] = {
      rig_configuration(kTwoBodies),
      rig_configuration(", mass_ratio: 0"),
      rig_configuration(", gap: 0.019, contact_stiffness: 200, contact_damping: 0.05", "  load: locked\n"),
      rig_configuration(kTwoBodies, "", "coordinates: translation\nencoder: {quantum: 6.0e-6}"),
  };
  for (const Configuration& c : drives) {
    Judged judged(c);
    expect_foretold(judged);
    EXPECT_EQ(judged.engine.model().nv,
              c.simulation->plant.structure.has_load && c.simulation->plant.structure.load == LoadKind::kFree
                  ? 2
                  : 1);
  }
}

TEST(Mjcf, CarriesTheEffectsThatItSaysItDoes) {
  struct Case {
    const char* effect;
    const char* name;
  };
  const Case exact[] = {
      {"motor_coulomb_friction: {level_nm: 0.01}", "motor_coulomb_friction"},
      {"friction_asymmetry: {level_nm: 0.01, coulomb_ratio: 0.4}", "friction_asymmetry"},
      {"constant_load_torque: {torque_nm: 0.01}", "constant_load_torque"},
      {"load_unbalance: {amplitude_nm: 0.01, phase_rad: 0.7}", "load_unbalance"},
      {"actuator_lag: {time_constant_s: 2.0e-3}", "actuator_lag"},
  };
  for (const Case& one : exact)
    for (const std::string& numbers : {kTwoBodies, std::string(", mass_ratio: 0")}) {
      Judged judged(rig_configuration(numbers, fmt::format("  effects: [{{{}}}]\n", one.effect)));
      SCOPED_TRACE(one.effect + numbers);
      EXPECT_EQ(fidelity_of(judged.drive.certificate, one.name), Fidelity::kExact);
      expect_foretold(judged);
      // What is exact comes closer with the step: with what it says of the effect in the file, to a
      // thousandth of the travel; without it the effects here move x1 by a hundredth and more.
      const TargetError& finest = judged.drive.certificate.errors.front();
      EXPECT_LE(judged.measure(finest).max, 1e-3 * judged.drive.certificate.travel);
    }
}

/// MuJoCo asks for actuators with a state behind those without one.
TEST(Mjcf, CarriesALagBesideAConstantTorque) {
  Judged judged(rig_configuration(
      kTwoBodies,
      "  effects: [{actuator_lag: {time_constant_s: 2.0e-3}}, {constant_load_torque: {torque_nm: 0.01}}]\n"));
  expect_foretold(judged);
}

TEST(Mjcf, NamesWhatItLeavesOutAndWhy) {
  const DriveExport drive = export_drive(
      rig_configuration(kTwoBodies,
                        "  effects: [{cogging_torque: {amplitude_nm: 0.01, periods_per_turn: 24}}, "
                        "{input_delay: {delay_s: 1.0e-3}}, {stribeck_friction: {level_nm: 0.01, "
                        "stiction_ratio: 0.5, stribeck_speed_rad_s: 0.1}}]\n"),
      ExportFormat::kMjcf);
  const Certificate& c = drive.certificate;
  EXPECT_EQ(fidelity_of(c, "cogging_torque"), Fidelity::kLeftOut);
  EXPECT_EQ(fidelity_of(c, "input_delay"), Fidelity::kLeftOut);
  EXPECT_EQ(fidelity_of(c, "stribeck_friction"), Fidelity::kApproximate);
  EXPECT_THAT(certificate_text(c), HasSubstr("| `cogging_torque` | **left out** |"));
}

/// What it only approximates takes it far from the model at any step; how large one may be is told.
TEST(Mjcf, OfADriveThatItOnlyApproximatesTellsTheStepsByItsOwnMotion) {
  const DriveExport drive = export_drive(
      rig_configuration(kTwoBodies, "  effects: [{load_dependent_friction: {level_nm: 0.01, ratio: 0.6}}]\n"),
      ExportFormat::kMjcf);
  const Certificate& c = drive.certificate;
  ASSERT_EQ(c.limits.size(), 2u);
  ASSERT_GT(c.errors.front().max, 0.1 * c.travel) << "else nothing is asked";
  for (const StepLimits& l : c.limits) {
    EXPECT_TRUE(l.against_itself) << l.integrator;
    EXPECT_GT(l.largest, 1e-4) << l.integrator;
  }
  EXPECT_GT(c.errors.size(), 8u);
  EXPECT_THAT(certificate_text(c), HasSubstr("its own motion at the finest step"));
  EXPECT_THAT(c.warnings.back(), HasSubstr("load_dependent_friction) this file is 51"));
}

/// A load that friction holds against a torque: with the defaults it creeps, in the engine as foretold.
TEST(Mjcf, WarnsOfTheCreepOfMuJoCosDefaults) {
  Judged judged(rig_configuration(kTwoBodies));
  const Certificate& c = judged.drive.certificate;
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_THAT(c.warnings[0], HasSubstr("creeps"));
  std::string bare = judged.drive.files[0].text;
  for (const std::string attribute : {"solreffriction", "solimpfriction"}) {
    for (auto at = bare.find(" " + attribute + "=\""); at != bare.npos;
         at = bare.find(" " + attribute + "=\""))
      bare.erase(at, bare.find('"', at + attribute.size() + 3) + 1 - at);
  }
  TargetError at;
  at.integrator = "RK4", at.step = 1e-4;
  const double held = judged.measure(at).rms;
  DriveExport plain = judged.drive;
  MujocoEngineRun creeping(bare);
  std::vector<double> input;
  for (std::size_t i = 0; i < 4 * judged.u.size(); ++i) input.push_back(judged.u[i / 4]);
  const std::vector<double> moved = creeping.motion(1e-4, mjINT_RK4, input);
  double sum = 0.0;
  for (std::size_t i = 0; i < judged.x1.size(); ++i) sum += std::pow(moved[4 * i] - judged.x1[i], 2);
  const double rms = std::sqrt(sum / static_cast<double>(judged.x1.size()));
  EXPECT_NEAR(c.default_error, rms, 0.05 * rms);
  EXPECT_GT(rms, 20.0 * held);
}

TEST(Mjcf, OfOneBodySpeaksOfNeitherTendonNorLoadAndSaysWhatToChangeElsewhere) {
  const DriveExport drive = export_drive(
      rig_configuration(", mass_ratio: 0", "  effects: [{motor_coulomb_friction: {level_nm: 0.02}}]\n"),
      ExportFormat::kMjcf);
  for (const ExportedFile& file : drive.files) {
    EXPECT_THAT(file.text, Not(HasSubstr("tendon"))) << file.name;
    EXPECT_THAT(file.text, Not(HasSubstr("load"))) << file.name;
  }
  EXPECT_THAT(drive.certificate.own_file,
              HasSubstr("joint: armature=\"0.000878\" damping=\"0.062\" frictionloss=\"0.02\""));
  EXPECT_THAT(drive.certificate.own_file, HasSubstr("actuator: gear=\"0.172\""));
  EXPECT_THAT(certificate_text(drive.certificate), HasSubstr("## In a file of your own"));
}

TEST(Mjcf, TellsTheArmatureBesideTheBodyThatAFileOfTheUsersOwnHas) {
  const Configuration c =
      rig_configuration(", mass_ratio: 0", "  effects: [{load_unbalance: {amplitude_nm: 0.0375}}]\n");
  JointNumbers own;
  own.model = "arm.xml", own.joint = "shoulder", own.body_inertia = 0.0005, own.unbalance = 0.03;
  const auto told = [&] { return export_drive(c, ExportFormat::kMjcf, own).certificate.own_file; };
  EXPECT_THAT(told(), HasSubstr("armature=\"0.000378\""));
  EXPECT_THAT(
      told(),
      HasSubstr("(0.000878) less the 0.0005 about the axis that the body of shoulder has in arm.xml"));
  EXPECT_THAT(told(), HasSubstr("from the axis, times 1.25 "));
  own.body_inertia = 0.001;
  EXPECT_THAT(told(), HasSubstr("armature=\"0\""));
  EXPECT_THAT(told(), HasSubstr("take 0.000122 off the body's own"));
}

TEST(Mjcf, TheFragmentIsAModelWhenItIsIncluded) {
  const DriveExport drive = export_drive(rig_configuration(kTwoBodies), ExportFormat::kMjcf);
  std::string text = drive.files[1].text;
  text.replace(text.find("<mujocoinclude>"), 15, "<mujoco>");
  text.replace(text.find("</mujocoinclude>"), 16, "</mujoco>");
  const MujocoEngineRun fragment(text);
  EXPECT_EQ(fragment.model().nv, 2);
  EXPECT_EQ(fragment.model().ntendon, 1);
  EXPECT_EQ(fragment.model().nu, 1);
  EXPECT_EQ(drive.certificate.files, (std::vector<std::string>{"rig.xml", "rig_fragment.xml"}));
}

}  // namespace
}  // namespace gapscope
