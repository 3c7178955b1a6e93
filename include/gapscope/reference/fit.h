#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gapscope/base/fields.h"
#include "gapscope/plant/effect.h"
#include "gapscope/recording/controller.h"
#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit_summary.h"

namespace gapscope {

/// What is known beforehand of one parameter, as a Gaussian.
struct Prior {
  double value = kNaN;
  double std = kNaN;
};

/// One parameter of the model: a fixed number, or one to be estimated.
/// Bounds that are NaN are derived. With v the value (or, where it is NaN, the start that the recordings
/// suggest), the derived bounds are
///   gap                                            [0, travel of x1, peak to peak]
///   motor_inertia, torque_constant, mass_ratio,
///   contact_stiffness                              [v/100, 100 v]
///   dampings, Coulomb frictions                    [0, 100 v], and to 10 × what the recordings suggest
/// but dampings and stiffness at most 3 v, or what is as fast as 2 per sample if that is more.
struct ParameterSetting {
  double value = kNaN;  ///< NaN: not given, which needs estimate
  bool estimate = false;
  double low = kNaN;
  double high = kNaN;
  std::optional<Prior> prior;
  bool begun = false;  ///< the value is where a search begins, and nobody's statement

  static ParameterSetting known(double value);          ///< fixed
  static ParameterSetting sought(double start = kNaN);  ///< estimated; NaN: the recordings suggest a start
};

/// An effect of the catalogue that the model contains, its parameters in the order of the specification. A
/// value that is NaN and estimated starts at a tenth of its upper bound; derived bounds are those of the
/// catalogue. In summaries the keys read effect.parameter.
struct ModelEffect {
  const EffectEntry* entry = nullptr;
  std::array<ParameterSetting, kMostEffectParameters> parameters;
};

/// The controller that made the input of the target, where some of its numbers are to be estimated: u is then
/// made anew of the recorded rows (MotorTrace::command) at every trial, the position in it the recorded one.
/// Summaries call its numbers as kControllerNumbers do. A leading number without a value starts where the
/// inertia of the model would move as recorded.
struct ControllerModel {
  DriveController fixed;                                         ///< its laws, rate, limit and dead band
  std::array<ParameterSetting, kControllerNumberCount> numbers;  ///< in the order of kControllerNumbers
  bool rate_sought = false;   ///< at its rows or between them, as the recordings prefer
  bool rate_settled = false;  ///< by the recordings: a beginning, see fit_in_loop()

  static ControllerModel known(const DriveController& controller);  ///< nothing is estimated
  bool estimates() const;
  /// The controller with the values of its numbers, a leading one that has none at 1, others at 0.
  DriveController at_start() const;
};

/// The drive that is fitted. Parameters that its structure does not have are ignored: without a load only
/// motor_inertia, torque_constant and motor_damping are used; a locked load has no mass_ratio and no load_*;
/// a rigid contact has no contact_*.
struct ReferenceModel {
  DriveStructure structure;
  std::array<ParameterSetting, kDriveParameterCount> parameters;  ///< in the order of kDriveParameters
  std::vector<ModelEffect> effects;
  std::optional<ControllerModel> controller = {};  ///< only where it estimates

  /// @param key  of kDriveParameters ("gap")  @throws std::logic_error for any other
  void set(std::string_view key, const ParameterSetting& setting);
};

/// The controller with what a fit found of its numbers.
DriveController fitted_controller(const ControllerModel& model, const FitSummary& fit);

struct FitOptions {
  int starts = 6;               ///< local searches at most; they stop at the first that reaches the floor
  int max_iterations = 60;      ///< of each local search
  bool search_halves = true;    ///< of a recording, where a gap without a value was not found in the whole
  double observer_hz = 2.5;     ///< poles of the observer in the search [Hz]
  double rejected_hz = 30.0;    ///< poles when the model does not reach the encoder's floor [Hz]
  double rejected_ratio = 3.0;  ///< innovations above this many floors: the model is not the drive
  double loss_width = 0.0;      ///< Huber width [rad]; 0 = plain least squares
  double max_condition = 1e12;  ///< cond(JᵀJ) [-] with scaled columns; above it: not identifiable
  std::uint64_t seed = 1;       ///< of the starting points
  bool compare_parts = true;    ///< where the model is not the drive: its values on parts of the recordings
  bool profile = false;         ///< intervals from the profile likelihood as well
  std::optional<double>
      gap_seed;  ///< the gap by another estimate, about which every second start is drawn [rad]
  std::shared_ptr<std::atomic<std::int64_t>>
      work;  ///< samples of plain simulations are counted here; null: nowhere

  void fields(FieldVisitor& visitor);  ///< the one list: keys, bounds, units, docs
};

constexpr std::size_t kFewestFitted = 20;  ///< samples of a recording, so that they outnumber what is fitted

/// Fits the drive to the input and the motor encoder alone, all recordings jointly, each with its own initial
/// state (the load's position within the gap included).
///
/// 1. Search. The model runs as an observer of the encoder: innovation e = x1 measured − x1 predicted,
///      x1 ← x1 + l1 e,  w1 ← w1 + l2 e/dt,   l1 = 1 − p², l2 = (1 − p)², p = exp(−2π f dt),
///    dt the interval before the sample, both bodies alike while in contact. Least squares of e has a wide
///    basin at f = 2 to 3 Hz. Levenberg–Marquardt from several starts; exact derivatives through every
///    event.
/// 2. Polish, when the innovations are at the encoder's floor: the same at zero gain, the free run. Values
///    and intervals come from here.
/// 3. Otherwise the model is not the drive and a free run would bend inertia and friction to hide drift:
///    values come from the observer at rejected_hz, intervals from the scatter of windows and from how far
///    the values move between that gain and a third of it. A warning says so.
///
/// A rollout that diverges is never a residual: the step is refused. Intervals are widened for autocorrelated
/// residuals and for the quantiser (an undithered one repeats its error, it does not average out).
/// @throws std::logic_error for an empty span, a recording of fewer than kFewestFitted samples, or a
///   parameter that is neither given nor estimated.
FitSummary fit(std::span<const MotorTrace> recordings, const ReferenceModel& model,
               const FitOptions& options = {});

}  // namespace gapscope
