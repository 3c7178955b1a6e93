#include "report/markdown.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/diagnosis_words.h"
#include "report/rich_text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// With a full stop and a blank, ready for the next one; nothing for nothing.
std::string sentence(const std::string& text) {
  return text.empty() ? "" : text + (text.ends_with(".") ? " " : ". ");
}

std::string parameter_row(const FittedParameter& p, const FitSummary& fit, const RunResult& run) {
  const Coordinates coordinates = run.coordinates;
  const bool guess = p.key == "torque_constant" && run.input && run.input->constant_guessed;
  const std::string unit = coordinates.shown_unit(p.unit);
  const char* known = guess ? "a guess" : !p.estimated ? "given" : p.identifiable ? "yes" : "no";
  const std::string start = p.estimated ? quantity(p.start, unit) : "";
  std::string remark = p.at_bound ? "at its bound" : "";
  if (guess)
    remark = "every " + std::string(coordinates.torque_word()) +
             ", inertia, damping and stiffness here is off by its factor";
  if (std::isfinite(p.profile_ci95.low) && std::isfinite(fit.shown_interval(p).low))
    remark += (remark.empty() ? "profile likelihood " : ", profile likelihood ") +
              interval_text(p.profile_ci95, unit);
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", p.key,
                     p.estimated ? plus_minus(p.value, fit.shown_interval(p), unit) : quantity(p.value, unit),
                     known, start, remark);
}

/// Whether the gap is that of the model which a diagnosis fitted, and the estimate's own is rejected.
bool is_replaced(const RunResult& run, const DiagnosisResult* diagnosis) {
  return run.reference && run.reference->rejected() && diagnosis != nullptr && added(*diagnosis) &&
         diagnosis->answer && diagnosis->answer->from == AnswerSource::kDiagnosis;
}

std::vector<std::string> fit_warnings(const RunResult& run) {
  if (!run.reference) return {};
  std::vector<std::string> warnings = texts_of(run.reference->warnings);
  if (!run.reference->converged())
    warnings.insert(warnings.begin(), "The fit did not converge: " + run.reference->message.text());
  return warnings;
}

/// The gap, or what the verdict says instead.
std::string read_gap(const GapEstimate& g, const std::string& unit) {
  if (g.verdict == GapVerdict::kBacklash) return beside_interval(g.gap, g.ci95, unit);
  if (g.verdict == GapVerdict::kNone) return "none above " + quantity(g.none_above(), unit);
  return "inconclusive";
}

/// "motor_inertia, contact_stiffness" as code.
std::string given(const FitSummary& fit) {
  std::vector<std::string> keys;
  for (const std::string& key : fit.given()) keys.push_back("`" + key + "`");
  return keys.empty() ? "no number of the drive" : fmt::format("{}", fmt::join(keys, ", "));
}

