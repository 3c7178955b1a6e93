#include "reference/model_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "reference/identifiability.h"
#include "reference/information.h"
#include "reference/outcome.h"
#include "reference/search.h"
#include "reference/solvers.h"
#include "reference/starts.h"
#include "reference/words.h"

namespace gapscope::internal::reference {
namespace {

/// Covariance of the free parameters, in solver units, by two readings of the residuals, of which the larger
/// holds. Directions that the fit does not determine at all count for nothing here, see determine().
struct Covariances {
  Eigen::MatrixXd white;    ///< of autocorrelated residuals; empty: the motion diverges
  Eigen::MatrixXd scatter;  ///< of the scatter of the windows' scores
};
Covariances covariances_at(const FitProblem& fitted, const FitPoint& at, double observer_hz);

/// Of JᵀJ, over the directions that are determined.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& normal, double max_condition) {
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * normal *
                                                             scale.asDiagonal());
  const double least = eigen.eigenvalues().maxCoeff() / max_condition;
  const Eigen::VectorXd inverse =
      eigen.eigenvalues().unaryExpr([&](double e) { return e > least ? 1.0 / e : 0.0; });
  const Eigen::MatrixXd v = scale.asDiagonal() * eigen.eigenvectors();
  return v * inverse.asDiagonal() * v.transpose();
}

Covariances covariances_at(const FitProblem& fitted, const FitPoint& at, double observer_hz) {
  const auto shared = static_cast<Eigen::Index>(fitted.free_count());
  const Information info = information_at(fitted, at, observer_hz);
  if (!info.valid) return {};
  const Eigen::MatrixXd inverse = inverse_of(info.normal, fitted.options.max_condition);
  const double windows = std::max(2, info.window_count);
  return {info.variance * info.inflation * inverse.topLeftCorner(shared, shared),
          windows / (windows - 1.0) * (inverse * info.windows * inverse).topLeftCorner(shared, shared)};
}

/// What a fit leaves open of another motion, to first order: the standard deviation of its prediction, rms
/// over the samples [floor], by the larger covariance sample by sample. NaN where a motion diverges.
/// @param there derivatives of the other motion by the shared numbers
double prediction_std(const FitProblem& fitted, const FitPoint& at, std::span<const LinearResiduals> there,
                      double observer_hz) {
  if (there.empty()) return kNaN;
  if (fitted.free_count() == 0) return 0.0;
  const Covariances of = covariances_at(fitted, at, observer_hz);
  if (of.white.size() == 0) return kNaN;
  double sum = 0.0, samples = 0.0;
  for (const LinearResiduals& r : there) {
    const Eigen::MatrixXd& j = r.derivatives;
    const Eigen::ArrayXd by_white = (j * of.white).cwiseProduct(j).rowwise().sum().array();
    const Eigen::ArrayXd by_scatter = (j * of.scatter).cwiseProduct(j).rowwise().sum().array();
    sum += by_white.max(by_scatter).sum(), samples += static_cast<double>(j.rows());
  }
  return std::sqrt(sum / samples);
}

}  // namespace

ParameterSetting& setting_of(ReferenceModel& model, ParameterId id) {
  const auto index = static_cast<std::size_t>(id.index);
  if (id.effect == ParameterId::kDrive) return model.parameters[index];
  if (id.effect == ParameterId::kController) return model.controller->numbers[index];
  return model.effects[id.effect].parameters[index];
}

FitPoint FitPoint::beginning_with(std::span<const double> first) const {
  FitPoint to = *this;
  std::copy(first.begin(), first.end(), to.q.begin());
  return to;
}

FitLinearisation::FitLinearisation(std::vector<double> q, std::vector<LinearResiduals> recordings)
    : q_(std::move(q)),
      recordings_(std::make_shared<const std::vector<LinearResiduals>>(std::move(recordings))) {}

ModelFit::ModelFit(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                   const FitOptions& options, double observer_hz)
    : problem_(std::make_unique<const FitProblem>(make_problem(recordings, model, options))),
      work_(options.work),
      model_(model),
      observer_hz_(observer_hz) {
  for (const MotorTrace& t : recordings) samples_ += static_cast<double>(t.size());
}
ModelFit::~ModelFit() = default;
ModelFit::ModelFit(ModelFit&&) noexcept = default;

void ModelFit::count(double simulations) const {
  if (work_) *work_ += std::llround(samples_ * simulations);
}

bool ModelFit::values_are_given() const { return reference::values_are_given(*problem_); }

FitPoint ModelFit::given_point() const { return reference::given_point(*problem_); }

FitPoint ModelFit::point_of(const ReferenceModel& values, std::vector<RecordingStart> starts) const {
  FitPoint point{{}, std::move(starts)};
  ReferenceModel model = values;
  for (std::size_t i = 0; i < problem_->free_count(); ++i) {
    const Parameter& p = problem_->free_parameter(i);
    const bool known = p.id.effect < std::ssize(model.effects);
    const double value = known ? setting_of(model, p.id).value : p.start;
    point.q.push_back(p.coordinate.solver(std::clamp(std::isnan(value) ? p.start : value, p.low, p.high)));
  }
  return point;
}

std::optional<FitPoint> ModelFit::with_loads_placed(const FitPoint& at) const {
  Placement placed = choose_variants(*problem_, at, observer_hz_);
  if (!placed.changed) return {};
  return FitPoint{at.q, std::move(placed.starts)};
}

std::optional<FitPoint> ModelFit::search() const {
  const SearchResult found = find_minima(*problem_);
  count(found.simulations);
  const Solution best = found.best();
  if (!best.usable()) return {};
  return best;
}

