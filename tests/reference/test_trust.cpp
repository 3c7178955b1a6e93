// How far a fit is trusted: of a model that is the drive, of one that lacks something, of one that is told of
// a gap where there is none, and of an input whose sign is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "gapscope/recording/recording_file.h"
#include "independent_plant/severity.h"
#include "reference/rigs.h"
#include "reference/trust.h"
#include "support/data.h"

namespace gapscope {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::Not;

/// The model that is told the drive's structure and most of its numbers.
ReferenceModel told() {
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.02);
  estimate(model, kMotorDamping, 0.07);
  estimate(model, kMassRatio, 1.1);
  return model;
}

void expect_rejected(const FitSummary& f) {
  EXPECT_EQ(f.trust, FitTrust::kRejected) << f.full_report();
  EXPECT_FALSE(f.why.empty());
  for (const FittedParameter& p : f.parameters) EXPECT_TRUE(std::isnan(f.shown_interval(p).low)) << p.key;
  EXPECT_THAT(f.full_report(), Not(HasSubstr(" .. "))) << "no interval in the table";
  EXPECT_THAT(f.brief_report(), HasSubstr("rejected: "));
  EXPECT_THAT(f.brief_report(), Not(HasSubstr(" ["))) << "and none in a line";
}

TEST(Trust, IsGoodWhereTheModelLeavesWhatTheEncoderLeaves) {
  const Recording r = BlindRig().recording();
  const FitSummary f = fit_one(r, told());
  EXPECT_EQ(f.trust, FitTrust::kGood) << f.why << f.full_report();
  EXPECT_TRUE(contains(f, "gap", 0.0188));
  EXPECT_GT(f.without_gap_ratio, 10.0);
  EXPECT_LT(f.innovation_rmse, 0.01 * f.coasting_rmse);
}

TEST(Trust, FitPercentIsTheNormalisedErrorOfTheFreeRun) {
  const Recording r = BlindRig().recording();
  const FitSummary f = fit_one(r, told());
  const double center = mean(r.x1);
  double missed = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i)
    missed += std::pow(r.x1[i] - f.traces[0].x1[i], 2), moved += std::pow(r.x1[i] - center, 2);
  EXPECT_NEAR(f.fit_percent, 100.0 * (1.0 - std::sqrt(missed / moved)), 1e-9);
  EXPECT_GT(f.fit_percent, 99.9);
}

/// What is rejected on the whole need not be sought again on its parts.
FitSummary fit_whole(const Recording& recording, const ReferenceModel& model) {
  FitOptions options;
  options.compare_parts = false;
  return fit_one(recording, model, options);
}

TEST(Trust, IsRejectedWhereTheSignOfTheInputIsWrong) {
  Recording r = BlindRig().recording();
  for (double& u : r.u) u = -u;
  const FitSummary f = fit_whole(r, told());
  expect_rejected(f);
  EXPECT_EQ(f.why.code(), "leaves_unexplained");
}

TEST(Trust, IsRejectedWhereOneBodyIsToldToHaveAGap) {
  BlindRig rig;
  rig.drive.load = independent_plant::BlindLoad::kNone;
  expect_rejected(fit_whole(rig.recording(), told()));
}

TEST(Trust, IsRejectedWhereTheModelIsRightButForAGapThatIsNotThere) {
  BlindRig rig;
  rig.drive.contact = independent_plant::ContactKind::kBonded;
  rig.drive.gap = 0.0;
  const FitSummary f = fit_one(rig.recording(), told());
  expect_rejected(f);
  EXPECT_EQ(f.why.code(), "as_well_without_gap") << f.full_report();
  EXPECT_LT(f.innovation_rmse, 2.0 * f.floor) << "nothing else is missing";
}

TEST(Trust, OfAModelThatIsFarOffIsNotThatAGapIsAsGoodAsNone) {
  FitSummary f;
  f.status = FitStatus::kConverged;
  f.floor = 1.0, f.innovation_rmse = 239.0;
  f.traces.resize(1), f.traces[0].x1.resize(20000);
  internal::reference::FitOutcome outcome;
  outcome.information.inflation = 100.0;
  const auto judged = [&](double ratio) {
    internal::reference::TrustFacts facts;
    facts.coasting_rmse = 1e4, facts.without_gap_ratio = ratio;
    judge_trust({}, outcome, facts, f);
    EXPECT_EQ(f.trust, FitTrust::kRejected);
    return f.why.code();
  };
  EXPECT_EQ(judged(1.5), "gap_bears_little");
  EXPECT_EQ(judged(1.01), "as_well_without_gap");
}

TEST(Trust, IsNotGoodWhereAFrictionOfAFiftiethOfTheTorqueIsMissing) {
  for (const double level : {0.002, 0.01}) {
    BlindRig rig;
    rig.drive.effects.motor.friction.level_nm = level;
    const FitSummary f = fit_one(rig.recording(), told());
    EXPECT_NE(f.trust, FitTrust::kGood) << level << f.full_report();
  }
}

