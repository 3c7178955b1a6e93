#include "report/error_scale.h"

#include <fmt/format.h>

#include "report/signals.h"

namespace gapscope::internal::report {

double error_factor(const ReportView& view, const Interval& interval, double target) {
  const double peak = largest_magnitude(view.part(view.error->error, interval));
  const double own = view.run.model_free->scale;
  const bool fits = own * peak > 0.2 * target && own * peak < 1.3 * target;
  return fits ? own : round_factor(peak, target);
}

Series scaled_error(const ReportView& view, const Interval& interval, double target) {
  const double factor = error_factor(view, interval, target);
  const std::string label = factor == 1.0 ? "$e_x$" : fmt::format("${:g} × e_x$", factor);
  LineStyle style = model_free_style();
  style.width = 3.5;  // it may chatter
  Series series = view.over_time(label, style, view.error->error, interval);
  series.y = times(series.y, factor);
  return series;
}

}  // namespace gapscope::internal::report
