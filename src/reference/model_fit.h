#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gapscope/base/doubt.h"
#include "gapscope/plant/plant_model.h"
#include "gapscope/reference/fit.h"

namespace gapscope::internal::reference {

/// One number of a model.
struct ParameterId {
  static constexpr int kDrive = -1, kController = -2;

  int effect = kDrive;  ///< place in ReferenceModel::effects; else a number of the drive, the controller
  int index = 0;        ///< place in kDriveParameters, kControllerNumbers, or in the effect's specification

  bool operator==(const ParameterId&) const = default;
};
constexpr ParameterId drive_number(int place) { return {ParameterId::kDrive, place}; }
constexpr ParameterId number_of_controller(int place) { return {ParameterId::kController, place}; }
ParameterSetting& setting_of(ReferenceModel& model, ParameterId id);

/// Where the other body, the one without the encoder, may be at the first sample.
struct InitialVariant {
  int side = 0;              ///< −1, +1: motor and load touch at that edge of the gap, 0: in its middle
  bool other_moves = false;  ///< with the speed of the one that is recorded; else at rest
};

/// Initial state of one recording in solver units, all linear:
///   x1(0) = x̄1 + s0 q0,  w1(0) = w̄1 + s1 q1,  x2(0) = x1(0) − side β − s2 q2,  w2(0) = w1(0) + s3 q3 (or 0)
/// With the encoder on the load 1 and 2 change places, and x1(0) = x2(0) + side β + s2 q2.
inline constexpr int kStates = 4;
struct RecordingStart {
  double x1 = 0.0, w1 = 0.0;  ///< x̄1, w̄1 of the recorded body, from a local polynomial
  bool moves = false;         ///< w̄1 is clearly not zero
  InitialVariant variant;
  std::array<double, kStates> scale{};
  std::array<double, kStates> q{};
};

/// A point of a search, in solver units.
struct FitPoint {
  std::vector<double> q;               ///< the free parameters
  std::vector<RecordingStart> starts;  ///< one per recording

  /// This point with its first numbers replaced.
  FitPoint beginning_with(std::span<const double> first) const;
};

/// How far refine() goes.
struct RefineEffort {
  int jacobians = 8;        ///< exact derivatives at most so many times
  int trials = 40;          ///< plain runs
  double tolerance = 1e-4;  ///< relative decrease of the cost at which it stops
};

/// Where refine() ended.
struct RefinedFit : FitPoint {
  /// Of the residuals, the priors and the widths of the initial states, over the samples [floor²]; infinite:
  /// failed.
  double mean_cost = kInfinity;
  bool converged = false;
  double simulations = 0.0;  ///< spent on it, a Jet run counted as its measured cost in plain ones

  bool usable() const { return mean_cost < kInfinity; }
};

/// Where adjust() ended.
struct AdjustedFit : FitPoint {
  double residual_mean_square = kInfinity;  ///< of the residuals alone [floor²]; infinite: failed
  double simulations = 0.0;                 ///< plain runs spent on it

  bool usable() const { return residual_mean_square < kInfinity; }
};

/// Residuals at a point and their derivatives by the free parameters.
class FitLinearisation;

/// Where the search for a sine begins.
struct SineStart {
  double amplitude = 0.0;  ///< in the unit of the effect
  double phase = 0.0;      ///< [rad]
};

/// A model with all its numbers as the simulator takes it, and the state that each recording begins with.
struct ModelRun {
  PlantModel<double> plant;
  std::vector<DriveState<double>> starts;
  /// That its controller makes of the targets; without one empty.
  std::vector<std::vector<double>> inputs = {};

  /// A recording under the input that the model takes.
  MotorTrace under_own_input(const MotorTrace& recording, std::size_t r) const {
    MotorTrace trace = recording;
    if (!inputs.empty()) trace.u = inputs[r], trace.sent = {}, trace.delay = 0.0;
    return trace;
  }
};

/// Σ weight · parameter.
using WeightedSum = std::vector<std::pair<ParameterId, double>>;

/// What a model leaves of several things, one vector for each, in any unit; none at all: its motion diverges.
using ErrorKinds = std::function<std::vector<std::vector<double>>(const ModelRun&)>;

/// What a fit knows of its free numbers.
struct StandardErrors {
  std::vector<std::pair<ParameterId, double>>
      numbers;                ///< [unit of the number]; NaN: not determined, or at a bound
  std::vector<Doubt> doubts;  ///< that what it leaves raises against all of them
};

/// The end of a fit, and what it knows of its numbers there.
struct SettledFit {
  RefinedFit end;
  StandardErrors errors;
};

struct FitProblem;
struct Information;

/// A model beside recordings, to be fitted again and again by other modules: from here, with this effort. The
/// whole fit, with intervals and what they rest on, is fit().
///
/// Residuals are the innovations of the model run as an observer (see observer.h), in floors of the encoder.
class ModelFit {
 public:
  /// @param observer_hz poles of the observer [Hz]; 0: the free run
  /// @throws std::logic_error, see fit(). The recordings must live as long as this does.
  ModelFit(std::span<const MotorTrace> recordings, const ReferenceModel& model, const FitOptions& options,
           double observer_hz);
  ~ModelFit();
  ModelFit(ModelFit&&) noexcept;

