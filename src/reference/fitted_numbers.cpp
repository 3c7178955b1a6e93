#include "reference/fitted_numbers.h"

#include <cmath>
#include <string>

namespace gapscope {

ReferenceModel with_fitted_numbers(ReferenceModel model, const FitSummary& fit) {
  const auto take = [&](ParameterSetting& p, const std::string& key) {
    const FittedParameter* fitted = fit.find(key);
    if (fitted != nullptr && std::isfinite(fitted->value)) p.value = fitted->value;
  };
  for (int i = 0; i < kDriveParameterCount; ++i) take(model.parameters[i], kDriveParameters[i].key);
  for (ModelEffect& effect : model.effects)
    for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i)
      take(effect.parameters[i], std::string(effect.entry->name) + "." + effect.entry->parameters[i].key);
  return model;
}

}  // namespace gapscope
