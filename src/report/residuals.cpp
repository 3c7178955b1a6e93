#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "report/figures.h"
#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// Stretches of the gap mode of the fitted model within an interval.
std::vector<Band> gap_bands(const ReportView& view, const Interval& interval) {
  std::vector<Band> bands;
  if (view.fit->x2.empty()) return bands;  // no load behind a gap, no modes
  const std::vector<Mode>& mode = view.fit->mode;
  const std::size_t last = view.index(interval.high);
  for (std::size_t i = view.index(interval.low); i <= last && i < mode.size(); ++i) {
    if (mode[i] != Mode::kGap) continue;
    const std::size_t begin = i;
    while (i < last && i + 1 < mode.size() && mode[i + 1] == Mode::kGap) ++i;
    bands.push_back({{view.time[begin], view.time[i] + view.recording->dt}, kGapShade, ""});
  }
  if (!bands.empty()) bands.front().label = "fitted gap mode";
  return bands;
}

/// Where a line through every sample would be a black block: mean and standard deviation of stretches, over
/// the samples in grey.
void add_stretches(const ReportView& view, const std::vector<double>& residual, const Interval& interval,
                   Panel& panel) {
  const std::size_t first = view.index(interval.low), end = view.index(interval.high) + 1;
  const Stretches parts = stretches_of(std::span(residual).subspan(first, end - first));
  if (!parts.are_a_block()) return;
  Series middle, above, below;
  for (std::size_t i = 0; i < parts.means.size(); ++i) {
    const std::size_t at = first + i * parts.each;
    const double t = 0.5 * (view.time[at] + view.time[at + parts.each - 1]);
    for (Series* s : {&middle, &above, &below}) s->x.push_back(t);
    middle.y.push_back(parts.means[i]);
    above.y.push_back(parts.means[i] + parts.spreads[i]),
        below.y.push_back(parts.means[i] - parts.spreads[i]);
  }
  middle.label =
      fmt::format("mean of {}", quantity(static_cast<double>(parts.each) * view.recording->dt, "s"));
  middle.style = {kBlack, 4.0, {}};
  above.label = "± standard deviation";
  above.style = below.style = {kVermillion, 3.0, {}};
  panel.series.front().label = "sample by sample";
  panel.series.front().style.colour = kFaint;
  for (Series* s : {&middle, &above, &below}) panel.series.push_back(std::move(*s));
}

Panel over_time(const ReportView& view, const std::vector<double>& residual, const Interval& interval,
                bool shaded) {
  Panel panel{view.whole || shaded ? (view.fit->x2.empty() ? "Residual" : "Residual by mode")
                                   : "Residual of the whole recording",
              view.time_axis(interval),
              {view.position_name() + " − fitted " + view.position_name(), view.length_unit},
              400.0};
  LineStyle style = measured_style();
  style.width = 2.5;
  panel.series.push_back(view.over_time("", style, residual, interval));
  add_stretches(view, residual, interval, panel);
  if (shaded) panel.x_bands = gap_bands(view, interval);
  return panel;
}

/// Of the load, whose encoder the fit did not read; the two have no common zero.
Panel load_panel(const ReportView& view) {
  std::vector<double> error = difference_of(view.recording->x2, view.fit->x2);
  const double offset = mean(error);
  for (double& e : error) e -= offset;
  Panel panel = over_time(view, error, {view.time.front(), view.time.back()}, false);
  panel.title = "Validation by the encoder on the load, which was not fitted";
  panel.y.name = "$x_2$ − fitted $x_2$";
  return panel;
}

std::string load_reading(const SecondEncoder& second, const std::string& unit) {
  return fmt::format(" The load's encoder, which was not fitted, is missed by {} rms, {} times its floor.",
                     quantity(second.rmse, unit), plain_number(second.rmse / second.floor));
}

/// Recorded over simulated: the first picture that one looks for.
Panel overlay(const ReportView& view, const Interval& interval) {
  Panel panel;
  const double percent = view.run.reference->fit_percent;
  panel.title = "Recorded and simulated";
  if (std::isfinite(percent) && view.run.recordings.size() == 1)
    panel.title += fmt::format(" (fit {} %)", rounded(percent, 4));
  panel.x = view.time_axis(interval);
  panel.y = {"displacement " + view.position_name(), view.length_unit};
  panel.height = 400.0;
  panel.series.push_back(view.over_time("recorded", measured_style(), view.recording->position(), interval));
  panel.series.push_back(
      view.over_time("free run of the fitted model", reference_style(), view.fit->position(), interval));
  return panel;
}

/// Two periods of the motion, in steps that a picture tells apart.
struct Lags {
  std::size_t last = 0, step = 1;
};

Lags lags_of(const ReportView& view, std::size_t samples) {
  constexpr std::size_t kShown = 600;
  const double period = std::isfinite(view.half_period) ? 2.0 * view.half_period : 1.0;
  const auto wanted = static_cast<std::size_t>(1.1 * period / view.recording->dt);
  const std::size_t last = std::clamp<std::size_t>(
      wanted, 20, std::max<std::size_t>(20, std::min<std::size_t>(samples / 4, 4000)));
  return {last, last / kShown + 1};
}