std::string estimate_rows(const RunResult& run, const DiagnosisResult* diagnosis) {
  const std::string unit = position_unit(run);
  std::string text = "| backlash gap 2β | value | 95 % interval | needed to know |\n|---|---|---|---|\n";
  int rows = 0;
  const auto told = [&](const std::string& name, const std::string& value, const Interval& ci,
                        const std::string& needed) {
    ++rows;
    text += fmt::format("| {} | {} | {} | {} |\n", name, value, interval_text(ci, unit), needed);
  };
  const auto row = [&](const std::string& name, double value, const Interval& ci, const std::string& needed) {
    told(name, beside_interval(value, ci, unit), ci, needed);
  };
  if (run.model_free) {
    const GapEstimate& g = *run.model_free;
    const bool play = g.quantity == GapQuantity::kPlayAtZeroTorque;
    const bool first = g.quantity == GapQuantity::kFirstGap;
    told(play    ? "model-free (play at zero torque)"
         : first ? "model-free (first gap)"
                 : "model-free",
         read_gap(g, unit), g.ci95,
         g.method == GapMethod::kLostMotion ? "motor position and torque" : "motor position");
  }
  if (run.model_free) {
    const LostMotion& m = run.model_free->lost_motion;
    if (m.read()) row("lost motion at zero torque", m.value, m.ci95, "motor position and torque");
    if (m.levels.size() > 1)
      for (const LostMotionLevel& l : m.levels)
        row(fmt::format("the same at \\|u\\| = {}, {} ramps", rounded(l.amplitude), l.ramps), l.lost_motion,
            l.ci95, "");
  }
  if (run.literal)
    told("S1 to S6 as printed", read_gap(*run.literal, unit), {}, "motor position and a bound L");
  if (const FittedParameter* gap = parameter(run, "gap"))
    row(run.reference->rejected() ? "fitted model (rejected)" : "fitted model", gap->value,
        run.reference->shown_interval(*gap), "motor position, input, equations and " + given(*run.reference));
  if (const std::optional<ModelGap> gap = diagnosis ? diagnosis->diagnosis.model_gap : std::nullopt;
      gap && gap->origin == GapOrigin::kEstimated && added(*diagnosis))
    row("model " + with_added(*diagnosis) + " (diagnosis)", gap->value, gap->ci95,
        "motor position, input, equations and the given parameters");
  if (run.comparison && std::isfinite(run.comparison->map_width))
    row("read off the x1–x2 map", run.comparison->map_width, {}, "both encoders");
  if (std::isfinite(run.simulated_gap)) row("simulated plant", run.simulated_gap, {}, "");
  return rows > 0 ? text : "No gap was estimated.\n";
}

std::string comparison_line(const RunResult& run) {
  if (!run.comparison || !std::isfinite(run.comparison->difference)) return "";
  const Comparison& c = *run.comparison;
  return fmt::format("\nDifference of the two estimates: {}, joint standard deviation {}{}.\n",
                     quantity_beside(c.difference, run.model_free->gap, position_unit(run)),
                     quantity_beside(c.joint_std, run.model_free->gap, position_unit(run)),
                     !c.agree   ? ""
                     : *c.agree ? "; they agree within 1.96 of it"
                                : "; they differ by more than 1.96 of it");
}

/// Which bound decided what; empty where none did.
std::string bounds_line(const RunResult& run) {
  if (!run.model_free || !std::isfinite(run.model_free->bound)) return "";
  const GapEstimate& g = *run.model_free;
  const std::string unit = run.coordinates.shown_unit("rad/s^2");
  const bool by_model = std::isfinite(g.paper_bound);
  std::string text = fmt::format("\nBounds: L = {} {} {}", rounded(g.bound, 4), unit,
                                 !g.by_one_bound() ? "decides t2"
                                 : by_model        ? "is by the paper's eq. (13), see the notes"
                                                   : "was given");
  if (std::isfinite(g.bound_t1))
    text += fmt::format(", e_x is drawn with L = {} {}", rounded(g.bound_t1), unit);
  return text + ".\n";
}

constexpr std::size_t kTablePassages = 24;  ///< all of them are in result.json

/// "used"
std::string use_of(const GapEvent& e) { return e.accepted ? "yes" : "no: " + e.remark; }

/// How many of the passages cannot be in the table, as only their impact was seen, and why that is of most.
std::string without_begin(const std::vector<GapEvent>& all) {
  std::map<std::string, std::size_t> reasons;
  std::size_t count = 0;
  for (const GapEvent& e : all)
    if (!std::isfinite(e.t1)) ++count, ++reasons[e.remark];
  if (count == 0) return "";
  const auto& [why, often] = *std::ranges::max_element(reasons, {}, [](const auto& r) { return r.second; });
  return fmt::format("\n{} without a begin t1{} {} in `result.json`.\n", counted(count, "impact"),
                     why.empty() ? "" : (often < count ? " (most: " : " (") + why + ")",
                     count == 1 ? "is" : "are");
}

