#include "report/detectable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/percents.h"
#include "base/text.h"
#include "report/rich_text.h"
#include "report/ticks.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// What most users ask for, in their order; of these as many are told in words.
constexpr const char* kAskedMost[] = {
    "motor_coulomb_friction", "cogging_torque",         "input_delay",   "backlash",     "load_unbalance",
    "quadratic_drag",         "load_inertia_variation", "torque_ripple", "viscous_drift"};
constexpr std::size_t kTold = 5;

std::string number_text(const DiagnosisResult& r, const NamedValue& v) {
  if (v.unit == "-") return v.key.ends_with("ratio") ? rounded(100.0 * v.value) + " %" : rounded(v.value);
  if (v.unit == "unit of u")
    return with_input_unit(rounded(v.value) + " units of u", r.input.value_or(InputFacts{}));
  if (v.unit == "s" || v.unit == "rad" || v.unit == "N m")
    return quantity(v.value, r.coordinates.shown_unit(v.unit));
  return rounded(v.value) + " " + r.coordinates.shown_unit(v.unit);
}

/// A knee, or a contact that is softer than the nominal one: the lower, the more of the effect there is.
bool falls(const DetectableEffect& e) {
  return e.smallest.key == "knee" || e.effect == "shaft_compliance" || e.effect == "impact_damping";
}

/// "24 per turn", "every 2.50 mm", "length 0.8 mm"
std::string shape_text(const DiagnosisResult& r, const NamedValue& v) {
  if (v.key == "periods_per_turn")
    return r.coordinates.rotational() ? rounded(v.value) + " per turn"
                                      : "every " + quantity(2.0 * kPi / v.value, "m");
  const std::size_t unit = v.unit == "-" ? std::string::npos : v.key.rfind('_');
  std::string name = v.key;
  for (const char* end : {"_rad_s", "_nms", "_nm", "_rad", "_s"})
    if (unit != std::string::npos && name.ends_with(end)) {
      name.resize(name.size() - std::string(end).size());
      break;
    }
  return readable(name) + " " + number_text(r, v);
}

std::string shapes_text(const DiagnosisResult& r, const DetectableEffect& e) {
  std::vector<std::string> parts;
  for (const NamedValue& v : e.at) parts.push_back(shape_text(r, v));
  return fmt::format("{}", fmt::join(parts, ", "));
}

double share_of_input(const DiagnosisResult& r, const DetectableEffect& e) {
  return e.torque / r.diagnosis.mismatch.input_torque;
}

/// " at 24 per turn": a line is foretold at one period, and others take other amounts.
std::string repeats(const DiagnosisResult& r, const DetectableEffect& e) {
  for (const NamedValue& v : e.at)
    if (v.key == "periods_per_turn") return (r.coordinates.rotational() ? " at " : " ") + shape_text(r, v);
  return "";
}

std::string sentence(const DiagnosisResult& r) {
  std::vector<std::string> parts;
  for (const char* name : kAskedMost)
    for (const DetectableEffect& e : r.diagnosis.detectable)
      if (e.effect == name && e.can_be_shown() && parts.size() < kTold)
        parts.push_back(fmt::format("{} of more than {}{}", readable(e.effect), number_text(r, e.smallest),
                                    repeats(r, e)));
  if (parts.empty()) return "No effect of those that are asked for most could have been named here.";
  std::string text = fmt::format("{}", fmt::join(parts, ", "));
  if (parts.size() > 1) {
    const std::size_t last = text.size() - parts.back().size();
    text = text.substr(0, last - 2) + " and " + parts.back();
  }
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  text += " would have been named on these recordings.";
  const double highest = r.diagnosis.looked_at_hz.high;
  return std::isfinite(highest) ? text + fmt::format(" Nothing above {} Hz was looked for.", rounded(highest))
                                : text;
}

