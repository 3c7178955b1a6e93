// Recovered truth: the recordings are those of an independent plant, which shares no code with the fit.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

/// The rig of the source paper at 1 Hz and 0.1 N m, 10 s at 2.5 kHz, 20 bit.
const Recording& paper_recording() {
  static const Recording recording = [] {
    BlindRig run;
    run.options = {2500.0, 10.0, 1, 1e-11};
    return run.recording();
  }();
  return recording;
}

/// One quantum is 6e-6 rad; 25 000 samples average the quantiser to some 1e-7 rad, 1e-5 of the gap. 1e-4
/// leaves room for its error not averaging out over identical periods.
constexpr double kGapTolerance = 1e-4;

void expect_truth(const FitSummary& summary) {
  EXPECT_EQ(summary.status, FitStatus::kConverged) << summary.full_report();
  ASSERT_NE(summary.find("gap"), nullptr);
  EXPECT_NEAR(summary.find("gap")->value / 0.0188, 1.0, kGapTolerance) << summary.full_report();
  EXPECT_TRUE(contains(summary, "gap", 0.0188)) << summary.full_report();
  EXPECT_TRUE(contains(summary, "motor_damping", 0.062)) << summary.full_report();
  EXPECT_NEAR(summary.find("mass_ratio")->value, 1.0, 1e-3);
  EXPECT_LT(summary.rmse, 1.2 * summary.floor);  // nothing but the encoder is left
  EXPECT_EQ(summary.objective_hz, 0.0);
  EXPECT_TRUE(summary.warnings.empty()) << summary.full_report();
}

TEST(Fit, RecoversThePaperRigFromPerfectAndPerturbedStarts) {
  const double starts[][3] = {{0.0188, 0.062, 1.0}, {0.02, 0.06, 1.2}, {0.03, 0.03, 1.2}, {0.03, 0.09, 1.2}};
  for (const auto& s : starts) {
    ReferenceModel model = known_model({});
    estimate(model, kGap, s[0]);
    estimate(model, kMotorDamping, s[1]);
    estimate(model, kMassRatio, s[2]);
    expect_truth(fit_one(paper_recording(), model));
  }
}

/// Four parts of the one recording, which together are as far from their minimum as the errors say.
void expect_pieces(const FitSummary& summary, std::size_t samples) {
  ASSERT_EQ(summary.pieces.size(), 4u);
  double square = 0.0, of_gap = 0.0;
  std::size_t all = 0;
  for (const FitPiece& p : summary.pieces) {
    ASSERT_EQ(p.normal.size(),
              6u);  // of three numbers; that of the gap, the third as the YAML has them, is last
    square += p.square, of_gap += p.normal.back(), all += static_cast<std::size_t>(p.samples);
  }
  EXPECT_EQ(all, samples);
  EXPECT_NEAR(square / static_cast<double>(all), std::pow(summary.rmse / summary.floor, 2), 1e-3);
  EXPECT_LT(1.0 / std::sqrt(of_gap), summary.find("gap")->std);  // all others known, residuals of one floor
}

TEST(Fit, RecoversGapDampingAndMassRatioOfWhichNothingWasSaid) {
  ReferenceModel model = known_model({});
  for (const int n : {kGap, kMotorDamping, kMassRatio}) estimate(model, n);
  const FitSummary summary = fit_one(paper_recording(), model);
  expect_truth(summary);
  expect_pieces(summary, paper_recording().size());
}

/// Where the search was stopped its curvature says nothing of how far the minimum is.
TEST(Fit, WhereTheIterationsRanOutNoNumberHasAnInterval) {
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.03);
  estimate(model, kMotorDamping, 0.03);
  FitOptions options;
  options.max_iterations = 1, options.starts = 1;
  const FitSummary summary = fit_one(paper_recording(), model, options);
  ASSERT_EQ(summary.status, FitStatus::kNotConverged) << summary.full_report();
  for (const FittedParameter& p : summary.parameters) {
    EXPECT_TRUE(std::isfinite(p.value)) << p.key;
    EXPECT_TRUE(std::isnan(p.std) && std::isnan(p.ci95.low) && std::isnan(p.ci95.high)) << p.key;
  }
}