/// @param band  that holds 95 % of the lags where nothing is left
Panel correlation_panel(const ReportView& view, const std::string& title, const std::vector<double>& r,
                        std::size_t step, bool with_first, double band, const std::string& band_name) {
  Panel panel;
  panel.title = title;
  const double dt = view.recording->dt * static_cast<double>(step);
  panel.x = {"lag", "s", {0.0, dt * static_cast<double>(r.size() - 1)}};
  panel.height = 360.0;
  // r_0 is always 1; a scale that holds it would flatten what is left of a nearly white residual.
  const std::size_t first = with_first ? 0 : 1;
  const double largest = largest_magnitude(std::span(r).subspan(first));
  const double limit = std::min(1.05, std::max(3.0 * band, 1.3 * largest));
  panel.y = {"correlation", "", {-limit, limit}};
  panel.y_bands.push_back({{-band, band}, kBandShade, band_name});
  Series s;
  s.style = measured_style();
  for (std::size_t k = first; k < r.size(); ++k) {
    s.x.push_back(dt * static_cast<double>(k));
    s.y.push_back(r[k]);
  }
  panel.series.push_back(s);
  return panel;
}

/// By how much Bartlett's formula widens the band of two signals that are not white themselves:
/// √(1 + 2 Σ_k ρ_e(k) ρ_u(k)), over the lags that are drawn.
double widening(const ReportView& view, const std::vector<double>& own, const Lags& lags) {
  const std::vector<double> of_input = autocorrelation(view.recording->u, lags.last, lags.step);
  double sum = 1.0;
  for (std::size_t k = 1; k < std::min(own.size(), of_input.size()); ++k)
    sum += 2.0 * static_cast<double>(lags.step) * own[k] * of_input[k];
  return std::sqrt(std::isfinite(sum) ? std::max(1.0, sum) : 1.0);
}

/// The mode with the largest rms.
const ModeError* worst_mode(const FitSummary& fit) {
  const ModeError* worst = nullptr;
  for (const ModeError& m : fit.mode_errors)
    if (m.samples > 0 && (worst == nullptr || m.rmse > worst->rmse)) worst = &m;
  return worst;
}

/// What should be noise: the error of predictions, since a free run drifts whatever it lacks.
bool predicts(const ReportView& view) { return view.fit->predicted.size() == view.recording->size(); }
const char* what_is_tested(const ReportView& view) {
  return predicts(view) ? "its prediction error" : "the residual";
}

std::string reading(const ReportView& view, const std::vector<double>& residual,
                    const std::vector<double>& r) {
  const FitSummary& fit = *view.run.reference;
  const double size = rms(residual);
  std::string text =
      fmt::format("The free run of the fitted model misses {} by ", view.reads_load() ? "x2" : "x1") +
      quantity(size, view.length_unit) + " rms";
  if (std::isfinite(fit.floor) && fit.floor > 0.0)
    text += fmt::format(", {} times the encoder floor", plain_number(size / fit.floor));
  if (std::isfinite(fit.innovation_rmse))
    text += fmt::format("; run as an observer it predicts the next sample to {}",
                        quantity(fit.innovation_rmse, view.length_unit));
  if (const ModeError* worst = worst_mode(fit))
    text += fmt::format("; it is largest in mode {} ({} rms)", to_string(worst->mode),
                        quantity(worst->rmse, view.length_unit));
  const double band = kNormal95 / std::sqrt(static_cast<double>(residual.size()));
  const auto beyond = std::count_if(r.begin() + 1, r.end(), [&](double v) { return std::abs(v) > band; });
  const double share = static_cast<double>(beyond) / static_cast<double>(r.size() - 1);
  text += fmt::format("; {} % of the lags of {} lie outside the white-noise band: it {}",
                      std::lround(100 * share), what_is_tested(view),
                      share > 0.1 ? "is not white, the model leaves structure" : "looks white");
  if (std::isfinite(fit.input_correlation.outside))
    text += fmt::format("; with the input it is correlated at {} % of the lags, chance leaves 5 %",
                        std::lround(100 * fit.input_correlation.outside));
  return text + ".";
}

}  // namespace

FigureData residuals(const ReportView& view) {
  FigureData figure{"residuals.png", "Recorded and simulated displacement"};
  if (!view.recording || !view.fit)
    return missing_figure(
        figure, view.run.reference ? "the fit left no free run of the recording" : "no model was fitted");
  const std::vector<double> residual = difference_of(view.recording->position(), view.fit->position());
  const std::vector<double> tested =
      predicts(view) ? difference_of(view.recording->position(), view.fit->predicted) : residual;
  const Lags lags = lags_of(view, residual.size());
  const std::vector<double> r = autocorrelation(tested, lags.last, lags.step);
  const std::vector<double> with_input = correlation(view.recording->u, tested, lags.last, lags.step);
  const double band = kNormal95 / std::sqrt(static_cast<double>(residual.size()));
  const Interval all{view.time.front(), view.time.back()};
  figure.panels.push_back(overlay(view, all));
  if (!view.whole) figure.panels.push_back(over_time(view, residual, all, false));
  figure.panels.push_back(over_time(view, residual, view.window, true));
  const std::string name = predicts(view) ? "prediction error" : "residual";
  figure.panels.push_back(correlation_panel(view, "Autocorrelation of the " + name, r, lags.step, false, band,
                                            "95 % of white noise"));
  figure.panels.push_back(correlation_panel(view, "Its correlation with the earlier input", with_input,
                                            lags.step, true, band * widening(view, r, lags),
                                            "95 % if the input is not in it"));
  figure.reading = reading(view, residual, r);
  const auto& second = view.run.second_encoder;
  if (second && std::isfinite(second->rmse) && view.recording->x2.size() == view.fit->x2.size()) {
    figure.panels.push_back(load_panel(view));
    figure.reading += load_reading(*second, view.length_unit);
  }
  return figure;
}

}  // namespace gapscope::internal::report
