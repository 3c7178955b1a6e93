#include <gtest/gtest.h>

#include "reference/model_fit.h"
#include "reference/rigs.h"
#include "reference/solvers.h"

namespace gapscope::internal::reference {
namespace {

using namespace test;

constexpr double kHz = 3.0;

/// A rig with a free gap, of which something is known beforehand, and a free damping.
struct FittedRig {
  Recording recording;
  MotorTrace trace;
  ReferenceModel model;

  FittedRig() {
    BlindRig rig;
    rig.options.duration = 1.0;
    recording = rig.recording();
    trace = recording.motor_trace();
    model = known_model(rig.drive);
    const double gap = model.parameters[kGap].value;
    estimate(model, kGap, 1.2 * gap);
    model.parameters[kGap].prior = Prior{gap, 0.1 * gap};
    estimate(model, kMotorDamping, model.parameters[kMotorDamping].value);
  }
  FittedRig(const FittedRig&) = delete;

  std::span<const MotorTrace> recordings() const { return {&trace, 1}; }
  FitProblem problem() const { return make_problem(recordings(), model, {}); }
  ModelFit fit() const { return ModelFit(recordings(), model, {}, kHz); }
  FitPoint point() const {
    FitPoint at = fit().given_point();
    at.starts[0].q = {0.0, 0.5, -0.3, 0.0};
    return at;
  }
};

TEST(ModelFit, ThePackedNumbersAreTheParametersAndTheFreeInitialOnes) {
  const FittedRig rig;
  const FitProblem problem = rig.problem();
  const FitPoint at = rig.point();
  const Cost cost(problem, at, 0.0);
  const Cost::Vector x = cost.pack(at);
  ASSERT_EQ(x.size(), cost.shared() + cost.states(0));
  EXPECT_EQ(x[0], at.q[0]);
  EXPECT_EQ(x[cost.first_state(0)], at.starts[0].q[0]);
  const FitPoint doubled = cost.unpack(2.0 * x);
  for (std::size_t i = 0; i < at.q.size(); ++i) EXPECT_EQ(doubled.q[i], 2.0 * at.q[i]);
  for (std::size_t s = 0; s < kStates; ++s) EXPECT_EQ(doubled.starts[0].q[s], 2.0 * at.starts[0].q[s]);
}

TEST(ModelFit, TheThreeMeanSquaresDifferByThePriorsAndTheWidthsOfTheInitialStates) {
  const FittedRig rig;
  const FitProblem problem = rig.problem();
  const FitPoint at = rig.point();
  const Cost cost(problem, at, kHz);
  const double samples = cost.all_samples(), priors = prior_square(problem, at.q);
  const double residuals = adjust(problem, at, linearise(problem, at, kHz), kHz, 0).residual_mean_square;
  const double with_priors = mean_square_with_priors(problem, at, kHz).value;
  const double all = refine(problem, at, kHz, {1, 0, 1e-4}).mean_cost;
  ASSERT_NEAR(priors, 4.0, 1e-9);  // the gap starts two standard deviations off
  double widths = 0.0;
  for (Eigen::Index i = cost.shared(); i < cost.size(); ++i)
    widths += std::pow(cost.pack(at)[i] / kStateWidth, 2);
  ASSERT_GT(widths, 0.0);
  // The sums run over the samples in different orders: 1e3 roundings of doubles at most.
  EXPECT_NEAR(with_priors, residuals + priors / samples, 1e-12 * with_priors);
  EXPECT_NEAR(all, with_priors + widths / samples, 1e-12 * all);
}

TEST(ModelFit, EachSolverSaysWhatItSpent) {
  const FittedRig rig;
  const ModelFit fit = rig.fit();
  const FitPoint at = rig.point();
  const std::optional<FitLinearisation> there = fit.linearise(at);
  ASSERT_TRUE(there);
  EXPECT_EQ(fit.adjust(at, *there, 0).simulations, 1.0);  // the cost alone
  EXPECT_LE(fit.adjust(at, *there, 2).simulations, 3.0);
  const double derivatives = fit.refine(at, {1, 0, 1e-4}).simulations;  // one Jet run and nothing else
  EXPECT_GT(derivatives, 1.0);
  const RefinedFit refined = fit.refine(at, {2, 5, 1e-12});
  EXPECT_GT(refined.simulations, derivatives);
  EXPECT_LE(refined.simulations, 2.0 * derivatives + 5.0);
}

TEST(ModelFit, ARefinementGoesToTheValueThatThePriorAndTheRecordingAgreeOn) {
  const FittedRig rig;
  const ModelFit fit = rig.fit();
  const RefinedFit refined = fit.refine_with_loads_placed(fit.given_point(), {8, 40, 1e-6});
  ASSERT_TRUE(refined.usable());
  ReferenceModel found = fit.model_at(refined);
  const double truth = rig.model.parameters[kGap].prior->value;
  EXPECT_NEAR(setting_of(found, drive_number(kGap)).value, truth, 0.02 * truth);
  EXPECT_TRUE(fit.at_bound(refined).empty());
}

TEST(ModelFit, SettlesWhereTheWholeFitEndsWithItsErrors) {
  const FittedRig rig;
  const ModelFit near = rig.fit();
  const RefinedFit coarse = near.refine_with_loads_placed(near.given_point(), {2, 4, 1e-2});
  const std::optional<SettledFit> settled = near.settled(coarse, FitOptions{}.max_iterations);
  ASSERT_TRUE(settled);
  const FitSummary whole = fit_one(rig.recording, rig.model);
  ReferenceModel found = near.model_at(settled->end);
  for (const auto& [id, error] : settled->errors.numbers) {
    const FittedParameter* p = whole.find(kDriveParameters[id.index].key);
    ASSERT_NE(p, nullptr);
    EXPECT_NEAR(setting_of(found, id).value, p->value, 0.1 * p->std) << p->key;
    EXPECT_NEAR(error, p->std, 0.1 * p->std) << p->key;
  }
}

TEST(ModelFit, DoesNotSettleWhereTheModelIsNotTheDrive) {
  FittedRig rig;
  rig.model.parameters[kMotorInertia].value *= 2.0;
  const ModelFit other = rig.fit();
  const RefinedFit found = other.refine_with_loads_placed(other.given_point(), {});
  EXPECT_FALSE(other.settled(found, FitOptions{}.max_iterations));
}

TEST(ModelFit, ANumberOfAnEffectIsFoundByItsPlace) {
  FittedRig rig;
  const EffectEntry* cogging = find_effect("cogging_torque");
  ModelEffect effect;
  effect.entry = cogging;
  for (std::size_t i = 0; i < cogging->parameters.size(); ++i) effect.parameters[i].estimate = true;
  rig.model.effects = {effect};
  const ModelFit fit = rig.fit();
  const FitPoint at = fit.given_point();
  ASSERT_EQ(at.q.size(), 2 + cogging->parameters.size());
  const ParameterId amplitude{0, 0};
  ReferenceModel model = fit.model_at(at);
  const double value = setting_of(model, amplitude).value;
  EXPECT_GT(value, fit.bounds(amplitude).low);
  EXPECT_LT(value, fit.bounds(amplitude).high);
  // The model's own values lead back to the point.
  const FitPoint back = fit.point_of(model, at.starts);
  for (std::size_t i = 0; i < at.q.size(); ++i) EXPECT_NEAR(back.q[i], at.q[i], 1e-12);
}

}  // namespace
}  // namespace gapscope::internal::reference
