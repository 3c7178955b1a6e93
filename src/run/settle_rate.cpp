#include "run/settle_rate.h"

#include <fmt/format.h>

#include "run/fitted_command.h"

namespace gapscope::internal::run {
namespace {

constexpr std::size_t kLookedForRate = 3;  ///< recordings that are looked at
constexpr double kBetweenRows = 1000.0;    ///< rate of a firmware's own loop, which logs are slower than [Hz]
constexpr double kPrefers = 0.02;          ///< of the motion's error, that the other rate leaves more
constexpr int kStepsForRate = 20;          ///< of each fit

/// What the model leaves of the motion, one step ahead, with this rate [rad]; NaN: it cannot be fitted.
double left_with(double rate, const Configuration& c, std::vector<Recording> recordings) {
  ControllerModel controller = *c.controller;
  controller.fixed.rate = rate;
  command_anew(controller.at_start(), recordings);
  ReferenceModel model = c.reference_model();
  if (model.controller) model.controller = controller;
  FitOptions options = c.fit;
  options.starts = 1, options.max_iterations = kStepsForRate;
  options.compare_parts = options.search_halves = options.profile = false;
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  const FitSummary found = fit(traces, model, options);
  return found.status == FitStatus::kFailed ? kNaN : found.innovation_rmse;
}

}  // namespace

Configuration with_settled_rate(const Configuration& given, const Progress& progress,
                                std::vector<std::string>& said) {
  Configuration c = given;
  if (!c.recording || !c.controller || !c.controller->rate_sought || !c.model.given) return c;
  c.controller->rate_sought = false, c.controller->rate_settled = true;
  if (c.recording->reading.columns.reads_input()) return c;
  require_reference_model(c);
  Configuration first = c;
  first.recording->files.resize(std::min(kLookedForRate, first.recording->files.size()));
  progress("looking when the controller acts");
  const LoadedRecordings loaded = load_recordings(first, UnevenRows::kStamped, [](const std::string&) {});
  const double rows = left_with(0.0, c, loaded.recordings),
               between = left_with(kBetweenRows, c, loaded.recordings);
  const bool prefers = between < (1.0 - kPrefers) * rows;
  c.controller->fixed.rate = prefers ? kBetweenRows : 0.0;
  if (c.recording->reading.controller) c.recording->reading.controller->rate = c.controller->fixed.rate;
  if (prefers)
    said.push_back(fmt::format(
        "controller: rate: is not given: for this estimate the controller's loop is taken to run at {:g} Hz, faster "
        "than the log; at the log's own rate the model's error is {:.0f} % larger.",
        kBetweenRows, 100.0 * (rows / between - 1.0)));
  return c;
}

}  // namespace gapscope::internal::run
