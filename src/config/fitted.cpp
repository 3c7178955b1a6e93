#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "base/shown.h"
#include "config/begun_model.h"
#include "config/configuration.h"
#include "recording/supply.h"
#include "reference/fitted_numbers.h"

namespace gapscope {
namespace {

constexpr std::size_t kLongestName = 90;   ///< of a configuration, before the suffix
constexpr std::size_t kFirstSamples = 20;  ///< the first speed is read in so many or more
constexpr double kReadQuanta = 50.0;       ///< over which it is read: fewer may be one count that toggles
constexpr std::size_t kLargestPart = 50;   ///< of the recording for that: one in so many

/// Half the rate at which the input changes its sign, at least one period over the recording.
double frequency_of(const MotorTrace& recording) {
  int changes = 0;
  double last = 0.0;
  for (const double u : recording.u) {
    if (u == 0.0) continue;
    changes += last * u < 0.0 ? 1 : 0;
    last = u;
  }
  return std::max(1, changes / 2) / (recording.dt * static_cast<double>(recording.size()));
}

SimulationConfig simulation_of(const MotorTrace& recording) {
  SimulationConfig s;
  s.rate = 1.0 / recording.dt;
  s.duration = recording.dt * static_cast<double>(recording.size());
  s.excitation.kind = ExcitationKind::kSine;
  s.excitation.amplitude = 0.0;
  for (const double u : recording.u) s.excitation.amplitude = std::max(s.excitation.amplitude, std::abs(u));
  s.excitation.frequency = frequency_of(recording);
  return s;
}

/// The same under the input that a stored trace holds.
SimulationConfig replay_of(const MotorTrace& recording, const std::string& trace) {
  SimulationConfig s = simulation_of(recording);
  s.excitation = {};
  s.excitation.kind = ExcitationKind::kRecorded;
  s.excitation.file = trace;
  s.excitation.time_column = "t_s";
  return s;
}

/// The same under the controller that made the input: of the target in the trace.
void command(const DriveController& controller, const CommandRows& rows, Configuration& c) {
  DriveController then = controller_during(rows, controller);
  Excitation& e = c.simulation->excitation;
  e.input_column = "target_rad";
  if (is_supplied(rows)) e.voltage_column = "supply";
  c.controller = ControllerModel::known(then);
}

/// Of a parabola through the first samples, as many as it takes to see the encoder move; 0 if it hardly does.
double first_speed(const MotorTrace& recording) {
  const auto& x = recording.x1;
  const std::size_t most = std::max(kFirstSamples, recording.size() / kLargestPart) / 2;
  for (std::size_t k = kFirstSamples / 2; k <= most && 2 * k < x.size(); ++k)
    if (std::abs(x[2 * k] - x[0]) >= kReadQuanta * recording.quantum)
      return (4.0 * x[k] - 3.0 * x[0] - x[2 * k]) / (2.0 * recording.dt * static_cast<double>(k));
  return 0.0;
}

/// At the recording's first position and speed, the load with the motor; a locked one in the middle of the
/// play.
void begin_with(const MotorTrace& recording, const DriveStructure& structure, SimulationConfig& s) {
  const double x = recording.x1[0], w = first_speed(recording);
  s.initial = {x, w, x, w};
  if (structure.load != LoadKind::kLocked) return;
  const auto [low, high] = std::minmax_element(recording.x1.begin(), recording.x1.end());
  s.initial.x2 = (*low + *high) / 2.0;
  s.initial.w2 = 0.0;
}

void fix(ParameterSetting& p) { p = {p.value, false, kNaN, kNaN, {}}; }

/// The configuration with every number of the model fixed, for the fit and for the plant.
Configuration with_model(const Configuration& given, const ReferenceModel& fitted) {
  Configuration c = given;
  c.name = given.name.substr(0, kLongestName).append(kFittedSuffix);
  c.recording.reset();
  c.controller.reset();
  if (c.anchor) c.anchor = c.anchor->what_hangs();
  c.model.structure = fitted.structure;
  c.model.parameters = fitted.parameters;
  for (ParameterSetting& p : c.model.parameters) fix(p);
  c.model.effects.clear();
  for (ModelEffect effect : fitted.effects) {
    for (ParameterSetting& p : effect.parameters) fix(p);
    c.model.effects.push_back({effect, 0});
  }
  return c;
}

void set_plant(Configuration& c) {
  SimulatedPlant& plant = c.simulation->plant;
  plant = {c.model.structure, {}, c.model.effects};
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const double value = c.model.parameters[i].value;
    if (!std::isnan(value)) drive_parameter(plant.drive, i) = value;
  }
  c.simulation->independent = false;  // the model, whatever made the data
}

}  // namespace