/// The passages of the gap that the estimate rests on, and those that were set aside.
std::string passage_table(const RunResult& run) {
  if (!run.model_free || run.model_free->events.empty()) return "";
  std::vector<GapEvent> events;
  for (const GapEvent& e : run.model_free->events)
    if (std::isfinite(e.t1)) events.push_back(e);
  const std::size_t begun = events.size();
  if (events.empty()) return "\n## Passages of the gap\n" + without_begin(run.model_free->events);
  const bool several = run.recordings.size() > 1;
  double largest = 0.0;
  for (const GapEvent& e : events)
    if (e.accepted) largest = std::max({largest, std::abs(e.gap), std::abs(e.x1_t2 - e.x1_t1)});
  const auto length = [&](double value) {
    return std::isfinite(value) ? quantity_beside(value, largest, position_unit(run)) : "–";
  };
  std::string text = fmt::format(
      "\n## Passages of the gap\n\nx1 from the loss of contact at t1 to the impact at t2; 2β is what each "
      "reads of the gap, with its standard error.{}\n\n| {}t1 [s] | t2 [s] | x1 | moves by | 2β | standard "
      "error | used |\n|{}---|---|---|---|---|---|---|\n",
      begun > kTablePassages
          ? fmt::format(" The first {} of {}; `result.json` has all.", kTablePassages, begun)
          : "",
      several ? "recording | " : "", several ? "---|" : "");
  for (std::size_t i = 0; i < std::min(begun, kTablePassages); ++i) {
    const GapEvent& e = events[i];
    text += fmt::format("| {}{:.4f} | {:.4f} | {} | {} | {} | {} | {} |\n", several ? e.file + " | " : "",
                        e.t1, e.t2, e.direction > 0 ? "rises" : "falls", length(std::abs(e.x1_t2 - e.x1_t1)),
                        length(e.accepted ? e.gap : kNaN), length(e.accepted ? e.std : kNaN), use_of(e));
  }
  return text + without_begin(run.model_free->events);
}

/// Of a reference that the diagnosis has replaced.
std::string replaced_text(const RunResult& run, const DiagnosisResult& diagnosis) {
  std::vector<std::string> names;
  for (const std::string& effect : diagnosis.diagnosis.effects) names.push_back(readable(effect));
  std::string text = fmt::format(
      "This is the model as configured, without {}, which the diagnosis has added: the numbers to use are "
      "those of `fitted.yaml`, not these. Warnings of this model:\n\n",
      fmt::join(names, " and "));
  for (const std::string& warning : fit_warnings(run)) text += "- " + warning + "\n";
  return text + "\n";
}

std::string parameter_table(const RunResult& run, const DiagnosisResult* diagnosis) {
  if (!run.reference || run.reference->parameters.empty()) return "";
  const FitSummary& fit = *run.reference;
  std::string text = fmt::format(
      "\n## Parameters of the fitted model\n\n{}Trust: {}. {}\n\n| parameter | {} | identifiable | start | "
      "remark |\n|---|---|---|---|---|\n",
      is_replaced(run, diagnosis) ? replaced_text(run, *diagnosis) : "", to_string(fit.trust), fit.why.text(),
      fit.rejected() ? "value (of a rejected model, hence without an interval)"
                     : "value (± half of the 95 % interval)");
  for (const FittedParameter& p : fit.parameters) text += parameter_row(p, fit, run);
  text +=
      "\n" + sentence(fit.message.text()) + "Free run: " + quantity(fit.rmse, position_unit(run)) + " rms";
  if (std::isfinite(fit.fit_percent)) text += ", a fit of " + fit_text(fit.fit_percent);
  if (std::isfinite(fit.floor)) text += ", the encoder floor is " + quantity(fit.floor, position_unit(run));
  return text + ".\n";
}

