// The steps of an MJCF: which are compared, which the file has, and a delay that is counted in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "exports/export.h"
#include "exports/exported_drives.h"
#include "exports/mujoco_engine.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::rig_configuration;

/// A contact so stiff that its vibration asks for steps below 0.1 ms.
Configuration stiff_rig() {
  Configuration c = rig_configuration(
      ", mass_ratio: 1.5, gap: 0.019, load_damping: 0.035, load_coulomb_friction: 0.03, contact_stiffness: "
      "300000, contact_damping: 30");
  c.simulation->duration = 1.0;
  return c;
}

double timestep_of(const std::string& mjcf) {
  std::smatch found;
  return std::regex_search(mjcf, found, std::regex("timestep=\"([^\"]*)\"")) ? std::stod(found[1].str())
                                                                             : kNaN;
}

TEST(MjcfSteps, TheFileHasOneThatItStandsAndSaysWhy) {
  const DriveExport drive = export_drive(stiff_rig(), ExportFormat::kMjcf);
  const Certificate& c = drive.certificate;
  const auto limits = std::find_if(c.limits.begin(), c.limits.end(),
                                   [](const StepLimits& l) { return l.integrator == "RK4"; });
  ASSERT_NE(limits, c.limits.end());
  ASSERT_LT(limits->largest, 1e-4) << "or this is no test";
  EXPECT_DOUBLE_EQ(timestep_of(drive.files[0].text), 5e-5);
  const std::string note = "timestep is 0.05 ms: the largest stable step of RK4 is ";
  for (const ExportedFile& file : drive.files) EXPECT_THAT(file.text, HasSubstr(note)) << file.name;
  EXPECT_THAT(c.warnings, ::testing::Contains(HasSubstr(note))) << "which the terminal prints";
  const DriveExport calm = export_drive(rig_configuration(", mass_ratio: 0"), ExportFormat::kMjcf);
  EXPECT_THAT(calm.files[0].text, Not(HasSubstr("timestep is ")));
}

std::vector<double> steps_of(double rate) {
  Configuration c = rig_configuration(", mass_ratio: 0");
  c.simulation->rate = rate;
  std::vector<double> steps;
  for (const TargetError& e : export_drive(c, ExportFormat::kMjcf).certificate.errors)
    if (e.integrator == "RK4") steps.push_back(1e3 * e.step);
  return steps;
}

/// Rows that fall between two steps act late, which no engine is to be blamed for.
TEST(MjcfSteps, AreComparedWhereTheyFallOnTheRowsOfTheInput) {
  using ::testing::DoubleNear;
  using ::testing::Pointwise;
  EXPECT_THAT(steps_of(1000),
              Pointwise(DoubleNear(1e-9), {0.01, 0.02, 0.05, 0.1, 0.2, 1.0, 2.0, 4.0, 8.0, 12.0, 20.0}));
  EXPECT_THAT(steps_of(2500),
              Pointwise(DoubleNear(1e-9), {0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 2.0, 4.0, 8.0, 12.0, 20.0}));
  Configuration odd = rig_configuration(", mass_ratio: 0");
  odd.simulation->rate = 300.0;
  const Certificate c = export_drive(odd, ExportFormat::kMjcf).certificate;
  EXPECT_GE(c.errors.size(), 20u);
  EXPECT_THAT(c.warnings, ::testing::Contains(HasSubstr("divides the 3.33333 ms between two rows")));
}

/// The certificate's line of C, in the loop of an engine.
TEST(MjcfSteps, ADelayIsARingOfThem) {
  constexpr double kStep = 1e-4;
  const Configuration c =
      rig_configuration(", mass_ratio: 0", "  effects: [{input_delay: {delay_s: 0.00598834}}]\n");
  const DriveExport drive = export_drive(c, ExportFormat::kMjcf);
  ASSERT_DOUBLE_EQ(timestep_of(drive.files[0].text), kStep);
  EXPECT_THAT(
      certificate_text(drive.certificate),
      HasSubstr("`static double past[60]; static int at; double now = u; u = past[at]; past[at] = now; "
                "at = (at + 1) % 60;` (60 steps of 0.1 ms, 0.0117 ms more than the delay; at another "
                "step round(0.00598834/step) of them)"));
  const SimulationConfig& s = *c.simulation;
  const std::vector<double> given = sample(s.excitation, s.rate, s.samples(), s.seed);
  SimulationOptions options;
  options.rate = s.rate;
  const std::vector<double> x1 = simulate(s.plant.plant_model(), given, options).x1;
  testing::MujocoEngineRun engine(drive.files[0].text);
  constexpr std::size_t kInner = 4;
  std::vector<double> input;
  for (std::size_t i = 0; i < given.size() * kInner; ++i) input.push_back(given[i / kInner]);
  const auto told = [](double u, mjData&) {
    static double past[60];
    static int at;
    double now = u;
    u = past[at];
    past[at] = now;
    at = (at + 1) % 60;
    return u;
  };
  const std::vector<double> bare = engine.motion(kStep, mjINT_RK4, input);
  const std::vector<double> mended = engine.motion(kStep, mjINT_RK4, input, told);
  double was = 0.0, is = 0.0;
  for (std::size_t i = 0; i < x1.size(); ++i) {
    was = std::max(was, std::abs(bare[kInner * i] - x1[i]));
    is = std::max(is, std::abs(mended[kInner * i] - x1[i]));
  }
  EXPECT_LT(is, 0.02 * was) << "0.0117 of 5.99 ms are left, and the steps";
}

}  // namespace
}  // namespace gapscope