RefinedFit ModelFit::refine(const FitPoint& from, const RefineEffort& effort) const {
  RefinedFit found = reference::refine(*problem_, from, observer_hz_, effort);
  count(found.simulations);
  return found;
}

RefinedFit ModelFit::refine_with_loads_placed(const FitPoint& from, const RefineEffort& effort) const {
  const Placement first = choose_variants(*problem_, from, observer_hz_);
  RefinedFit found = refine({from.q, first.starts}, effort);
  found.simulations += first.simulations;
  if (!found.usable()) return found;
  const Placement then = choose_variants(*problem_, found, observer_hz_);
  found.simulations += then.simulations;
  if (!then.changed) return found;
  found.starts = then.starts;
  RefinedFit again = refine(found, effort);
  again.simulations = found.simulations += again.simulations;
  return again.mean_cost < found.mean_cost ? again : found;
}

AdjustedFit ModelFit::adjust(const FitPoint& from, const FitLinearisation& borrowed, int steps) const {
  AdjustedFit found = reference::adjust(*problem_, from, *borrowed.recordings_, observer_hz_, steps);
  count(found.simulations);
  return found;
}

std::optional<FitLinearisation> ModelFit::linearise(const FitPoint& at) const {
  std::vector<LinearResiduals> recordings = reference::linearise(*problem_, at, observer_hz_);
  if (recordings.empty()) return {};
  return FitLinearisation(at.q, std::move(recordings));
}

std::optional<SineStart> ModelFit::sine_start(const FitPoint& at, const FitLinearisation& borrowed,
                                              double small) const {
  return reference::sine_start(*problem_, at, *borrowed.recordings_, small, observer_hz_);
}

double ModelFit::prediction_std(const FitPoint& at, const ModelFit& other, const FitPoint& there) const {
  return reference::prediction_std(*problem_, at, reference::linearise(*other.problem_, there, observer_hz_),
                                   observer_hz_);
}

std::vector<double> ModelFit::spreads(const FitPoint& at, std::span<const WeightedSum> sums) const {
  const Covariances of = covariances_at(*problem_, at, observer_hz_);
  if (of.white.size() == 0) return {};
  std::vector<double> spreads;
  for (const WeightedSum& sum : sums) {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(of.white.rows());
    for (std::size_t i = 0; i < problem_->free_count(); ++i) {
      const Parameter& p = problem_->free_parameter(i);
      for (const auto& [id, weight] : sum)
        if (p.id == id) slope(static_cast<Eigen::Index>(i)) += weight * p.coordinate.slope(at.q[i]);
    }
    spreads.push_back(std::sqrt(std::max(slope.dot(of.white * slope), slope.dot(of.scatter * slope))));
  }
  return spreads;
}

StandardErrors ModelFit::standard_errors(const FitPoint& at) const {
  const Information information = information_at(*problem_, at, observer_hz_);
  count(information.simulations);
  return errors_of(at, information, {});
}

std::optional<SettledFit> ModelFit::settled(const FitPoint& at, int iterations) const {
  FitProblem problem = *problem_;
  problem.options.max_iterations = iterations;
  const Square predicted = mean_square_with_priors(problem, at, problem.options.observer_hz);
  const Solution found{at, predicted.value};
  if (is_rejected(problem, found)) return {};
  const FitOutcome outcome = outcome_near_floor(problem, found);
  count(predicted.simulations + outcome.simulations);
  const Solution& s = outcome.solution;
  return SettledFit{{s, s.mean_square_with_priors, s.converged, s.simulations},
                    errors_of(s, outcome.information, outcome.shift())};
}

StandardErrors ModelFit::errors_of(const FitPoint& at, const Information& information,
                                   const std::vector<double>& shift) const {
  const Determination determined = determine(*problem_, at, information, shift);
  const std::vector<ParameterId> ends = at_bound(at);
  StandardErrors errors;
  for (std::size_t i = 0; i < problem_->free_count(); ++i) {
    const ParameterId id = problem_->free_parameter(i).id;
    const bool ended = std::find(ends.begin(), ends.end(), id) != ends.end();
    errors.numbers.emplace_back(id, ended ? kNaN : determined.std[i]);
  }
  if (information.timing.is_off()) errors.doubts.push_back(words::mistimed(information.timing));
  if (information.correlation.excess() > kWhite)
    errors.doubts.push_back(words::patterned(information.correlation));
  return errors;
}

ReferenceModel ModelFit::model_at(const FitPoint& at) const {
  const ModelNumbers<double> numbers = problem_->numbers(at.q.data());
  ReferenceModel model = model_;
  for (const Parameter& p : problem_->parameters) setting_of(model, p.id).value = numbers[p.id];
  return model;
}

ModelRun ModelFit::run_at(const FitPoint& at) const {
  const ModelNumbers<double> numbers = problem_->numbers(at.q.data());
  ModelRun run{problem_->plant_model(numbers), {}};
  for (const RecordingStart& start : at.starts)
    run.starts.push_back(problem_->state(start, 0.5 * run.plant.drive.gap, start.q.data()));
  if (problem_->controller)
    for (std::size_t r = 0; r < problem_->recordings.size(); ++r)
      run.inputs.push_back(problem_->commanded(numbers, r));
  return run;
}

std::vector<ParameterId> ModelFit::at_bound(const FitPoint& at) const {
  std::vector<ParameterId> ids;
  for (std::size_t i = 0; i < problem_->free_count(); ++i)
    if (const Parameter& p = problem_->free_parameter(i); p.at_bound(at.q[i])) ids.push_back(p.id);
  return ids;
}

Interval ModelFit::bounds(ParameterId id) const {
  for (const Parameter& p : problem_->parameters)
    if (p.id == id) return {p.low, p.high};
  return {};
}

}  // namespace gapscope::internal::reference