TEST(Trust, OfAFitThatWasNotRunIsNone) {
  EXPECT_EQ(FitSummary().trust, FitTrust::kRejected);
  EXPECT_EQ(FitSummary().why.code(), "not_run");
}

/// A reducer behind a locked output, on small ramps.
FitSummary fit_reducer(const char* name, double until) {
  ReadOptions options;
  options.window = {0.0, until};
  options.resample_rate = 200.0;
  Recording r = read_recording((testing::data_folder() / name).string(), options);
  r.quantum = 2.0 * kPi / 65536.0;
  ReferenceModel model;
  model.structure.load = LoadKind::kLocked;
  model.parameters[kTorqueConstant].value = 1.0;
  for (const auto& [n, start] : {std::pair{kMotorInertia, 0.1},
                                 {kMotorDamping, 0.5},
                                 {kGap, 0.02},
                                 {kContactStiffness, 500.0},
                                 {kContactDamping, 1.0}})
    estimate(model, n, start);
  return fit_whole(r, model);
}

TEST(RealTrust, OfAReducerWhoseGapIsPreloadedAwayIsRejected) {
  GAPSCOPE_NEEDS_DATA();
  expect_rejected(fit_reducer("cycloidal/splitpreload3_pos1.csv", 20.31));
  for (const char* step : {"05", "12"})
    expect_rejected(fit_reducer((std::string("preload_ladder/") + step + "_preload.csv").c_str(), 1e3));
}

/// A servo as it was recorded: a duty that holds a sign, times a supply that sags.
Recording servo(const char* name) {
  std::ifstream in(testing::data_folder() / "xl330" / name);
  std::string line;
  std::getline(in, line);
  Recording r;
  r.file = name;
  for (double t, goal, x, duty, volts; std::getline(in, line);) {
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &t, &goal, &x, &duty, &volts) != 5) continue;
    r.stamps.push_back(t), r.x1.push_back(x);
    r.u.push_back((duty > 32767 ? duty - 65536 : duty) / 885.0 * volts);
  }
  r.start = r.stamps.front();
  r.dt = (r.stamps.back() - r.start) / static_cast<double>(r.size() - 1);
  r.quantum = 2.0 * kPi / 4096.0;
  return r;
}

/// Two bodies that share what one has, and a gap between them.
ReferenceModel two_bodies(double inertia, double damping, double torque_constant, double gap,
                          double stiffness) {
  ReferenceModel model;
  model.parameters[kTorqueConstant].value = torque_constant;
  for (const auto& [n, start] : {std::pair{kMotorInertia, 0.5 * inertia},
                                 {kMotorDamping, damping},
                                 {kMassRatio, 1.0},
                                 {kGap, gap},
                                 {kLoadDamping, 0.1 * damping},
                                 {kLoadCoulombFriction, kNaN}})
    estimate(model, n, start);
  model.parameters[kContactStiffness].value = stiffness;
  model.parameters[kContactDamping].value = 0.1 * std::sqrt(stiffness * inertia);
  return model;
}

TEST(RealTrust, OfAServoThatIsReadAsTwoBodiesWithAGapIsRejected) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* name : {"sin_sin_kp100.csv", "up_and_down_kp100.csv"})
    expect_rejected(fit_whole(servo(name), two_bodies(7e-3, 0.04, 0.096, 0.04, 20.0)));
}

Recording axis(double until) {
  ReadOptions options;
  options.window = {0.0, until};
  Recording r = read_recording((testing::data_folder() / "emps/emps_train.csv").string(), options);
  r.quantum = 5e-8;
  return r;
}

TEST(RealTrust, OfABallScrewThatIsReadAsTwoBodiesWithAGapIsRejected) {
  GAPSCOPE_NEEDS_DATA();
  expect_rejected(fit_whole(axis(3.0), two_bodies(95.0, 200.0, 1.0, 0.005, 1e6)));
}

ModelEffect sought(const char* name, double start) {
  ModelEffect e;
  e.entry = find_effect(name);
  e.parameters[0] = {start, true, kNaN, kNaN, {}};
  return e;
}

TEST(RealTrust, OfAGoodModelFarAboveTheEncodersFloorIsLimitedAndSaysHowGoodItIs) {
  GAPSCOPE_NEEDS_DATA();
  ReferenceModel model;
  model.structure.has_load = false;
  model.parameters[kTorqueConstant].value = 1.0;
  estimate(model, kMotorInertia, 90.0), estimate(model, kMotorDamping, 200.0);
  model.effects = {sought("motor_coulomb_friction", 20.0), sought("constant_load_torque", 3.0)};
  const FitSummary f = fit_one(axis(1e3), model);
  EXPECT_EQ(f.trust, FitTrust::kLimited);
  EXPECT_GT(f.fit_percent, 95.0) << "8 mm of 246 mm after 25 s";
  EXPECT_THAT(f.why.text(), HasSubstr("follows the recording to 95"));
  EXPECT_FALSE(std::isnan(f.shown_interval(*f.find("motor_inertia")).low));
}

}  // namespace
}  // namespace gapscope