TEST(Fit, RecoversAllButInertiaAndTorqueConstantFromASheetTwentyPercentOff) {
  BlindRig run;
  run.excitation.waveform = independent_plant::Waveform::kMultisine;
  run.excitation.frequency = 0.5;
  run.excitation.amplitude = 1.2;
  ReferenceModel model = known_model(run.drive);
  const auto truth = numbers_of(run.drive);
  for (int n = kMotorDamping; n <= kContactDamping; ++n)
    estimate(model, n, truth[static_cast<std::size_t>(n)] * (n % 2 == 0 ? 1.2 : 0.8));
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_EQ(summary.status, FitStatus::kConverged);
  // Weakest is the contact's damping: a few dozen impacts of some 20 samples each.
  const double tolerance[] = {0, 0, 1e-3, 1e-3, 2e-4, 1e-3, 1e-3, 5e-3, 1e-2};
  for (int n = kMotorDamping; n <= kContactDamping; ++n) {
    const FittedParameter* p = summary.find(kDriveParameters[n].key);
    ASSERT_NE(p, nullptr);
    const auto i = static_cast<std::size_t>(n);
    EXPECT_NEAR(p->value / truth[i], 1.0, tolerance[n]) << summary.full_report();
    EXPECT_LT(std::abs(p->value - truth[i]), 4.0 * p->std) << p->key;
  }
}

TEST(Fit, SeveralRecordingsShareTheirParametersAndKeepTheirOwnInitialStates) {
  BlindRig first, second;
  first.options.duration = second.options.duration = 2.0;
  first.drive.x2 = 0.005;
  second.excitation.waveform = independent_plant::Waveform::kMultisine;
  second.drive.x1 = 0.3, second.drive.x2 = 0.292;
  second.options.rate = 2000.0;
  const Recording a = first.recording(), b = second.recording();
  const MotorTrace both[] = {a.motor_trace(), b.motor_trace()};
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.025);
  estimate(model, kMotorDamping, 0.05);
  estimate(model, kMassRatio, 1.3);
  const FitSummary joint = fit(both, model);
  EXPECT_TRUE(contains(joint, "gap", 0.0188)) << joint.full_report();
  EXPECT_LT(joint.rmse, 1.2 * joint.floor);
  ASSERT_EQ(joint.traces.size(), 2U);
  EXPECT_NEAR(joint.traces[1].x1.front(), 0.3, 1e-5);
  const FitSummary alone = fit_one(a, model);
  EXPECT_LT(joint.find("mass_ratio")->std, alone.find("mass_ratio")->std);  // more data, less doubt
}

TEST(Fit, ARecordingMayBeginInMotionAnywhereInTheGap) {
  BlindRig run;
  const Recording whole = run.recording();
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.025);
  estimate(model, kMotorDamping, 0.05);
  estimate(model, kMassRatio, 1.2);
  for (const double from : {0.5, 0.61, 0.97, 1.13}) {
    const FitSummary summary = fit_one(window(whole, from), model);
    EXPECT_NEAR(summary.find("gap")->value / 0.0188, 1.0, 5e-4) << from << summary.full_report();
    EXPECT_LT(summary.rmse, 1.3 * summary.floor) << from;
  }
}

TEST(Fit, TheSameRecordingGivesTheSameBytesTwice) {
  BlindRig run;
  const Recording recording = run.recording();
  ReferenceModel model = known_model({});
  for (const int n : {kGap, kMotorDamping, kMassRatio}) estimate(model, n);
  const FitSummary a = fit_one(recording, model), b = fit_one(recording, model);
  EXPECT_EQ(a.full_report(), b.full_report());
  for (std::size_t i = 0; i < a.parameters.size(); ++i)
    EXPECT_EQ(a.parameters[i].value, b.parameters[i].value);
  EXPECT_EQ(a.traces[0].x1, b.traces[0].x1);
  EXPECT_EQ(a.start_costs, b.start_costs);
  EXPECT_EQ(a.simulations, b.simulations);
}