/// What the encoder on the load says of the model, which did not read it.
std::string second_encoder_table(const RunResult& run) {
  if (!run.second_encoder) return "";
  const SecondEncoder& s = *run.second_encoder;
  const std::string unit = position_unit(run);
  std::string text =
      "\n## Validation by the encoder on the load\n\nThe fit read the motor's alone. The mean difference of "
      "each recording is taken out: the two have no common zero.\n\n| quantity | value |\n|---|---|\n";
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("| {} | {} |\n", name, value);
  };
  if (std::isfinite(s.rmse)) {
    row("free run − recorded x2, rms", quantity(s.rmse, unit));
    row("the same of x1, which was fitted", quantity(s.motor_rmse, unit));
    row("fit of x2, worst recording", fit_text(s.fit_percent));
  }
  if (std::isfinite(s.floor)) row("what this encoder alone leaves", quantity(s.floor, unit));
  if (std::isfinite(s.gap))
    row("gap by the difference of both, wind-up of the contact included", quantity(s.gap, unit));
  if (std::isfinite(s.difference)) row("the fitted gap less that", quantity(s.difference, unit));
  return text;
}

std::string timing_line(const Timing& timing) {
  const bool detected = std::isfinite(timing.model_free_s), fitted = std::isfinite(timing.reference_s);
  const bool both = detected && fitted && std::isfinite(timing.wall_s);
  if (!detected && !fitted) return "";
  return std::string("\nRun times are in `timing.json`") +
         (both ? "; the estimators run side by side, `wall_s` is that of both.\n" : ".\n");
}

}  // namespace

std::string figure_section(const std::vector<FigureData>& figures) {
  std::string text = "\n## Figures\n";
  for (const FigureData& figure : figures) {
    const std::string title = plain_text(figure.title);
    if (figure.missing.empty())
      text += fmt::format("\n### {}\n\n![{}]({})\n\n{}\n", title, title, figure.file, figure.reading);
  }
  std::string left_out;
  for (const FigureData& figure : figures)
    if (!figure.missing.empty() && figure.expected)
      left_out += fmt::format("- `{}`: {}.\n", figure.file, figure.missing);
  if (!left_out.empty()) text += "\n### Left out\n\n" + left_out;
  return text;
}

std::string bullet_section(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = fmt::format("\n## {}\n\n", title);
  for (const std::string& line : lines) text += "- " + line + "\n";
  return text;
}

std::vector<std::string> notes_of(const RunResult& run) {
  std::vector<std::string> notes = run.notes;
  for (const Recording& r : run.recordings) {
    notes.push_back(fmt::format("`{}`: {} samples, {} at {:g} Hz, encoder quantum {}.", r.file, r.size(),
                                quantity(r.duration(), "s"), 1.0 / r.dt,
                                r.quantum > 0.0 ? quantity(r.quantum, position_unit(run)) : "unknown"));
  }
  return notes;
}

std::vector<std::string> warnings_of(const RunResult& run, const DiagnosisResult* diagnosis) {
  std::vector<std::string> warnings;
  if (run.model_free) warnings = texts_of(run.model_free->warnings);
  if (is_replaced(run, diagnosis)) return warnings;
  for (std::string& warning : fit_warnings(run)) warnings.push_back(std::move(warning));
  return warnings;
}

std::string estimate_text(const RunResult& run, const Timing& timing, const DiagnosisResult* diagnosis) {
  std::string text = "\n## Estimates of the gap\n\n" + estimates_text(run) + "\n\n" +
                     estimate_rows(run, diagnosis) + comparison_line(run);
  if (run.model_free && !run.model_free->reason.empty())
    text += "\nModel-free verdict: " + sentence(run.model_free->reason.text()) + "\n";
  if (run.model_free && run.model_free->lost_motion.read())
    text += "\nLost motion: " + sentence(run.model_free->lost_motion.meaning.text()) + "\n";
  text += bounds_line(run);
  text +=
      timing_line(timing) + passage_table(run) + parameter_table(run, diagnosis) + second_encoder_table(run);
  if (is_replaced(run, diagnosis)) return text;  // by a model that needs no advice to sharpen this one
  if (run.reference) text += bullet_section("What would sharpen the fit", texts_of(run.reference->advice));
  if (run.answer && run.answer->next.size() > 1)
    text += bullet_section("What would make the gap sure", run.answer->next);
  return text;
}

}  // namespace gapscope::internal::report
