#include <algorithm>
#include <cmath>

#include "gapscope/reference/fit.h"

namespace gapscope {

ParameterSetting ParameterSetting::known(double value) {
  ParameterSetting setting;
  setting.value = value;
  return setting;
}

ParameterSetting ParameterSetting::sought(double start) {
  ParameterSetting setting = known(start);
  setting.estimate = true;
  return setting;
}

ControllerModel ControllerModel::known(const DriveController& controller) {
  ControllerModel model{controller, {}};
  for (int i = 0; i < kControllerNumberCount; ++i)
    model.numbers[i] = ParameterSetting::known(controller_number(model.fixed, i));
  return model;
}

bool ControllerModel::estimates() const {
  return std::any_of(numbers.begin(), numbers.end(), [](const ParameterSetting& p) { return p.estimate; });
}

DriveController ControllerModel::at_start() const {
  DriveController c = fixed;
  for (int i = 0; i < kControllerNumberCount; ++i) {
    const double value = numbers[i].value;
    const double otherwise = i == leading_number(c.kind) ? 1.0 : 0.0;
    controller_number(c, i) = std::isnan(value) ? otherwise : value;
  }
  return c;
}

DriveController fitted_controller(const ControllerModel& model, const FitSummary& fit) {
  DriveController c = model.at_start();
  for (int i = 0; i < kControllerNumberCount; ++i) {
    const FittedParameter* fitted = fit.find(kControllerNumbers[i].key);
    if (fitted != nullptr && std::isfinite(fitted->value)) controller_number(c, i) = fitted->value;
  }
  return c;
}

void ReferenceModel::set(std::string_view key, const ParameterSetting& setting) {
  parameters[drive_parameter_index(key)] = setting;
}

}  // namespace gapscope