/// Those that have a torque to be drawn, the least first.
std::vector<const DetectableEffect*> drawn(const DiagnosisResult& r) {
  std::vector<const DetectableEffect*> effects;
  for (const DetectableEffect& e : r.diagnosis.detectable)
    if (e.can_be_shown() && share_of_input(r, e) > 0.0) effects.push_back(&e);
  std::stable_sort(effects.begin(), effects.end(), [](const DetectableEffect* a, const DetectableEffect* b) {
    return a->torque < b->torque;
  });
  return effects;
}

/// Where a share stands on the axis: the logarithm of its per cent.
double place_of(double share) { return std::log10(100.0 * share); }

/// Whole decades around what is drawn.
Interval decades(const DiagnosisResult& r, const std::vector<const DetectableEffect*>& effects) {
  const double least = share_of_input(r, *effects.front()), most = share_of_input(r, *effects.back());
  return {std::floor(place_of(0.7 * least)), std::ceil(place_of(1.1 * most))};
}

}  // namespace

FigureData diagnosis_detectable(const DiagnosisResult& r) {
  FigureData figure{"diagnosis_detectable.png", "Smallest amounts that would have been named"};
  const std::vector<const DetectableEffect*> effects = drawn(r);
  if (effects.empty())
    return missing_figure(figure, "nobody asked for it, or no amount could be found", false);
  const std::string torque = r.coordinates.torque_word();
  Panel panel;
  panel.x = {"rms " + torque + " of that amount, share of the input's", "%", decades(r, effects)};
  panel.x.places = log_places(panel.x.range, {1.0});
  if (!torque_note(r.input).empty())
    panel.title = "Amounts in " + r.coordinates.shown_unit("N m") + ": " + torque_note(r.input);
  constexpr double kHalf = 0.3;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const double row = static_cast<double>(i), share = place_of(share_of_input(r, *effects[i]));
    panel.y.categories.push_back(readable(effects[i]->effect));
    panel.y.remarks.push_back((falls(*effects[i]) ? "≤ " : "≥ ") + number_text(r, effects[i]->smallest));
    panel.tiles.push_back({{panel.x.range.low, share}, {row - kHalf, row + kHalf}, kBlue, ""});
  }
  const ErrorBudget& budget = r.diagnosis.budget;
  const double left = place_of(budget.remains / budget.input);
  const bool in_torque = r.diagnosis.verdict != DiagnosisVerdict::kNone && budget.exists();
  if (in_torque && left > panel.x.range.low && left < panel.x.range.high)
    panel.x_marks.push_back({left, guide_style(), "what no law explains"});
  panel.height = 90.0 + 64.0 * static_cast<double>(effects.size());
  figure.width = 2000.0;
  figure.panels.push_back(panel);
  figure.reading = sentence(r);
  return figure;
}

std::string detectable_table(const DiagnosisResult& r) {
  if (r.diagnosis.detectable.empty()) return "";
  std::string text = fmt::format(
      "\n## What would have been named\n\n{}\n\nForetold to first order on top of the model that the "
      "diagnosis has come to, one effect at a time, at the numbers of *at*; where the torque balance decides "
      "and `detectable: true` asks for it, corrected by implants into its rows. *Of the input*: rms of the "
      "{} that the smallest amount makes.\n\n| effect | smallest amount | at | of the input | why not "
      "|\n|---|---|---|---|---|\n",
      sentence(r), r.coordinates.torque_word());
  std::vector<double> shares;
  for (const DetectableEffect& e : r.diagnosis.detectable) shares.push_back(100.0 * share_of_input(r, e));
  const Percents percent(shares);
  for (const DetectableEffect& e : r.diagnosis.detectable) {
    const std::string amount =
        e.can_be_shown() ? (falls(e) ? "at most " : "") + number_text(r, e.smallest) : "–";
    const double share = share_of_input(r, e);
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", e.effect, amount, shapes_text(r, e),
                        share > 0.0 ? percent(100.0 * share) : "–", e.why);
  }
  return text;
}

}  // namespace gapscope::internal::report