TEST(Fit, ModeErrorsCoverEverySampleOnce) {
  BlindRig run;
  const Recording recording = run.recording();
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.02);
  const FitSummary summary = fit_one(recording, model);
  int samples = 0;
  double squares = 0.0;
  for (const ModeError& m : summary.mode_errors) samples += m.samples, squares += m.samples * m.rmse * m.rmse;
  EXPECT_EQ(samples, static_cast<int>(recording.size()));
  EXPECT_NEAR(std::sqrt(squares / samples), summary.rmse, 1e-12);
  // The independent plant's own modes: they differ at most at the samples beside an event.
  int different = 0;
  for (std::size_t i = 0; i < recording.size(); ++i)
    if (summary.traces[0].mode[i] != recording.mode[i]) ++different;
  EXPECT_LT(different, static_cast<int>(recording.size()) / 50);
}

TEST(Fit, AWrongFixedParameterIsSaidNotHidden) {
  // Stiffness fixed at a quarter of the truth: every impact is missed by far more than the encoder's floor.
  BlindRig run;
  ReferenceModel model = known_model(run.drive);
  model.parameters[kContactStiffness].value = 50.0;
  estimate(model, kGap, 0.02);
  estimate(model, kMassRatio, 1.2);
  const FitSummary summary = fit_one(run.recording(), model);
  ASSERT_FALSE(summary.warnings.empty());
  EXPECT_EQ(summary.warnings.front().code(), "leaves_some");
  EXPECT_NE(summary.trust, FitTrust::kGood);
  EXPECT_GT(summary.objective_hz, 0.0);
  EXPECT_LT(std::abs(summary.find("gap")->value - 0.0188), 4.0 * summary.find("gap")->std);
}

TEST(Fit, ASmallMismatchIsSeenInTheRandomnessOfTheResidualAndAQuantisersPatternIsNot) {
  BlindRig rig;
  rig.sensor = independent_plant::BlindSensor::with_bits(16, 0.5);
  rig.options.duration = 3.0;
  for (const bool right : {true, false}) {
    ReferenceModel model = known_model(rig.drive);
    if (!right) model.parameters[kContactStiffness].value = 150.0;
    estimate(model, kGap, 0.02);
    const FitSummary summary = fit_one(rig.recording(), model);
    EXPECT_LT(summary.rmse, 3.0 * summary.floor);
    EXPECT_EQ(summary.full_report().find("has a pattern") == std::string::npos, right)
        << summary.full_report();
  }
  rig.sensor = independent_plant::BlindSensor::with_bits(12);  // correlated by its own coarseness
  rig.options.rate = 5000.0;
  ReferenceModel model = known_model(rig.drive);
  estimate(model, kGap, 0.02);
  const FitSummary coarse = fit_one(rig.recording(), model);
  EXPECT_GT(coarse.lag1_autocorrelation, 0.2);
  EXPECT_EQ(coarse.full_report().find("has a pattern"), std::string::npos) << coarse.full_report();
}

TEST(Fit, ResidualsOfTheRightModelAreAsRandomAsChanceAndThoseOfAWrongOneAreNot) {
  BlindRig rig;
  rig.sensor = independent_plant::BlindSensor::with_bits(16, 1.0);
  for (const bool right : {true, false}) {
    ReferenceModel model = known_model(rig.drive);
    if (!right) model.parameters[kContactStiffness].value = 100.0;
    estimate(model, kGap, 0.02);
    const FitSummary summary = fit_one(rig.recording(), model);
    // 40 lags: more than 20 % outside a band of 95 % has a probability of 1e-4.
    EXPECT_EQ(summary.whiteness.outside < 0.2, right) << summary.full_report();
    if (right) {
      EXPECT_LT(summary.input_correlation.outside, 0.2) << summary.full_report();
    }
  }
}

