#include "report/report_view.h"

#include <algorithm>
#include <cmath>

#include "report/decimate.h"
#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kMostHalfPeriods = 14;  // that a column can show apart
constexpr std::size_t kShownHalfPeriods = 8;

/// Of a long line: the first, lowest, highest and last sample of each are kept. Twenty times the pixels of
/// any panel, so that a picture looks as all of them would.
constexpr std::size_t kLineColumns = 1 << 15;

std::size_t accepted_in(const RunResult& run, const std::string& file) {
  if (!run.model_free) return 0;
  const auto& events = run.model_free->events;
  return static_cast<std::size_t>(std::count_if(
      events.begin(), events.end(), [&](const GapEvent& e) { return e.accepted && e.file == file; }));
}

const Recording* shown_recording(const RunResult& run) {
  const Recording* best = nullptr;
  for (const Recording& r : run.recordings)
    if (best == nullptr || accepted_in(run, r.file) > accepted_in(run, best->file)) best = &r;
  return best != nullptr && best->size() > 1 ? best : nullptr;
}

template <class Trace>
const Trace* trace_of(const std::vector<Trace>& traces, const std::string& file) {
  for (const Trace& trace : traces)
    if (trace.file == file) return &trace;
  return nullptr;
}

void find_traces(ReportView& view) {
  const std::string& file = view.recording->file;
  if (view.run.model_free) {
    view.error = trace_of(view.run.model_free->traces, file);
    if (view.error && view.error->error.size() != view.recording->size()) view.error = nullptr;
    for (const GapEvent& e : view.run.model_free->events)
      if (e.file == file) view.events.push_back(e);
    std::stable_sort(view.events.begin(), view.events.end(),
                     [](const GapEvent& a, const GapEvent& b) { return a.t2 < b.t2; });
  }
  if (view.run.reference) view.fit = trace_of(view.run.reference->traces, file);
  if (view.fit && view.fit->x1.size() != view.recording->size()) view.fit = nullptr;
}

void find_state(ReportView& view) {
  if (!view.recording->x1.empty() && !view.recording->x2.empty()) {
    view.source = StateSource::kRecorded;
    view.state = difference_of(view.recording->x1, view.recording->x2);
  } else if (view.fit && !view.fit->x2.empty()) {
    view.source = StateSource::kFitted;
    view.state = difference_of(view.fit->x1, view.fit->x2);
  }
  if (view.state.empty()) return;
  const double middle = robust_middle(view.state);
  // Two encoders have no common zero; a model has.
  if (std::abs(middle) <= 0.1 * peak_to_peak(view.state)) return;
  view.state_offset = middle;
  for (double& v : view.state) v -= middle;
}

void find_window(ReportView& view) {
  const std::vector<std::size_t> crossings = middle_crossings(view.recording->position());
  std::vector<double> halves;
  for (std::size_t i = 1; i < crossings.size(); ++i)
    halves.push_back(view.recording->dt *
                     static_cast<double>(crossings[i] - crossings[i - 1]));  // mean steps
  view.half_period = median(halves);
  view.window = {view.time.front(), view.time.back()};
  if (halves.size() <= kMostHalfPeriods) return;
  const std::size_t first = (crossings.size() - 1 - kShownHalfPeriods) / 2;
  view.window = {view.time[crossings[first]], view.time[crossings[first + kShownHalfPeriods]]};
  view.whole = false;
}

}  // namespace

ReportView::ReportView(const RunResult& result)
    : run(result), recording(shown_recording(result)), length_unit(position_unit(result)) {
  if (recording == nullptr) return;
  time.reserve(recording->size());
  for (std::size_t i = 0; i < recording->size(); ++i) time.push_back(recording->time(i));
  find_traces(*this);
  find_state(*this);
  find_window(*this);
}

std::size_t ReportView::index(double t) const {
  if (!recording->even()) {
    const auto after = std::lower_bound(time.begin(), time.end() - 1, t);
    const bool before = after != time.begin() && t - *(after - 1) < *after - t;
    return static_cast<std::size_t>(after - time.begin()) - (before ? 1 : 0);
  }
  const double i = std::round((t - recording->start) / recording->dt);
  return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(recording->size() - 1)));
}

std::vector<GapEvent> ReportView::accepted() const {
  std::vector<GapEvent> kept;
  for (const GapEvent& e : events)
    if (e.accepted && std::isfinite(e.gap)) kept.push_back(e);
  return kept;
}

double ReportView::true_gap() const {
  if (std::isfinite(run.simulated_gap)) return run.simulated_gap;
  return run.comparison ? run.comparison->map_width : kNaN;
}

std::string ReportView::true_gap_name() const {
  return std::isfinite(run.simulated_gap) ? "simulated gap" : "read off $x_1$–$x_2$";
}

std::span<const double> ReportView::part(const std::vector<double>& values, const Interval& interval) const {
  const std::size_t first = index(interval.low), end = std::min(index(interval.high) + 1, values.size());
  return std::span(values).subspan(std::min(first, end), end - std::min(first, end));
}

Series ReportView::over_time(const std::string& label, const LineStyle& style,
                             const std::vector<double>& values, const Interval& interval) const {
  Series s;
  s.label = label;
  s.style = style;
  const std::span<const double> y = part(values, interval), x = part(time, interval).first(y.size());
  const bool interrupted = std::any_of(y.begin(), y.end(), [](double v) { return std::isnan(v); });
  if (interrupted || y.size() <= 4 * kLineColumns) {
    s.x.assign(x.begin(), x.end()), s.y.assign(y.begin(), y.end());
    return s;
  }
  for (const std::size_t i : decimate_columns(x, y, kLineColumns)) s.x.push_back(x[i]), s.y.push_back(y[i]);
  return s;
}

Axis ReportView::time_axis(const Interval& interval) const {
  Axis axis;
  axis.name = "time $t$";
  axis.unit = "s";
  axis.range = interval;
  return axis;
}

std::string ReportView::error_title(const std::string& title) const {
  if (!run.model_free) return title;
  const double bound =
      std::isfinite(run.model_free->bound_t1) ? run.model_free->bound_t1 : run.model_free->bound;
  if (!std::isfinite(bound)) return title;
  return title + ", $L$ = " + rounded(bound) + " " + run.coordinates.shown_unit("rad/s^2");
}

std::string ReportView::drawn_bound() const {
  if (!run.model_free || !error) return "";
  const GapEstimate& g = *run.model_free;
  const double bound = std::isfinite(g.bound_t1) ? g.bound_t1 : g.bound;
  if (!std::isfinite(bound)) return "";
  const bool passages = std::ranges::any_of(g.events, &GapEvent::accepted);
  return "; L = " + rounded(bound) + " " + run.coordinates.shown_unit("rad/s^2") +
         (g.by_one_bound() ? " was given"
          : passages       ? " is the smallest bound of the bank that slides just before t1"
                           : " is the smallest bound of the bank that slides over the recording");
}

std::string ReportView::state_name() const {
  return source == StateSource::kFitted ? "$x_1 − x_2$, fitted" : "$x_1 − x_2$";
}

std::string ReportView::state_title() const {
  const bool doubtful = source == StateSource::kFitted && run.reference && run.reference->rejected();
  return doubtful ? "Backlash state of the rejected model" : "Backlash state";
}

}  // namespace gapscope::internal::report
