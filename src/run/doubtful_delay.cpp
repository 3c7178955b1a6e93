#include "run/doubtful_delay.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/interrupt.h"
#include "base/text.h"
#include "inspection/first_row.h"

namespace gapscope::internal::run {
namespace {

constexpr double kLater = 0.1;  ///< s: longer than any delay of a drive

constexpr std::string_view kDelays[] = {"input_delay", "actuator_lag", "measurement_lag"};

const ModelEffect* delay_in(const ReferenceModel& model) {
  const auto at = std::ranges::find_if(
      model.effects, [](const ModelEffect& e) { return std::ranges::count(kDelays, e.entry->name) > 0; });
  return at == model.effects.end() ? nullptr : &*at;
}

/// The delay of the model, refitted to what is left; nothing: too little is.
std::optional<FittedParameter> delay_without(const std::vector<MotorTrace>& left, const ReferenceModel& model,
                                             FitOptions options, const ModelEffect& delay) {
  options.starts = 1;  // it stands where the diagnosis has come to
  const FitSummary found = fit(left, model, options);
  const FittedParameter* p =
      found.find(std::string(delay.entry->name) + "." + delay.entry->parameters.front().key);
  return p == nullptr ? std::nullopt : std::optional(*p);
}

}  // namespace

std::string doubtful_delay(const Configuration& c, std::vector<MotorTrace> fitted, const Diagnosis& d) {
  const ModelEffect* const delay = delay_in(d.fitted);
  if (delay == nullptr || finish_requested()) return "";
  std::string beginning;
  for (MotorTrace& trace : fitted) {
    const std::optional<double> stands = begins_under_input(trace);
    std::size_t later = 0;
    while (later < trace.size() && trace.elapsed(later) < kLater) ++later;
    if (!stands || 2 * later > trace.size()) continue;
    if (beginning.empty())
      beginning = fmt::format(
          "{} begins with its input on while the motor is still at rest ({:.3g} units of u, {:.3g} ms): what was "
          "sent before the first row is not in it, and no model follows that. Leave out the beginning and "
          "diagnose again, `recording: {{window: [{:.4g}, {:.4g}]}}`: what helps and what is left can change, and the",
          trace.file, trace.u.front(), 1e3 * *stands, trace.start + kLater, trace.time(trace.size() - 1));
    trace = part(trace, later, trace.size() - later);
  }
  if (beginning.empty()) return "";
  const std::optional<FittedParameter> without = delay_without(fitted, d.fitted, c.fit, *delay);
  const double with = delay->parameters.front().value;
  if (!without || (without->ci95.low <= with && with <= without->ci95.high)) return "";
  return fmt::format("{} {} then comes out as {:.4g} ms, not {:.4g} ms.", beginning,
                     readable(delay->entry->name), 1e3 * without->value, 1e3 * with);
}

}  // namespace gapscope::internal::run
