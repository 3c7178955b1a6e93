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

void ReferenceModel::set(std::string_view key, const ParameterSetting& setting) {
  parameters[static_cast<std::size_t>(drive_parameter_index(key))] = setting;
}

}  // namespace gapscope
