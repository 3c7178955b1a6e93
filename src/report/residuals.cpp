#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

Panel over_time(const ReportView& view, const std::vector<double>& residual, const Interval& interval,
                bool shaded) {
  Panel panel;
  panel.title = view.whole || shaded ? (view.fit->x2.empty() ? "Residual" : "Residual by mode")
                                     : "Residual of the whole recording";
  panel.x = view.time_axis(interval);
  panel.y = {view.position_name() + " − fitted " + view.position_name(), view.length_unit, {}, {}, {}};
  panel.height = 400.0;
  LineStyle style = measured_style();
  style.width = 2.5;
  panel.series.push_back(view.over_time("", style, residual, interval));
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

std::size_t lags_of(const ReportView& view, std::size_t samples) {
  const double period = std::isfinite(view.half_period) ? 2.0 * view.half_period : 1.0;
  const auto wanted = static_cast<std::size_t>(1.1 * period / view.recording->dt);
  return std::clamp<std::size_t>(wanted, 20,
                                 std::max<std::size_t>(20, std::min<std::size_t>(samples / 4, 4000)));
}

Panel autocorrelation_panel(const ReportView& view, const std::vector<double>& r, std::size_t samples) {
  Panel panel;
  panel.title = "Autocorrelation of the residual";
  const double dt = view.recording->dt;
  panel.x = {"lag", "s", {0.0, dt * static_cast<double>(r.size() - 1)}, {}, {}};
  panel.height = 360.0;
  const double band = 1.96 / std::sqrt(static_cast<double>(samples));
  // r_0 is always 1; a scale that holds it would flatten what is left of a nearly white residual.
  const double largest = largest_magnitude(std::span(r).subspan(1));
  const double limit = largest > 0.3 ? 1.05 : std::max(3.0 * band, 1.3 * largest);
  panel.y = {"autocorrelation", "", {-limit, limit}, {}, {}};
  panel.y_bands.push_back({{-band, band}, kBandShade, "95 % of white noise"});
  Series s;
  s.style = measured_style();
  for (std::size_t k = 1; k < r.size(); ++k) {
    s.x.push_back(dt * static_cast<double>(k));
    s.y.push_back(r[k]);
  }
  panel.series.push_back(s);
  return panel;
}

/// The mode with the largest rms.
const ModeError* worst_mode(const FitSummary& fit) {
  const ModeError* worst = nullptr;
  for (const ModeError& m : fit.mode_errors)
    if (m.samples > 0 && (worst == nullptr || m.rmse > worst->rmse)) worst = &m;
  return worst;
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
  const double band = 1.96 / std::sqrt(static_cast<double>(residual.size()));
  const auto beyond = std::count_if(r.begin() + 1, r.end(), [&](double v) { return std::abs(v) > band; });
  const double share = static_cast<double>(beyond) / static_cast<double>(r.size() - 1);
  text += fmt::format("; {} % of the lags lie outside the white-noise band: the residual {}",
                      std::lround(100 * share),
                      share > 0.1 ? "is not white, the model leaves structure" : "looks white");
  if (std::isfinite(fit.input_correlation.outside))
    text += fmt::format("; with the input it is correlated at {} % of the lags, chance leaves 5 %",
                        std::lround(100 * fit.input_correlation.outside));
  return text + ".";
}

}  // namespace

FigureData residuals(const ReportView& view) {
  FigureData figure;
  figure.file = "residuals.png";
  figure.title = "Recorded minus fitted displacement";
  if (!view.recording || !view.fit)
    return missing_figure(figure.file, figure.title,
                          view.run.reference ? "the fit left no free run of the recording"
                                             : "the model-based reference was not asked for");
  const std::vector<double> residual = difference_of(view.recording->position(), view.fit->position());
  const std::vector<double> r = autocorrelation(residual, lags_of(view, residual.size()));
  const Interval all{view.time.front(), view.time.back()};
  if (!view.whole) figure.panels.push_back(over_time(view, residual, all, false));
  figure.panels.push_back(over_time(view, residual, view.window, true));
  figure.panels.push_back(autocorrelation_panel(view, r, residual.size()));
  figure.reading = reading(view, residual, r);
  const auto& second = view.run.second_encoder;
  if (second && std::isfinite(second->rmse) && view.recording->x2.size() == view.fit->x2.size()) {
    figure.panels.push_back(load_panel(view));
    figure.reading += load_reading(*second, view.length_unit);
  }
  return figure;
}

}  // namespace gapscope::internal::report