TEST(Fit, TheProfileOfAWellKnownParameterIsItsInterval) {
  BlindRig rig;
  rig.sensor = independent_plant::BlindSensor::with_bits(16, 1.0);
  ReferenceModel model = known_model(rig.drive);
  estimate(model, kGap, 0.02);
  estimate(model, kMotorDamping, 0.07);
  FitOptions options;
  options.profile = true;
  const FitSummary summary = fit_one(rig.recording(), model, options);
  for (const char* key : {"gap", "motor_damping"}) {
    const FittedParameter& p = *summary.find(key);
    const double half = 0.5 * (p.ci95.high - p.ci95.low);
    EXPECT_NEAR(p.profile_ci95.low, p.ci95.low, 0.15 * half) << key;
    EXPECT_NEAR(p.profile_ci95.high, p.ci95.high, 0.15 * half) << key;
  }
  EXPECT_TRUE(std::isnan(fit_one(rig.recording(), model).find("gap")->profile_ci95.low));
}

TEST(Fit, AParameterThatRunsIntoItsBoundIsNamed) {
  BlindRig run;
  ReferenceModel model = known_model(run.drive);
  estimate(model, kGap, 0.015);
  model.parameters[kGap].low = 0.001, model.parameters[kGap].high = 0.017;
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_TRUE(summary.find("gap")->at_bound);
  EXPECT_NE(summary.full_report().find("gap ended at the limit of its search"), std::string::npos);
}

TEST(Fit, AWrongSignOfTheInputIsSuspectedBeforeAnythingElse) {
  Recording recording = BlindRig{}.recording();
  ReferenceModel model = known_model({});
  estimate(model, kGap, 0.02);
  EXPECT_EQ(fit_one(recording, model).full_report().find("sign"), std::string::npos);
  for (double& u : recording.u) u = -u;
  const FitSummary turned = fit_one(recording, model);
  ASSERT_FALSE(turned.warnings.empty());
  EXPECT_NE(turned.warnings.front().text().find("the sign and the unit of u"), std::string::npos);
}

TEST(Fit, ATightPriorHoldsAParameterThatTheRecordingHardlySees) {
  BlindRig run;
  run.sensor = independent_plant::BlindSensor::with_bits(12);
  ReferenceModel model = known_model(run.drive);
  estimate(model, kContactDamping, 0.05);
  model.parameters[kContactDamping].prior = Prior{0.07, 1e-5};
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_NEAR(summary.find("contact_damping")->value, 0.07, 1e-4);
}

TEST(Fit, AModelThatDivergesFromEveryStartFailsWithoutNumbers) {
  BlindRig run;
  ReferenceModel model = known_model(run.drive);
  model.parameters[kMotorDamping].value = -1.0;  // grows by e every millisecond
  estimate(model, kGap, 0.02);
  const FitSummary summary = fit_one(run.recording(), model);
  EXPECT_EQ(summary.status, FitStatus::kFailed);
  EXPECT_TRUE(std::isnan(summary.rmse));
  EXPECT_TRUE(std::isnan(summary.find("gap")->value));
  EXPECT_FALSE(summary.converged());
}

TEST(Fit, StopsWithinAnEvaluationWhenItIsAskedTo) {
  const Recording recording = BlindRig{}.recording();
  ReferenceModel model = known_model({});
  for (const int n : {kGap, kMotorDamping, kMassRatio}) estimate(model, n);
  std::thread interrupter([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    request_stop();
  });
  EXPECT_THROW(fit_one(recording, model), Interrupted);
  interrupter.join();
  clear_stop_request();
}

TEST(Fit, CallersFaultsAreAssertions) {
  const Recording recording = BlindRig{}.recording();
  ReferenceModel model = known_model({});
  EXPECT_THROW(fit({}, model), std::logic_error);
  model.parameters[kContactStiffness].value = kNaN;  // neither given nor estimated
  EXPECT_THROW(fit_one(recording, model), std::logic_error);
}

}  // namespace
}  // namespace gapscope
