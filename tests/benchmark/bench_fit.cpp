// The reference on one problem: 16,000 samples, gap, motor damping, mass ratio, load damping, load Coulomb
// friction and the load's first position, from values wrong by 30 %. Printed:
//   - Jets against central differences in Ceres, the same residuals, start and options;
//   - one whole fit (observer, polish, intervals, traces) in plain simulations of the same length;
//   - with a file name, the first second of the recording for scipy_fit.py, and the time of that fit.
// CPU time of one thread; everything is timed in turn and the least of each counts.
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>

#include "gapscope/recording/recording_file.h"
#include "reference/ceres_terms.h"
#include "reference/rigs.h"
#include "reference/starts.h"

namespace gapscope {
namespace {

using namespace internal::reference;
using namespace test;

constexpr int kRepetitions = 7;
constexpr int kFree[] = {kGap, kMotorDamping, kMassRatio, kLoadDamping, kLoadCoulombFriction};

double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

BlindRig rig(bool sine) {
  BlindRig r;
  r.options = {2000.0, 8.0, 1, independent_plant::kFastTolerance};
  r.excitation.waveform = sine ? independent_plant::Waveform::kSine : independent_plant::Waveform::kMultisine;
  r.excitation.frequency = sine ? 1.0 : 0.5;
  r.excitation.amplitude = 0.6;
  r.drive.x2 = 0.004;
  return r;
}

ReferenceModel wrong_model(const independent_plant::BlindDrive& drive) {
  ReferenceModel model = known_model(drive);
  double factor = 1.3;
  for (const int n : kFree) {
    estimate(model, n, factor * model.parameters[static_cast<std::size_t>(n)].value);
    factor = 1.0 / factor;
  }
  return model;
}

/// The residuals without their Jacobian, for Ceres to difference.
struct Residuals {
  const RecordingTerm* term;
  bool operator()(double const* const* blocks, double* residuals) const {
    return term->Evaluate(blocks, residuals, nullptr);
  }
};

struct Solved {
  double cost = kNaN, time = 0.0;
};

/// Observer, then free run, by Ceres alone.
Solved solve_both(const FitProblem& problem, const internal::reference::FitPoint& from, bool jets) {
  std::vector<double> shared = from.q;
  Solved solved;
  for (const double hz : {2.5, 0.0}) {
    const RecordingCost cost(problem, 0, from.starts[0], hz);
    double simulations = 0.0;
    auto term = std::make_unique<RecordingTerm>(cost, simulations);
    std::vector<double> states(cost.states().size(), 0.0);
    ceres::Problem ceres_problem;
    std::vector<double*> blocks = {shared.data(), states.data()};
    if (jets) {
      ceres_problem.AddResidualBlock(term.get(), nullptr, blocks);
    } else {
      auto* numeric =
          new ceres::DynamicNumericDiffCostFunction<Residuals, ceres::CENTRAL>(new Residuals{term.get()});
      numeric->AddParameterBlock(static_cast<int>(shared.size()));
      numeric->AddParameterBlock(static_cast<int>(states.size()));
      numeric->SetNumResiduals(term->num_residuals());
      ceres_problem.AddResidualBlock(numeric, nullptr, blocks);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.function_tolerance = hz > 0.0 ? 1e-4 : 1e-8;
    options.max_num_iterations = 60;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    solved.time += seconds([&] { ceres::Solve(options, &ceres_problem, &summary); });
    solved.cost = summary.final_cost;
    if (jets) term.release();  // taken over by the problem
  }
  return solved;
}

void compare(bool sine, const char* file) {
  const BlindRig r = rig(sine);
  const Recording recording = r.recording();
  const MotorTrace trace = recording.motor_trace();
  const ReferenceModel model = wrong_model(r.drive);
  const FitProblem problem = make_problem({&trace, 1}, model, {});
  const internal::reference::FitPoint from = given_point(problem);
  double plain = kInfinity, jets = kInfinity, numeric = kInfinity, whole = kInfinity;
  Solved by_jets, by_differences;
  FitSummary summary;
  std::vector<double> residuals(recording.size());
  const RecordingCost truth(problem, 0, from.starts[0], 0.0);
  const std::vector<double> q = [&] {
    std::vector<double> v = from.q;
    v.resize(static_cast<std::size_t>(truth.numbers()), 0.0);
    return v;
  }();
  for (int i = 0; i < kRepetitions; ++i) {
    for (int j = 0; j < 10; ++j)
      plain = std::min(plain, seconds([&] { truth.evaluate(q.data(), residuals.data(), nullptr); }));
    by_jets = solve_both(problem, from, true);
    by_differences = solve_both(problem, from, false);
    jets = std::min(jets, by_jets.time), numeric = std::min(numeric, by_differences.time);
    whole = std::min(whole, seconds([&] { summary = fit_one(recording, model); }));
  }
  fmt::print(
      "{}: plain simulation {:.3f} ms; Jets {:.1f} ms (cost {:.6g}), central differences {:.1f} ms (cost "
      "{:.6g}): {:.2f} times faster\n",
      sine ? "sine" : "multisine", 1e3 * plain, 1e3 * jets, by_jets.cost, 1e3 * numeric, by_differences.cost,
      numeric / jets);
  fmt::print(
      "    one fit {:.1f} ms = {:.0f} plain simulations (counted: {}), gap {:.6f} rad, rmse/floor {:.3f}\n",
      1e3 * whole, whole / plain, summary.simulations, summary.find("gap")->value,
      summary.rmse / summary.floor);
  if (file == nullptr) return;
  Recording second = recording;
  second.u.resize(2000), second.x1.resize(2000), second.x2.clear(), second.mode.clear();
  write_csv(file, second);
  double brief = kInfinity;
  for (int i = 0; i < kRepetitions; ++i)
    brief = std::min(brief, seconds([&] { summary = fit_one(second, model); }));
  fmt::print("    first second, written to {}: one fit {:.1f} ms\n", file, 1e3 * brief);
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) {
  gapscope::compare(true, argc > 1 ? argv[1] : nullptr);
  gapscope::compare(false, nullptr);
}
