#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <memory>

#include "gapscope/simulation/simulate.h"
#include "reference/ceres_terms.h"
#include "reference/rigs.h"
#include "reference/starts.h"

namespace gapscope::internal::reference {
namespace {

using namespace test;

/// A problem that keeps what it points to.
struct CostOfRig {
  Recording recording;
  MotorTrace trace;
  FitProblem problem;
  FitPoint point;

  CostOfRig(const BlindRig& run, const ReferenceModel& model, const FitOptions& options = {})
      : recording(run.recording()), trace(recording.motor_trace()) {
    problem = make_problem({&trace, 1}, model, options);
    std::vector<double> q;
    for (std::size_t i = 0; i < problem.free_count(); ++i)
      q.push_back(problem.free_parameter(i).coordinate.solver(problem.free_parameter(i).start));
    point = start_point(problem, q);
  }
  CostOfRig(const CostOfRig&) = delete;

  std::vector<double> numbers(double observer_hz) const {
    const Cost::Vector x = Cost(problem, point, observer_hz).pack(point);
    return {x.begin(), x.end()};
  }
};

BlindRig short_run() {
  BlindRig run;
  run.options.duration = 0.7;
  return run;
}

ReferenceModel freed(int count) {
  ReferenceModel model = known_model({});
  const int order[] = {kGap,
                       kMotorDamping,
                       kMassRatio,
                       kLoadDamping,
                       kLoadCoulombFriction,
                       kContactStiffness,
                       kContactDamping,
                       kMotorInertia,
                       kTorqueConstant};
  for (int i = 0; i < count; ++i) model.parameters[order[i]].estimate = true;
  return model;
}

/// The Jacobian through every event against Ridders' extrapolated differences, each column by its largest
/// entry: a relative error of each entry would weigh those that have died away.
void expect_right_derivatives(double observer_hz, int free_parameters) {
  CostOfRig rig(short_run(), freed(free_parameters));
  const RecordingCost cost(rig.problem, 0, rig.point.starts[0], observer_hz);
  double simulations = 0.0;
  const RecordingTerm term(cost, simulations);
  const std::vector<double> q = rig.numbers(observer_hz);
  ceres::NumericDiffOptions options;
  options.ridders_relative_initial_step_size = 1e-6;  // events must stay within their samples
  const ceres::GradientChecker checker(
      &term, static_cast<const std::vector<const ceres::Manifold*>*>(nullptr), options);
  const double* blocks[] = {q.data(), q.data() + rig.problem.free_count()};
  ceres::GradientChecker::ProbeResults probe;
  checker.Probe(blocks, 1e-6, &probe);
  ASSERT_TRUE(probe.return_value);
  for (std::size_t b = 0; b < probe.jacobians.size(); ++b) {
    const auto &jet = probe.jacobians[b], &difference = probe.numeric_jacobians[b];
    ASSERT_EQ(jet.rows(), difference.rows());
    ASSERT_EQ(jet.cols(), difference.cols());
    for (Eigen::Index column = 0; column < jet.cols(); ++column) {
      double error = 0.0, size = 0.0;
      for (Eigen::Index row = 0; row < jet.rows(); ++row) {
        error = std::max(error, std::abs(jet(row, column) - difference(row, column)));
        size = std::max(size, std::abs(difference(row, column)));
      }
      EXPECT_LT(error, 1e-4 * size) << "block " << b << " column " << column;
    }
  }
}

TEST(RecordingCost, DerivativesOfTheFreeRunAreThoseOfItsDifferences) { expect_right_derivatives(0.0, 3); }
TEST(RecordingCost, DerivativesUnderTheObserverAreThoseOfItsDifferences) { expect_right_derivatives(2.5, 7); }

TEST(RecordingCost, MoreNumbersThanAJetHoldsTakeSeveralRuns) {
  // 9 parameters and 4 initial numbers make 13.
  CostOfRig rig(short_run(), freed(9));
  rig.point.starts[0].variant = {1, true};
  rig.point.starts[0].q[2] = -0.1;  // a little inside the edge
  const RecordingCost cost(rig.problem, 0, rig.point.starts[0], 0.0);
  ASSERT_EQ(cost.numbers(), 13);
  const std::vector<double> q = rig.numbers(0.0);
  const std::size_t samples = rig.recording.size();
  std::vector<double> residuals(samples), jacobian(samples * 13);
  ASSERT_TRUE(cost.evaluate(q.data(), residuals.data(), jacobian.data()).valid);
  // The place of both bodies shifts the free run as a whole.
  const double shift = -rig.point.starts[0].scale[0] / rig.problem.floors[0];
  for (std::size_t i = 0; i < samples; ++i) ASSERT_NEAR(jacobian[i * 13 + 9], shift, 1e-6 * -shift);
}

TEST(RecordingCost, AtTheTruthOnlyTheEncoderIsLeft) {
  CostOfRig rig(short_run(), freed(3));
  const RecordingCost cost(rig.problem, 0, rig.point.starts[0], 0.0);
  const std::vector<double> q = rig.numbers(0.0);
  std::vector<double> residuals(rig.recording.size());
  ASSERT_TRUE(cost.evaluate(q.data(), residuals.data(), nullptr).valid);
  // Half a quantum, in floors of at least quantum/√12, and the start's own error beside it.
  for (const double r : residuals) ASSERT_LT(std::abs(r), 0.5 * std::sqrt(12.0) * 3.0);
}

TEST(RecordingCost, ADivergedMotionIsRefusedAndLeavesNoSmallResidual) {
  ReferenceModel model = freed(3);
  model.parameters[kLoadDamping].value = -2.0;
  BlindRig run = short_run();
  run.options.duration = 4.0;
  CostOfRig rig(run, model);
  const RecordingCost cost(rig.problem, 0, rig.point.starts[0], 0.0);
  const std::vector<double> q = rig.numbers(0.0);
  std::vector<double> residuals(rig.recording.size());
  EXPECT_FALSE(cost.evaluate(q.data(), residuals.data(), nullptr).valid);
  EXPECT_FALSE(solve(rig.problem, rig.point, 0.0, {}).usable());
}

TEST(RecordingCost, HubersResidualsSquareToHubersLoss) {
  FitOptions robust;
  robust.loss_width = 1e-6;
  CostOfRig plain(short_run(), freed(1)), huber(short_run(), freed(1), robust);
  const RecordingCost a(plain.problem, 0, plain.point.starts[0], 2.5);
  const RecordingCost b(huber.problem, 0, huber.point.starts[0], 2.5);
  const std::vector<double> q = plain.numbers(2.5);
  std::vector<double> r(plain.recording.size()), s(r.size());
  ASSERT_TRUE(a.evaluate(q.data(), r.data(), nullptr).valid);
  ASSERT_TRUE(b.evaluate(q.data(), s.data(), nullptr).valid);
  const double w = 1e-6 / plain.problem.floors[0];
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double size = std::abs(r[i]);
    ASSERT_NEAR(s[i] * s[i], size <= w ? size * size : 2.0 * w * size - w * w, 1e-9);
  }
}

TEST(RecordingCost, TheObserverForgetsAWrongStartAtItsOwnRate) {
  // A free mass under the gains: the error of x1 falls as (1 + …) pⁿ with p = exp(−2π f dt).
  const double dt = 1e-3, hz = 5.0;
  PlantModel<double> mass;
  mass.structure.has_load = false;
  mass.drive.motor_inertia = 1.0;
  Recording still;
  still.dt = dt;
  still.u.assign(1000, 0.0), still.x1.assign(1000, 0.0);
  std::vector<double> error;
  ASSERT_TRUE(roll_out(mass, DriveState<double>{1.0, 0.0, 0.0, 0.0}, still.motor_trace(),
                       ObserverGains(hz, still.motor_trace()),
                       [&](std::size_t, const DriveStepper<double>& s) { error.push_back(s.state().x1); }));
  const double p = std::exp(-2.0 * kPi * hz * dt);
  // e(n) = (1 + a n) pⁿ with both poles at p: the second difference of e(n)/pⁿ vanishes.
  for (std::size_t n = 10; n < 150; n += 10) {
    const auto scaled = [&](std::size_t k) { return error[k] / std::pow(p, static_cast<double>(k)); };
    EXPECT_NEAR(scaled(n + 10) - 2.0 * scaled(n) + scaled(n - 10), 0.0, 1e-8);
  }
  EXPECT_LT(std::abs(error.back()), 1e-9);
}

}  // namespace
}  // namespace gapscope::internal::reference
