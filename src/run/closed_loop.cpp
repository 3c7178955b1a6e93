#include "run/closed_loop.h"

#include <algorithm>
#include <cmath>

#include "base/cut_short.h"
#include "reference/fitted_numbers.h"
#include "run/fitted_command.h"

namespace gapscope::internal::run {
namespace {

/// The first row of a recording while it was off, and the first one after that.
std::pair<std::size_t, std::size_t> off_rows(const Recording& r) {
  std::size_t from = r.size(), to = r.size();
  for (std::size_t i = r.size(); i-- > 0;)
    if (r.command->is_off(r.command->t[r.command_first + i])) {
      if (to == r.size()) to = i + 1;
      from = i;
    }
  return {from, std::max(from, to)};
}

bool has_loop(const std::vector<Recording>& recordings) {
  return !recordings.empty() && std::all_of(recordings.begin(), recordings.end(),
                                            [](const Recording& r) { return r.command != nullptr; });
}

bool is_sought(const Configuration& c, int number) {
  return c.controller && c.controller->numbers[number].estimate;
}

constexpr double kWorthAnotherLaw = 0.8;  ///< of the loop's error, at most, that another law leaves
constexpr std::size_t kLooked = 4;        ///< recordings that the numbers begin with
constexpr int kSteps = 15;                ///< of that fit

/// The model with numbers to begin with; nothing where it cannot be fitted.
std::optional<ReferenceModel> quick_fit(const Configuration& c, const std::vector<Recording>& train,
                                        const DriveController& controller) {
  const std::size_t every = std::max<std::size_t>(1, train.size() / kLooked);
  std::vector<Recording> few;
  for (std::size_t r = 0; r < train.size(); r += every) few.push_back(train[r]);
  std::vector<std::string> too_short;
  few = switched_on(few, too_short);
  if (few.empty()) return {};
  command_anew(controller, few);
  ReferenceModel model = c.reference_model();
  model.controller.reset();
  FitOptions options = c.fit;
  options.starts = 1, options.max_iterations = kSteps;
  options.compare_parts = options.search_halves = options.profile = false;
  const FitSummary found = fit(traces_of(few), model, options);
  if (found.status == FitStatus::kFailed) return {};
  return with_fitted_numbers(model, found);
}

double rms_of(const std::vector<HeldOutRun>& runs) {
  double square = 0.0;
  for (const HeldOutRun& run : runs) square += run.rmse * run.rmse;
  return std::sqrt(square / static_cast<double>(runs.size()));
}

}  // namespace

std::vector<Recording> switched_on(const std::vector<Recording>& recordings,
                                   std::vector<std::string>& too_short) {
  std::vector<Recording> on;
  for (const Recording& r : recordings) {
    if (r.command == nullptr || !(r.command->off_from < kInfinity)) {
      on.push_back(r);
      continue;
    }
    const auto [from, to] = off_rows(r);
    const bool before = from >= r.size() - to;
    const std::size_t first = before ? 0 : to, count = before ? from : r.size() - to;
    if (count >= kFewestSamples)
      on.push_back(part(r, first, count));
    else
      too_short.push_back(r.file);
  }
  return on;
}

std::vector<MotorTrace> traces_of(const std::vector<Recording>& recordings) {
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return traces;
}

std::optional<LoopFit> fitted_loop(const Configuration& c, const DiagnosisRecordings& recordings,
                                   const DiagnosisOptions& options) {
  const std::vector<Recording>& train = recordings.train.recordings;
  const auto known = recordings.sought ? std::optional(recordings.sought->at_start()) : recordings.controller;
  if (!known || !has_loop(train) || known->kind == ControllerKind::kVelocity) return {};
  const std::optional<ReferenceModel> model = quick_fit(c, train, *known);
  if (!model || model->structure.has_load) return {};
  LoopFitOptions asked;
  asked.progress = options.progress, asked.threads = options.threads;
  asked.gain_is_sought = is_sought(c, controller_place::kGain);
  asked.delay_is_sought = is_sought(c, controller_place::kDelay);
  asked.rate_is_sought = c.controller && c.controller->rate_settled;
  return unless_finishing([&] { return fit_in_loop(traces_of(train), *model, *known, asked); })
      .value_or(std::nullopt);
}

bool has_another_law(const LoopFit& loop) { return loop.left_by_law < kWorthAnotherLaw; }

void tell_closed_loop(const DiagnosisRecordings& recordings, const std::optional<LoopFit>& loop,
                      Diagnosis& d) {
  if (!loop || !d.controller) return;
  const std::vector<Recording>& held_out = recordings.held_out.recordings;
  const std::vector<MotorTrace> traces = traces_of(held_out.empty() ? recordings.train.recordings : held_out);
  const auto runs = [&](const ReferenceModel& model, const DriveController& controller) {
    std::vector<HeldOutRun> told;
    for (const MotorTrace& trace : traces) told.push_back(run_in_loop(trace, model, controller));
    return told;
  };
  const auto error = [](const std::vector<HeldOutRun>& of) {
    double sum = 0.0;
    for (const HeldOutRun& run : of) sum += std::isfinite(run.mae) ? run.mae : kInfinity;
    return sum;
  };
  const std::vector<HeldOutRun> before = runs(d.nominal, *d.controller);
  std::vector<HeldOutRun> after = runs(d.fitted, *d.controller),
                          in_loop = runs(loop->model, loop->controller);
  if (!(error(after) <= error(in_loop))) d.loop = loop, after = std::move(in_loop);
  d.closed_loop.emplace();
  for (std::size_t r = 0; r < after.size(); ++r) {
    after[r].nominal_fit = before[r].fit;
    d.closed_loop->recordings.push_back({after[r].file, before[r].rmse, after[r].rmse});
  }
  d.closed_loop->before = rms_of(before), d.closed_loop->after = rms_of(after);
  if (held_out.empty()) after.clear();
  d.held_out_runs = std::move(after);
}

}  // namespace gapscope::internal::run
