#include "diagnosis/settle.h"

#include <cmath>
#include <optional>
#include <utility>

#include "diagnosis/long_runs.h"

namespace gapscope::internal::diagnosis {

ScoredModel settled(const Study& study, const ScoredModel& model) {
  if (!std::isfinite(model.fitted.mean_cost)) return model;
  const double hz = study.observer_hz;
  FitOptions options = study.options.fit;
  options.work = nullptr;  // none of a search, which has its limit
  const reference::ModelFit fit(study.train, model.fitted.model, options, hz);
  const reference::FitPoint at = fit.point_of(model.fitted.model, starts_on(study, model.fitted));
  std::optional<reference::SettledFit> found = fit.settled(at, study.effort.settling);
  if (!found) return judge(model.entry, fitted_for_runs(study, model.fitted), study.held_out, hz);
  FittedModel fitted = fitted_at(fit, found->end);
  fitted.errors = std::move(found->errors);
  return judge(model.entry, std::move(fitted), study.held_out, hz);
}

}  // namespace gapscope::internal::diagnosis
