#include <algorithm>
#include <cmath>

#include "gapscope/config/configuration.h"

namespace gapscope {
namespace {

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
  for (const double u : recording.u)
    s.excitation.amplitude =
        std::max(std::isnan(s.excitation.amplitude) ? 0.0 : s.excitation.amplitude, std::abs(u));
  s.excitation.frequency = frequency_of(recording);
  return s;
}

void fix(ParameterSetting& p) { p = {p.value, false, kNaN, kNaN, {}}; }

}  // namespace

std::string fitted_yaml(const Configuration& given, const ReferenceModel& fitted,
                        const MotorTrace& recording) {
  Configuration c = given;
  c.name = given.name + "_fitted";
  c.recording.reset();
  if (!c.simulation) c.simulation = simulation_of(recording);
  c.model.structure = fitted.structure;
  c.model.parameters = fitted.parameters;
  for (ParameterSetting& p : c.model.parameters) fix(p);
  c.model.effects.clear();
  for (ModelEffect effect : fitted.effects) {
    for (ParameterSetting& p : effect.parameters) fix(p);
    c.model.effects.push_back({effect, 0});
  }
  SimulatedPlant& plant = c.simulation->plant;
  plant = {fitted.structure, {}, c.model.effects};
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const double value = fitted.parameters[static_cast<std::size_t>(i)].value;
    if (!std::isnan(value)) drive_parameter(plant.drive, i) = value;
  }
  return "# The model as the diagnosis fitted it; `gapscope simulate` runs it.\n" + resolved_yaml(c);
}

}  // namespace gapscope
