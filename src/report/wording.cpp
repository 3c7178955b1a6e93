#include "report/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "report/ticks.h"

namespace gapscope::internal::report {
namespace {

/// Decimals that show `digits` significant digits of the given size.
int decimals_for(double size, int digits) {
  if (!(size > 0.0)) return 0;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(size))), 0, 12);
}

bool known(const Interval& interval) { return std::isfinite(interval.low) && std::isfinite(interval.high); }

std::string unit_after(const std::string& unit) { return unit.empty() || unit == "-" ? "" : " " + unit; }

/// Small and large numbers of units that take no prefix; "0" with fewer than one digit.
std::string scientific(double value, int digits) {
  if (value == 0.0 || digits < 1) return "0";
  return typeset(fmt::format("{:.{}e}", value, digits - 1));
}

std::string what_was_read(const GapEstimate& g) {
  if (g.quantity == GapQuantity::kFirstGap) return "first of several gaps";
  return g.quantity == GapQuantity::kPlayAtZeroTorque ? "play at zero torque" : "backlash gap";
}

/// "Without a model: play at zero torque 34.1 to 37.2 mrad, ...": measured, and then what it means.
std::string lost_motion_sentence(const LostMotion& m, const std::string& unit) {
  const Interval range = m.range();
  const bool one = quantity(range.low, unit) == quantity(range.high, unit);
  std::string text = "play at zero torque ";
  text += m.levels.size() == 1 || one
              ? with_interval(m.value, m.ci95, unit)
              : quantity(range.low, unit) + " to " + quantity(range.high, unit) + ", by torque level";
  if (std::isfinite(m.gap_limit)) text += ", the gap is at most " + quantity(m.gap_limit, unit);
  return text + "; " + m.meaning.text() + ".";
}

std::string model_free_sentence(const RunResult& run) {
  const GapEstimate& g = *run.model_free;
  const std::string unit = position_unit(run);
  switch (g.verdict) {
    case GapVerdict::kBacklash:
      return "Without a model: " + what_was_read(g) + " " + with_interval(g.gap, g.ci95, unit) + ".";
    case GapVerdict::kNone:
      return "Without a model: no backlash above " + quantity(g.none_above(), unit) + ".";
    default:
      if (g.lost_motion.read())
        return "Without a model: " + lost_motion_sentence(g.lost_motion, unit) + " Verdict: inconclusive.";
      return "Without a model: inconclusive (" + g.reason.text() + ").";
  }
}

std::string reference_sentence(const RunResult& run) {
  const FitSummary& fit = *run.reference;
  const FittedParameter* gap = parameter(run, "gap");
  const std::string state = fit.converged() ? "" : " (the fit did not converge)";
  if (fit.status == FitStatus::kFailed || fit.status == FitStatus::kNotRun)
    return "The fitted model has no result: " + fit.message.text();
  if (gap == nullptr) return "The fitted model was given no gap" + state + ".";
  if (fit.closes_gap())
    return "The fitted model does as well with its gap closed, which does not say that the drive has none" +
           state + ".";
  if (fit.rejected())
    return "The fitted model is rejected, its gap (" + quantity(gap->value, position_unit(run)) +
           ") is not to be believed: " + fit.why.text();
  const std::string value = with_interval(gap->value, fit.shown_interval(*gap), position_unit(run));
  if (!gap->estimated) return "The gap was given to the fitted model: " + value + state + ".";
  if (!gap->identifiable) return "The fitted model could not determine the gap (" + value + ")" + state + ".";
  return "Fitted model: " + value + state + ".";
}

std::string error_sentence(const RunResult& run, const std::string& name, double value,
                           const Interval& ci95) {
  const bool simulated = std::isfinite(run.simulated_gap);
  const double truth = simulated ? run.simulated_gap : run.comparison ? run.comparison->map_width : kNaN;
  if (!std::isfinite(value) || !std::isfinite(truth)) return "";
  const bool holds = ci95.low <= truth && truth <= ci95.high;
  const char* interval = !known(ci95) ? "" : holds ? "; its interval holds it" : "; its interval misses it";
  return fmt::format("The {} is {} % {} the {}{}.", name, plain_number(100.0 * std::abs(value / truth - 1.0)),
                     value < truth ? "below" : "above",
                     simulated ? "simulated gap" : "gap read off the x1–x2 map", interval);
}