namespace {

/// With what that recording's load has beyond that of the model.
ReferenceModel with_load_of(const MotorTrace& recording, ReferenceModel model) {
  if (recording.load.is_none()) return model;
  ParameterSetting& inertia = model.parameters[place::kMotorInertia];
  if (model.structure.has_load)
    model.parameters[place::kMassRatio].value += recording.load.inertia / inertia.value;
  else
    inertia.value += recording.load.inertia;
  const auto hangs = std::find_if(model.effects.begin(), model.effects.end(), [](const ModelEffect& e) {
    return e.entry == find_effect("load_unbalance");
  });
  if (hangs != model.effects.end()) hangs->parameters[0].value += recording.load.gravity;
  return model;
}

/// @param begin  null: not known
std::string begun_yaml(const Configuration& given, const ReferenceModel& fitted, const std::string& trace,
                       const MotorTrace& recording, const DriveState<double>* begin,
                       const std::optional<DriveController>& controller) {
  Configuration c = with_model(given, with_load_of(recording, fitted));
  if (c.anchor) c.anchor->take(recording.load);
  std::string input = "its input";
  if (!c.simulation) {
    c.simulation = trace.empty() ? simulation_of(recording) : replay_of(recording, trace);
    if (begin != nullptr)
      c.simulation->initial = {begin->x1, begin->w1, begin->x2, begin->w2};
    else
      begin_with(recording, c.model.structure, *c.simulation);
    input = (trace.empty() ? "a sine like the input of " : "the input of ") + shown(recording.file);
    if (controller && recording.command != nullptr && !trace.empty()) {
      command(*controller, *recording.command, c);
      input = "its controller and the goal of " + shown(recording.file);
    }
  }
  set_plant(c);
  return yaml_of(c,
                 "The model as the diagnosis fitted it, under " + input + "; `gapscope simulate` runs it.");
}

}  // namespace

std::string model_yaml(const Configuration& given, const ReferenceModel& fitted, const std::string& trace,
                       const MotorTrace& recording) {
  return begun_yaml(given, fitted, trace, recording, nullptr, {});
}

std::string model_yaml(const Configuration& given, const ReferenceModel& fitted, const std::string& trace,
                       const MotorTrace& recording, const DriveState<double>& begin,
                       const std::optional<DriveController>& controller) {
  return begun_yaml(given, fitted, trace, recording, &begin, controller);
}

std::string experiment_yaml(const Configuration& given, const ReferenceModel& model,
                            const NextExperiment& experiment) {
  GAPSCOPE_REQUIRE(experiment.proposes());
  Configuration c = with_model(given, model);
  c.name = given.name.substr(0, kLongestName) + "_next";
  c.simulation.emplace();
  c.simulation->rate = experiment.rate;
  c.simulation->duration = experiment.duration;
  c.simulation->excitation = experiment.tried.front().excitation;
  set_plant(c);
  return yaml_of(c,
                 "The experiment that the diagnosis proposes, on the model that came first; `gapscope "
                 "simulate` runs it.");
}

std::string fit_yaml(const Configuration& given, const FitSummary& fit, const std::string& trace,
                     const MotorTrace& recording) {
  GAPSCOPE_REQUIRE(!fit.initial_states.empty());
  Configuration c =
      with_model(given, with_load_of(recording, with_fitted_numbers(given.reference_model(), fit)));
  if (c.anchor) c.anchor->take(recording.load);
  if (!c.simulation) c.simulation = replay_of(recording, trace);
  if (recording.command != nullptr && given.recording && given.recording->reading.controller)
    command(
        given.controller ? fitted_controller(*given.controller, fit) : *given.recording->reading.controller,
        *recording.command, c);
  const DriveState<double>& start = fit.initial_states.front().state;
  c.simulation->initial = {start.x1, start.w1, start.x2, start.w2};
  c.simulation->noise = 0.0;
  set_plant(c);
  return yaml_of(
      c, c.controller
             ? "The fitted model under its controller and the goal of its recording; `gapscope "
               "simulate` runs it as it is."
             : "The fitted model under the input of its recording; `gapscope simulate` runs it as it is.");
}

}  // namespace gapscope