  const ReferenceModel& model() const { return model_; }

  /// Whether every free parameter has a value of the user's, not one that the recordings suggest.
  bool values_are_given() const;
  /// The given (or derived) values, each recording beginning as its first samples show it.
  FitPoint given_point() const;
  /// The values of a model of the same numbers, or of their first ones; the others as given.
  FitPoint point_of(const ReferenceModel& values, std::vector<RecordingStart> starts) const;
  /// The point with each recording's load where it fits best; nullopt where it stands there already.
  std::optional<FitPoint> with_loads_placed(const FitPoint& at) const;

  /// From afar: local searches from several starts, see fit(). Nothing if all of them diverge.
  std::optional<FitPoint> search() const;
  /// From nearby, see refine() in src/reference/solvers.h.
  RefinedFit refine(const FitPoint& from, const RefineEffort& effort) const;
  /// The same with the loads placed before and, where they move, once more after.
  RefinedFit refine_with_loads_placed(const FitPoint& from, const RefineEffort& effort) const;
  /// By plain runs alone, see adjust() in src/reference/solvers.h.
  AdjustedFit adjust(const FitPoint& from, const FitLinearisation& borrowed, int steps) const;
  /// Empty where the motion diverges.
  std::optional<FitLinearisation> linearise(const FitPoint& at) const;
  /// Amplitude and phase of a sine, the last two numbers of the model, that explain with all the others what
  /// a model without it leaves: both quarters of the sine act in proportion to their size while it is small.
  /// @param borrowed residuals without the sine, derivatives by the other numbers
  /// @param small size of the sine at which its action is tried
  std::optional<SineStart> sine_start(const FitPoint& at, const FitLinearisation& borrowed,
                                      double small) const;

  /// What this fit leaves open of the motion that another one runs, see prediction.h [floor].
  double prediction_std(const FitPoint& at, const ModelFit& other, const FitPoint& there) const;

  /// Standard deviations that a fit leaves sums of its parameters with, to first order, see covariances_at();
  /// what is not estimated counts as known. Empty where the motion diverges.
  std::vector<double> spreads(const FitPoint& at, std::span<const WeightedSum> sums) const;

  /// By the rule of fit(), at this observer alone.
  StandardErrors standard_errors(const FitPoint& at) const;

  /// From where the search has ended to the values that fit() would report, and with its errors. Nothing
  /// where the model is not the drive: its free run says nothing of the numbers.
  /// @param iterations of each local search at most, see FitOptions::max_iterations
  std::optional<SettledFit> settled(const FitPoint& at, int iterations) const;

  /// Moves the free numbers down the mean log of the sizes of errors that a caller defines, by differences;
  /// initial states stay. Nothing where no step goes down.
  /// @param kinds  called by several threads at a time
  /// @param held   numbers that stay, too
  std::optional<FitPoint> lessen(const FitPoint& from, const ErrorKinds& kinds,
                                 std::span<const ParameterId> held, int iterations, int threads) const;

  /// The model with the values of a point.
  ReferenceModel model_at(const FitPoint& at) const;
  ModelRun run_at(const FitPoint& at) const;
  /// The free numbers that stand at a bound.
  std::vector<ParameterId> at_bound(const FitPoint& at) const;
  Interval bounds(ParameterId id) const;  ///< NaN for a number that the model's structure does not have

 private:
  /// Counts what was spent, in samples, where the options ask for it.
  void count(double simulations) const;
  StandardErrors errors_of(const FitPoint& at, const Information& information,
                           const std::vector<double>& shift) const;

  std::unique_ptr<const FitProblem> problem_;
  std::shared_ptr<std::atomic<std::int64_t>> work_;
  double samples_ = 0.0;  ///< of all recordings
  ReferenceModel model_;
  double observer_hz_;
};

struct LinearResiduals;

/// Cheap to copy: what it holds is shared and never changes.
class FitLinearisation {
 public:
  /// The free parameters where it was taken, in solver units.
  const std::vector<double>& q() const { return q_; }

 private:
  friend class ModelFit;
  FitLinearisation(std::vector<double> q, std::vector<LinearResiduals> recordings);

  std::vector<double> q_;
  std::shared_ptr<const std::vector<LinearResiduals>> recordings_;
};

}  // namespace gapscope::internal::reference