std::string comparison_sentence(const RunResult& run) {
  const Comparison& c = *run.comparison;
  if (!c.agree) return "";
  return fmt::format(" They {}: the difference is {}, its standard deviation {}.",
                     *c.agree ? "agree" : "disagree",
                     quantity_beside(c.difference, run.model_free->gap, position_unit(run)),
                     quantity_beside(c.joint_std, run.model_free->gap, position_unit(run)));
}

}  // namespace

std::string typeset(const std::string& text) {
  static constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool follows_word = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0);
    const bool sign = i + 1 < text.size() && (text[i + 1] == '-' || text[i + 1] == '+') && digit(i + 2);
    if (text[i] == 'e' && i > 0 && digit(i - 1) && sign) {
      out += "·10";
      if (text[++i] == '-') out += "⁻";
      while (text[i + 1] == '0' && digit(i + 2)) ++i;
      while (digit(i + 1)) out += kRaised[text[++i] - '0'];
    } else {
      const bool zero = std::strtod(text.c_str() + i + 1, nullptr) == 0.0;
      if (text[i] != '-' || !digit(i + 1) || follows_word)
        out += text[i];
      else if (!zero)
        out += "−";
    }
  }
  return out;
}

std::string rounded(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  const bool plain = std::abs(value) >= 1.0 && std::abs(value) < 1e5;
  const double whole = std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
  if (plain && whole > 1.0) return tick_label(std::round(value / whole) * whole, 0);
  return typeset(fmt::format("{:.{}g}", value, digits));
}

std::string quantity(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "unknown";
  if (value == 0.0) return "0" + unit_after(unit);
  const AxisScale scale = axis_scale(unit, std::abs(value));
  const double shown = value / scale.factor;
  if (std::abs(shown) < 1e-2 || std::abs(shown) >= 1e5) return scientific(shown, 3) + unit_after(scale.unit);
  return tick_label(shown, decimals_for(std::abs(shown), 3)) + unit_after(scale.unit);
}

std::string quantity_beside(double value, double larger, const std::string& unit) {
  if (!std::isfinite(value)) return "unknown";
  if (value == 0.0 || !std::isfinite(larger) || std::abs(larger) < std::abs(value))
    return quantity(value, unit);
  const AxisScale scale = axis_scale(unit, std::abs(larger));
  const double shown = value / scale.factor;
  if (std::abs(shown) < 1e-4) return scientific(shown, 3) + unit_after(scale.unit);
  return tick_label(shown, decimals_for(std::abs(shown), 3)) + unit_after(scale.unit);
}

std::string with_interval(double value, const Interval& ci95, const std::string& unit) {
  if (!std::isfinite(value) || !known(ci95)) return quantity(value, unit);
  const AxisScale scale = axis_scale(unit, std::max(std::abs(value), std::abs(ci95.high)));
  const int decimals = decimals_for((ci95.high - ci95.low) / 2 / scale.factor, 2);
  const auto text = [&](double v) { return tick_label(v / scale.factor, decimals); };
  return text(value) + unit_after(scale.unit) + " (95 %: " + text(ci95.low) + " to " + text(ci95.high) + ")";
}

std::string beside_interval(double value, const Interval& ci95, const std::string& unit) {
  if (!std::isfinite(value) || !known(ci95)) return quantity(value, unit);
  const AxisScale scale = axis_scale(unit, std::max(std::abs(value), std::abs(ci95.high)));
  return tick_label(value / scale.factor, decimals_for((ci95.high - ci95.low) / 2 / scale.factor, 2)) +
         unit_after(scale.unit);
}

std::string fit_text(double percent, int digits) {
  return percent >= 99.995 && percent < 100.0 ? "> 99.99 %" : rounded(percent, digits) + " %";
}

