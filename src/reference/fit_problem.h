#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/simulation/stepper.h"
#include "reference/coordinate.h"
#include "reference/input_delay.h"
#include "reference/model_fit.h"
#include "signals/one_body.h"

namespace gapscope::internal::reference {

/// Every number of the model: the drive's parameters, the controller's, then kMostEffectParameters for each
/// effect.
template <class T>
class ModelNumbers {
 public:
  explicit ModelNumbers(std::size_t effects)
      : values_(kBeforeEffects + effects * kMostEffectParameters, T(0.0)) {}

  T& operator[](ParameterId id) { return values_[place_of(id)]; }
  const T& operator[](ParameterId id) const { return values_[place_of(id)]; }
  const T& drive(int place) const { return values_[static_cast<std::size_t>(place)]; }
  const T& controller(int place) const { return values_[place_of(number_of_controller(place))]; }
  std::span<const T> effect(std::size_t e, std::size_t count) const {
    return std::span<const T>(values_).subspan(kBeforeEffects + e * kMostEffectParameters, count);
  }

 private:
  static constexpr int kBeforeEffects = kDriveParameterCount + kControllerNumberCount;

  static std::size_t place_of(ParameterId id) {
    const int first = id.effect == ParameterId::kDrive ? 0
                      : id.effect == ParameterId::kController
                          ? kDriveParameterCount
                          : kBeforeEffects + id.effect * kMostEffectParameters;
    return static_cast<std::size_t>(first + id.index);
  }

  std::vector<T> values_;
};

/// One number that the model's structure has.
struct Parameter {
  ParameterId id;
  std::string key, unit;
  double start = kNaN;
  double low = kNaN, high = kNaN;
  double typical = kNaN;  ///< size at which it would matter
  bool estimated = false;
  bool given = true;         ///< false: the start was derived from the recordings
  bool amount = false;       ///< of an effect that is not there at 0
  double impossible = kNaN;  ///< a start that was given and is beyond what the drive can have
  std::optional<Prior> prior;
  Coordinate coordinate;

  /// @param q in solver units
  bool at_bound(double q) const;
};

/// Recordings under what a controller makes of their targets before it is fitted.
struct StartInputs {
  std::vector<std::vector<double>> u;
  std::vector<MotorTrace> recordings;
};

/// All that the searches share: data, floors and parameters.
struct FitProblem {
  std::span<const MotorTrace> recordings;
  DriveStructure structure;
  FitOptions options;
  signals::OneBody rough;
  double inertia = 0.0;  ///< of motor and a free load together, by that balance [kg m²]; 0: it tells none
  std::vector<double> floors;         ///< per recording [rad]
  std::vector<Parameter> parameters;  ///< all of the structure, in the order of the keys
  std::vector<int> free;              ///< indices of the estimated ones
  std::vector<const EffectEntry*> effects;
  std::optional<DriveController> controller;  ///< that makes the inputs, at its start
  bool delays = false;  ///< its updates are all at rows: the model's input is delayed, and exactly
  std::shared_ptr<const StartInputs> inputs;  ///< that the recordings have then
  bool load_may_stick = false, motor_may_stick = false;
  double stiffest = kInfinity;  ///< rate beyond which a trial is refused [1/s]

  std::size_t free_count() const { return free.size(); }
  const Parameter& free_parameter(std::size_t i) const { return parameters[free[i]]; }
  /// Whether the recorded body has friction that can hold it.
  bool recorded_may_stick() const { return structure.reads_load() ? load_may_stick : motor_may_stick; }
  bool locked() const { return structure.has_load && structure.load == LoadKind::kLocked; }

  /// The initial numbers of a recording that are searched. Under an observer the motor's own do not matter.
  std::vector<int> free_states(const RecordingStart& start, bool free_run) const;

  /// Fastest rate of the drive, in contact [1/s].
  double stiffness(const ModelNumbers<double>& n) const;

  /// Physical numbers from the solver's vector of the free ones.
  template <class T>
  ModelNumbers<T> numbers(const T* q) const {
    ModelNumbers<T> n(effects.size());
    for (const Parameter& p : parameters) n[p.id] = T(p.start);
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Parameter& p = free_parameter(i);
      n[p.id] = p.coordinate.physical(q[i]);
    }
    return n;
  }

  template <class T>
  PlantModel<T> plant_model(const ModelNumbers<T>& n) const {
    PlantModel<T> model;
    for (int i = 0; i < kDriveParameterCount; ++i) drive_parameter(model.drive, i) = n.drive(i);
    model.structure = structure;
    model.load_sticks = load_may_stick;
    for (std::size_t e = 0; e < effects.size(); ++e)
      add_effect(model, *effects[e], n.effect(e, effects[e]->parameters.size()));
    if (delays) delay_input(model, n.controller(controller_place::kDelay));
    return model;
  }

  /// The controller with these numbers.
  template <class T>
  ControllerOf<T> controller_of(const ModelNumbers<T>& n) const {
    ControllerOf<T> c;
    c.kind = controller->kind, c.rate = controller->rate;
    c.saturation = controller->saturation, c.dead_band = controller->dead_band;
    for (int i = 0; i < kControllerNumberCount; ++i) gapscope::controller_number(c, i) = n.controller(i);
    if (delays) c.delay = T(0.0);
    return c;
  }

  /// What that controller makes of the target of recording r.
  template <class T>
  std::vector<T> commanded(const ModelNumbers<T>& n, std::size_t r) const {
    return commanded_input(controller_of(n), recordings[r]);
  }

  /// Initial state from all four solver numbers of a recording.
  template <class T>
  DriveState<T> state(const RecordingStart& start, const T& half_gap, const T* q) const {
    DriveState<T> z;
    z.x1 = start.x1 + start.scale[0] * q[0];
    z.w1 = start.w1 + start.scale[1] * q[1];
    z.x2 = z.x1, z.w2 = z.w1;  // an effect may divide the one inertia
    if (!structure.has_load) return z;
    if (structure.reads_load()) {
      z.w1 = T(0.0);
      z.x1 = z.x2 + static_cast<double>(start.variant.side) * half_gap + start.scale[2] * q[2];
      if (start.variant.other_moves) z.w1 = z.w2 + start.scale[3] * q[3];
      return z;
    }
    z.w2 = T(0.0);
    z.x2 = z.x1 - static_cast<double>(start.variant.side) * half_gap - start.scale[2] * q[2];
    if (start.variant.other_moves && !locked()) z.w2 = z.w1 + start.scale[3] * q[3];
    return z;
  }
};

/// The same problem where the model has one more law, from a point on that it has without it: where that
/// point's numbers stand, those of the law at the values that are given, NaN: held at their neutral ones.
/// @param from  in the numbers of `problem`; on return in those of the new one
FitProblem with_law(const FitProblem& problem, const EffectEntry& law, std::span<const double> begins,
                    FitPoint& from);

/// Reads the settings and the recordings. @throws std::logic_error, see fit().
FitProblem make_problem(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                        const FitOptions& options);

}  // namespace gapscope::internal::reference
