#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/model_reader.h"

namespace gapscope {
namespace internal::config {
namespace {

DriveStructure structure_of(const WrittenModel& written) {
  DriveStructure s;
  if (written.contact) std::tie(s.contact, s.restitution) = *written.contact;
  if (written.load) s.load = *written.load;
  const auto& ratio = written.parameters[place::kMassRatio];
  s.has_load = !(ratio && ratio->value == 0.0 && !ratio->estimate.value_or(false));
  if (s.has_load && ratio && ratio->value && *ratio->value > 0.0 && *ratio->value < kSmallestRatio)
    ratio->place.fail(
        fmt::format("is {}, expected 0 (no load) or at least {}", *ratio->value, kSmallestRatio));
  if (!s.has_load && s.load == LoadKind::kLocked)
    ratio->place.fail("is 0, which is a drive without a load, expected a load to be there with load: locked");
  return s;
}

/// Why a drive of this structure lacks a parameter.
const char* reason_of_absence(const DriveStructure& structure) {
  if (!structure.has_load) return "mass_ratio: 0 (one inertia, no load)";
  return structure.load == LoadKind::kLocked ? "load: locked" : "contact: rigid";
}

ParameterSetting absent_parameter(int index) {
  ParameterSetting p;
  p.estimate = index == place::kGap || index == place::kMotorDamping || index == place::kMassRatio;
  if (index == place::kLoadDamping || index == place::kLoadCoulombFriction || index == place::kContactDamping)
    p.value = 0.0;
  return p;
}

/// A ratio of 0 is another structure: what is estimated stays away from it.
void keep_ratio_from_zero(ParameterSetting& p, const Value& place) {
  if (p.value == 0.0)
    place.fail("starts at 0, expected more than 0 where it is estimated (0 fixed: no load)");
  if (p.high <= kSmallestRatio)
    place.fail(fmt::format("has an upper bound of {}, expected more than {}", p.high, kSmallestRatio));
  if (p.low < kSmallestRatio) p.low = kSmallestRatio;
}

ParameterSetting written_parameter(const WrittenParameter& written, int index) {
  ParameterSetting p;
  p.value = written.value.value_or(kNaN);
  p.estimate = written.estimate.value_or(!written.value);
  if (written.bounds) std::tie(p.low, p.high) = *written.bounds;
  if (p.value < p.low || p.value > p.high)  // NaN bounds compare false
    written.place.fail(fmt::format("is {}, expected {}", p.value,
                                   to_string(Range{p.low, p.high, kDriveParameters[index].unit})));
  if (written.prior) {
    if (!p.estimate) written.place.fail("has a prior but is fixed, expected estimate: true with it");
    if (!written.prior->first && !written.value)
      written.place.fail("has a prior without a value, expected prior: {value: ..., std: ...}");
    p.prior = Prior{written.prior->first.value_or(p.value), written.prior->second};
  }
  if (index == place::kMassRatio && p.estimate) keep_ratio_from_zero(p, written.place);
  return p;
}

/// A parameter that the structure does not have: its number is kept, it cannot be estimated.
ParameterSetting unused_parameter(const std::optional<WrittenParameter>& written,
                                  const DriveStructure& structure) {
  ParameterSetting p;
  if (!written) return p;
  if (written->estimate.value_or(!written->value))
    written->place.fail(
        fmt::format("is estimated, expected a fixed number or none with {}", reason_of_absence(structure)));
  p.value = *written->value;
  return p;
}

}  // namespace

ModelConfig resolved_model(const WrittenModel& written) {
  ModelConfig model;
  model.given = written.given;
  if (written.place) model.line = written.place->line();
  model.structure = structure_of(written);
  if (written.effects) model.effects = *written.effects;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const auto& given = written.parameters[i];
    model.defaulted[i] = !given || !given->value;
    model.guessed[i] = given && given->guess;
    if (!has_parameter(model.structure, i)) {
      model.parameters[i] = unused_parameter(given, model.structure);
    } else {
      model.parameters[i] = given ? written_parameter(*given, i) : absent_parameter(i);
    }
  }
  return model;
}

SimulatedPlant simulated_plant(const WrittenModel& written, const Value& simulation) {
  WrittenModel numbers = written;  // what is estimated is the fit's concern, the plant has numbers
  for (auto& parameter : numbers.parameters) {
    if (!parameter) continue;
    if (parameter->value) parameter->estimate = false;
    parameter->bounds.reset();
    parameter->prior.reset();
  }
  const bool no_ratio =
      numbers.parameters[place::kMassRatio] && !numbers.parameters[place::kMassRatio]->value;
  if (no_ratio) numbers.parameters[place::kMassRatio].reset();
  SimulatedPlant plant;
  plant.structure = structure_of(numbers);
  if (numbers.effects) plant.effects = *numbers.effects;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const auto& given = numbers.parameters[i];
    double value = given && given->value ? *given->value : kNaN;
    if (std::isnan(value)) value = absent_parameter(i).value;
    if (std::isnan(value) && !has_parameter(plant.structure, i))
      value = i == place::kMassRatio && plant.structure.has_load ? 1.0 : 0.0;
    if (std::isnan(value))
      simulation.fail(
          fmt::format("has no {0}, expected a number [{1}] in model.parameters.{0} or in "
                      "simulation.model.parameters.{0}",
                      kDriveParameters[i].key, kDriveParameters[i].unit));
    drive_parameter(plant.drive, i) = value;
  }
  return plant;
}

}  // namespace internal::config
}  // namespace gapscope