std::string interval_text(const Interval& ci95, const std::string& unit) {
  if (!known(ci95)) return "";
  const AxisScale scale = axis_scale(unit, std::max(std::abs(ci95.low), std::abs(ci95.high)));
  const int decimals = decimals_for((ci95.high - ci95.low) / 2 / scale.factor, 2);
  return tick_label(ci95.low / scale.factor, decimals) + " to " +
         tick_label(ci95.high / scale.factor, decimals) + unit_after(scale.unit);
}

std::string plus_minus(double value, const Interval& ci95, const std::string& unit) {
  if (!std::isfinite(value) || !known(ci95)) return quantity(value, unit);
  const double half = (ci95.high - ci95.low) / 2;
  if (std::abs(ci95.low + half - value) > 0.1 * half) return with_interval(value, ci95, unit);
  const AxisScale scale = axis_scale(unit, std::max(std::abs(value), half));
  const auto place = [](double v) { return v == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(v))); };
  if (std::max(std::abs(value), half) / scale.factor < 1e-2)  // value down to the last digit of its half
    return scientific(value, half > 0.0 ? place(std::abs(value)) - place(half) + 2 : 4) + " ± " +
           scientific(half, 2) + unit_after(unit);
  const int decimals = decimals_for(half / scale.factor, 2);
  return tick_label(value / scale.factor, decimals) + " ± " + tick_label(half / scale.factor, decimals) +
         unit_after(scale.unit);
}

std::string plain_number(double value) {
  if (!std::isfinite(value)) return "unknown";
  if (std::abs(value) >= 1e4) return scientific(value, 2);
  return tick_label(value, decimals_for(std::abs(value), 2));
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string position_unit(const RunResult& run) { return run.coordinates.position_unit(); }
std::string input_unit(const RunResult& run) {
  return run.input && !run.input->unit.empty() ? run.coordinates.shown_unit(run.input->unit) : "units of $u$";
}
std::string torque_note(const std::optional<InputFacts>& input) {
  return input && input->constant_guessed ? "$K_m$ guessed" : "";
}
std::string torque_unit(const RunResult& run) { return run.coordinates.shown_unit("N m"); }

const FittedParameter* parameter(const RunResult& run, const std::string& key) {
  if (!run.reference) return nullptr;
  for (const FittedParameter& p : run.reference->parameters)
    if (p.key == key) return &p;
  return nullptr;
}

std::string accuracy(const RunResult& run) {
  std::string text;
  if (run.model_free)
    text += error_sentence(run, "gap read without a model", run.model_free->gap, run.model_free->ci95);
  if (const FittedParameter* gap = parameter(run, "gap"); gap != nullptr && gap->estimated)
    text += (text.empty() ? "" : " ") +
            error_sentence(run, "fitted gap", gap->value, run.reference->shown_interval(*gap));
  return text;
}

std::string without_estimate(const RunResult& run) {
  return std::isfinite(run.simulated_gap) ? "There is no estimate beside the gap of the simulated plant."
                                          : "The true gap is not known here.";
}

std::string fit_quality(const RunResult& run) {
  if (!run.reference || !std::isfinite(run.reference->rmse)) return "";
  const FitSummary& fit = *run.reference;
  std::string text = "Free run of the fitted model: " + quantity(fit.rmse, position_unit(run)) + " rms";
  if (std::isfinite(fit.fit_percent)) text += ", a fit of " + fit_text(fit.fit_percent);
  if (std::isfinite(fit.floor)) text += "; the encoder floor is " + quantity(fit.floor, position_unit(run));
  return text + ".";
}

std::string headline(const RunResult& run) { return run.answer ? run.answer->sentence : estimates_text(run); }

std::string estimates_text(const RunResult& run) {
  std::string text;
  if (run.model_free) text += model_free_sentence(run);
  if (run.reference) text += (text.empty() ? "" : " ") + reference_sentence(run);
  if (run.comparison) text += comparison_sentence(run);
  return text.empty() ? "Nothing was estimated." : text;
}

}  // namespace gapscope::internal::report
