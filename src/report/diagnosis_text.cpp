#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "base/decimals.h"
#include "base/percents.h"
#include "base/text.h"
#include "report/added_table.h"
#include "report/detectable.h"
#include "report/diagnosis_figures.h"
#include "report/diagnosis_words.h"
#include "report/error_budget.h"
#include "report/last_resort.h"
#include "report/simulator.h"
#include "report/wording.h"
#include "results/diagnosis_result.h"

namespace gapscope::internal::report {
namespace {

std::string refitted_row(const RefittedNumber& n, Coordinates coordinates) {
  const Coordinates own = n.key.ends_with("phase_rad") ? Coordinates() : coordinates;  // along a slide, too
  const std::string unit = own.shown_unit(n.unit);
  return fmt::format("| `{}` | {} | {} | {} |\n", n.key, quantity_beside(n.configured, n.fitted, unit),
                     beside_interval(n.fitted, n.ci95, unit), interval_text(n.ci95, unit));
}

/// The section of report.md on the numbers that the configuration gives and the recordings contradict, with
/// those that were fitted; empty where there are none.
std::string refitted_table(const DiagnosisResult& r) {
  std::string rows;
  for (const RefittedNumber& n : r.diagnosis.refitted)
    if (rounded(n.configured) != rounded(n.fitted)) rows += refitted_row(n, r.coordinates);
  if (rows.empty()) return "";
  return fmt::format(
      "\n## Numbers of your model\n\nEstimated numbers whose interval leaves out what the configuration "
      "starts at, where three digits show that: a number that the recordings contradict, or no more than a "
      "first guess. The intervals hold for the model {}; {}.\n\n"
      "| number | the configuration starts at | fitted | 95 % |\n|---|---|---|---|\n{}",
      added(r) ? with_added(r) : std::string("as it is"),
      r.diagnosis.loop ? "`fitted.yaml` has those of the closed loop, see below"
                       : "`fitted.yaml` has the fitted ones",
      rows);
}

/// The stored name of a measure in words.
std::string measure_name(const std::string& stored) {
  constexpr std::string_view kStored = "residual ";
  return stored.starts_with(kStored) ? "correcting " + stored.substr(kStored.size()) : stored;
}

/// What a measure reads with what was added, as a cell; no cell where nothing was.
std::string after_cell(const DiagnosisResult& r, double after, double before, const std::string& unit) {
  return added(r) ? " " + quantity_beside(after, before, unit) + " |" : "";
}

std::string measures_table(const DiagnosisResult& r) {
  std::string text = fmt::format(
      "\n## How large, on held-out data\n\n| measure (median over windows) | nominal model |{} floor |\n"
      "|---|---|{}---|\n",
      added(r) ? " with all that was added |" : "", added(r) ? "---|" : "");
  for (const MismatchMeasure& m : r.diagnosis.measures) {
    const std::string unit = Coordinates().shown_unit(m.unit);  // that of this drive already
    text += fmt::format("| {} | {} |{} {} |\n", measure_name(m.name), quantity(m.before, unit),
                        after_cell(r, m.after, m.before, unit),
                        std::isfinite(m.floor) ? quantity_beside(m.floor, m.before, unit) : "–");
  }
  if (const auto& whole = r.diagnosis.whole_run) {
    const std::string unit = r.coordinates.position_unit();
    text += fmt::format(
        "| largest error of one free run through the whole recording ({} of travel) | {} |{} – |\n",
        quantity(whole->travel, unit), quantity(whole->before, unit),
        after_cell(r, whole->after, whole->before, unit));
  }
  const MismatchSize& g = r.diagnosis.mismatch;
  const bool balanced = std::any_of(r.diagnosis.budget.rungs.begin(), r.diagnosis.budget.rungs.end(),
                                    [](const BudgetRung& rung) { return rung.added; });
  text += fmt::format("\nThe answer rests on {}: {}. Its floor, {}, is the {}{}{}.",
                      balanced ? "the error budget and, of the motion, on this one" : "this one", g.measure,
                      quantity(g.floor, r.coordinates.position_unit()), floor_name(g.floor_from),
                      g.floor_of.empty() ? "" : ": ", g.floor_of);
  if (std::isfinite(g.shrink)) {
    const auto percent = [](double share) { return with_decimals(100.0 * share, 0); };
    text += fmt::format(" The error above the floor shrinks by {} %", percent(g.shrink));
    if (std::isfinite(g.shrink_ci95.low))
      text += fmt::format(" (95 %: {} to {} %, for this kind of excitation)", percent(g.shrink_ci95.low),
                          percent(g.shrink_ci95.high));
    text += fmt::format("; what remains is {} times the {}, and {}.", rounded(g.remains),
                        floor_name(g.floor_from), r.diagnosis.remaining.headline);
  }
  return text + "\n";
}

std::string closed_loop_table(const DiagnosisResult& r) {
  if (!r.diagnosis.closed_loop) return "";
  const ClosedLoop& c = *r.diagnosis.closed_loop;
  const std::string unit = r.coordinates.position_unit();
  const bool more = added(r) || r.diagnosis.loop;
  std::string text = fmt::format(
      "\n## The drive under its controller\n\nThe command goes in, the position comes out; each held-out "
      "recording all the way, rms of the position error.\n\n| recording | nominal model |{}\n|---|---|{}\n",
      more ? " as recommended |" : "", more ? "---|" : "");
  const auto row = [&](const std::string& name, double before, double after) {
    text += fmt::format("| {} | {} |{}\n", name, quantity(before, unit),
                        more ? " " + quantity_beside(after, before, unit) + " |" : "");
  };
  for (const ClosedLoopRun& run : c.recordings) row(run.file, run.before, run.after);
  if (c.recordings.size() > 1) row("all", c.before, c.after);
  return text;
}

/// Each recording beside the model that was fitted for it, worst first.
std::string loop_runs_table(const char* heading, std::vector<HeldOutRun> runs, const std::string& unit) {
  if (runs.empty()) return "";
  std::stable_sort(runs.begin(), runs.end(),
                   [](const HeldOutRun& a, const HeldOutRun& b) { return a.mae > b.mae; });
  double sum = 0.0;
  for (const HeldOutRun& run : runs) sum += run.mae;
  std::string text = fmt::format("\n| {} | mean error | rms | fit |\n|---|---|---|---|\n", heading);
  for (const HeldOutRun& run : runs)
    text += fmt::format("| {} | {} | {} | {:.1f} % |\n", run.file, quantity(run.mae, unit),
                        quantity(run.rmse, unit), run.fit);
  return text + fmt::format("\nMean over these {}: {}; the worst is {}.\n", runs.size(),
                            quantity(sum / static_cast<double>(runs.size()), unit), runs.front().file);
}

/// The model of fitted.yaml, whose numbers are those of the closed loop.
std::string loop_fit_text(const DiagnosisResult& r) {
  if (!r.diagnosis.loop) return "";
  const LoopFit& fit = *r.diagnosis.loop;
  const std::string unit = r.coordinates.position_unit();
  std::string text = fmt::format(
      "\n## Fitted in the loop\n\nfitted.yaml has the numbers with which the whole loop follows the "
      "recordings best, goal in, position out: {} off in the mean over what was fitted, {} before.{}\n\n| "
      "number | value | 95 % interval |\n|---|---|---|\n",
      quantity(fit.mae_after, unit), quantity(fit.mae_before, unit),
      fit.added.empty() ? "" : fmt::format(" It asked for {}.", fmt::join(fit.added, ", ")));
  for (const LoopNumber& n : fit.numbers)
    text += fmt::format("| {} | {:.4g} {} | {:.4g} to {:.4g} |\n", n.key, n.value, n.unit, n.ci95.low,
                        n.ci95.high);
  return text + loop_runs_table("held out", r.diagnosis.held_out_runs, unit) +
         loop_runs_table("fitted", fit.fitted_runs, unit);
}

std::string parameters_of(const RankedEffect& e, Coordinates coordinates) {
  std::vector<std::string> parts;
  for (const NamedValue& p : e.parameters) {
    if (is_left_out(p)) continue;
    const bool phase = p.key == "phase_rad";  // an angle on a linear axis, too
    const std::string unit = (phase ? Coordinates() : coordinates).shown_unit(p.unit);
    parts.push_back(name_of_key(p.key) + " " + quantity(p.value, unit));
    if (!coordinates.rotational() && p.key == "periods_per_turn")
      parts.back() = "a period of " + quantity(2.0 * kPi / p.value, "m");
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// " Not in this table, which is of the first step: `load_dependent_friction`."
std::string not_ranked(const Diagnosis& d) {
  std::vector<std::string> names;
  for (const std::string& effect : d.effects)
    if (std::none_of(d.ranking.begin(), d.ranking.end(),
                     [&](const RankedEffect& e) { return e.effect == effect; }))
      names.push_back(effect);
  if (names.empty()) return "";
  return fmt::format(" Not in this table, which is of the first step: `{}`.", fmt::join(names, "`, `"));
}

/// What the probabilities are worth here.
std::string probability_words(const DiagnosisResult& r) {
  const Diagnosis& d = r.diagnosis;
  if (budget_decides(d))
    return fmt::format(
               " What each does alone, to the free run, did not decide here: the error budget did, by what "
               "is left of the {} once each is refitted with all before it. It begins with `{}`; no "
               "probabilities were learned for it.",
               r.coordinates.torque_word(), d.effects.front()) +
           not_ranked(d);
  if (d.mismatch.floor_from == FloorSource::kRepeatability)
    return " It is judged by its repeatability floor, for which no probabilities were learned: the verdict "
           "rests on the held-out errors alone.";
  if (!std::isfinite(d.outside_probability))
    return d.budget.exists()
               ? " None has a probability: these were learned on drives without an error budget."
               : "";
  return fmt::format(
      " Probabilities are those of simulated drives with one missing effect; probability {:.2f} that the "
      "cause is not in the catalogue.",
      d.outside_probability);
}

/// What the columns are of, and why the numbers are not those of what was added.
std::string basis_words(const DiagnosisResult& r) {
  std::string text =
      "Each candidate alone, on the nominal model, every estimated number refitted to the motion; the "
      "columns are of the held-out *motion*, not of the missing " +
      std::string(torque_word(r)) + " on the card.";
  if (!r.diagnosis.added.empty()) text += " For the model with all that was added see What was added.";
  return text + " `gapscope effects --laws` has the law of each and what its parameters mean.";
}

/// With the card's choice marked.
std::string remark_of(const RankedEffect& e, const Diagnosis& d) {
  if (!contains(d.effects, e.effect)) return e.remark;
  return "**in the card**" + (e.remark.empty() ? "" : "; " + e.remark);
}

std::string ranking_table(const DiagnosisResult& r) {
  if (r.diagnosis.ranking.empty()) return "";
  const std::vector<RankedEffect>& ranking = r.diagnosis.ranking;
  const bool learned = r.diagnosis.mismatch.floor_from != FloorSource::kRepeatability &&
                       !budget_decides(r.diagnosis) &&
                       std::any_of(ranking.begin(), ranking.end(),
                                   [](const RankedEffect& e) { return std::isfinite(e.probability); });
  std::string text = "\n## Which effect, judged by the motion\n\n" + basis_words(r) + probability_words(r) +
                     fmt::format(
                         "\n\n| effect |{} explained share | error removed | windows better | parameters, "
                         "alone | remark |\n|---|{}---|---|---|---|---|\n",
                         learned ? " probability |" : "", learned ? "---|" : "");
  for (const RankedEffect& e : r.diagnosis.ranking)
    text += fmt::format("| `{}` |{} {} | {} | {} | {} | {} |\n", e.effect,
                        !learned                       ? ""
                        : std::isfinite(e.probability) ? fmt::format(" {:.2f} |", e.probability)
                                                       : " – |",
                        rounded(e.rel), rounded(e.shrink), rounded(e.windows_better),
                        parameters_of(e, r.coordinates), remark_of(e, r.diagnosis));
  return text;
}

std::string names_list(const std::vector<std::string>& names) {
  return names.empty() ? "–" : fmt::format("`{}`", fmt::join(names, "`, `"));
}

std::string steps_table(const DiagnosisResult& r) {
  const std::string unit = r.coordinates.position_unit();
  std::string text;
  for (const DiagnosisStep& s : r.diagnosis.steps) {
    if (s.ranking.empty()) continue;
    std::vector<std::string> others = s.group;
    std::erase(others, s.effect);
    text += fmt::format(
        "| {} | `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n", names_list(s.on_top_of), s.effect,
        s.accepted ? "added" : "not added", names_list(others), quantity(s.mismatch.before, unit),
        quantity_beside(s.mismatch.after, s.mismatch.before, unit), rounded(s.mismatch.shrink),
        parameters_of(s.ranking.front(), r.coordinates), names_list(s.dropped), s.remaining);
  }
  if (text.empty()) return "";
  return std::string("\n## Further steps\n\n") +
         (added(r)
              ? "Every candidate was refitted on top of what was found before it."
              : "No candidate was sure: every other was tried on top of the likeliest, and none bore it out.") +
         "\n\n| on top of | effect | outcome | not separable from | error before | after | error removed | "
         "parameters | made superfluous | what remains |\n|---|---|---|---|---|---|---|---|---|---|\n" +
         text;
}

std::string periodic_table(const DiagnosisResult& r) {
  if (r.diagnosis.periodic.empty()) return "";
  const std::string angle = r.coordinates.position_unit(), torque = r.coordinates.shown_unit("N m");
  std::string text = "\n## " + std::string(r.coordinates.rotational() ? "Torque" : "Force") +
                     " that repeats with the position\n\nIn what the model leaves" +
                     (added(r) ? " with all that was added" : "") +
                     ". Listed, not added: `cogging_torque` and `torque_ripple` are candidates of every "
                     "step, which start at the strongest lines and at given periods.\n\n| period | " +
                     (r.coordinates.rotational() ? "cycles per turn | " : "") +
                     "amplitude | over neighbouring periods | held-out windows better | holds there "
                     "|\n|---|---|---|---|---|" +
                     (r.coordinates.rotational() ? "---|\n" : "\n");
  for (const PeriodicTorque& p : r.diagnosis.periodic)
    text += fmt::format("| {} | {}{} | {} | {} of {} | {} |\n", quantity(p.period, angle),
                        r.coordinates.rotational() ? rounded(p.periods_per_turn) + " | " : "",
                        quantity(p.amplitude, torque), p.given ? "given" : rounded(p.stands_out) + " times",
                        p.better, p.windows, p.holds ? "yes" : "no");
  return text;
}

/// "at its lower bound, 0 N·m s/rad" of a number that has ended there; else the number.
std::string blamed(double value, BoundReached at, const std::string& unit) {
  const std::string number = quantity(value, unit);
  if (at == BoundReached::kNone) return number;
  return fmt::format("at its {} bound, {}", at == BoundReached::kLower ? "lower" : "upper", number);
}

/// What stands at a bound is no reading, and has no bias; nor has what was held.
double bias_of(const BlameShift& b) {
  const bool read = !b.held && b.without_at == BoundReached::kNone && b.with_at == BoundReached::kNone;
  return read ? 100.0 * (b.without - b.with) / std::abs(b.with) : kNaN;
}

std::string blame_table(const DiagnosisResult& r) {
  if (r.diagnosis.blame.empty()) return "";
  std::string text =
      "\n## Parameters biased by what was missing\n\n| parameter | nominal model | with all that was added | "
      "bias of the nominal model |\n|---|---|---|---|\n";
  bool held = false;
  std::vector<double> all;
  for (const BlameShift& b : r.diagnosis.blame)
    if (std::isfinite(bias_of(b))) all.push_back(bias_of(b));
  const Percents shown(all);
  for (const BlameShift& b : r.diagnosis.blame) {
    const double percent = bias_of(b);
    const std::string unit = r.coordinates.shown_unit(b.unit);
    held = held || b.held;
    text += fmt::format("| `{}` | {} | {} | {} |\n", b.key, blamed(b.without, b.without_at, unit),
                        b.held ? std::string("held, not refitted") : blamed(b.with, b.with_at, unit),
                        std::isfinite(percent)
                            ? fmt::format("{} {}", shown(std::abs(percent)), percent > 0 ? "high" : "low")
                            : "–");
  }
  return text + (held ? "\nHeld: the " + std::string(torque_word(r)) +
                            " balance, which has the numbers of what was added here, leaves it where the fit "
                            "of the nominal model had it, with that model's bias.\n"
                      : "");
}

std::string experiment_table(const DiagnosisResult& r) {
  const NextExperiment& next = r.diagnosis.next_experiment;
  if (next.sentence.empty()) return "";
  std::string text = "\n## What to record next\n\n" + next.sentence + "\n";
  if (!next.proposes()) return text;
  text +=
      "\n`next_experiment.yaml` and `next_experiment.csv` hold the first one. Each model was refitted to "
      "what the other one would record; what it then leaves counts, in units of the encoder's noise "
      "(σ).\n\n| input | travel |";
  for (const Separation& s : next.tried.front().separations)
    text += fmt::format(" `{}`, taken for `{}` |", s.truth, s.rival);
  text += "\n|---|---|";
  for (std::size_t i = 0; i < next.tried.front().separations.size(); ++i) text += "---|";
  text += "\n";
  for (const TriedInput& t : next.tried) {
    text += fmt::format("| {} | {} |", t.input, quantity(t.travel, r.coordinates.position_unit()));
    for (const Separation& s : t.separations)
      text += s.contained ? " contained, nothing can separate it |" : " " + rounded(s.excess) + " σ |";
    text += "\n";
  }
  return text;
}

}  // namespace

std::string diagnosis_text(const DiagnosisResult& r) {
  return fmt::format("\n## What the simulation lacks\n\n**{}**\n", r.diagnosis.sentence) +
         simulator_table(r) + added_table(r) + refitted_table(r) + budget_table(r) + measures_table(r) +
         closed_loop_table(r) + loop_fit_text(r) + ranking_table(r) + steps_table(r) + periodic_table(r) +
         blame_table(r) + law_table(r) + detectable_table(r) + experiment_table(r) +
         "\n`fitted.yaml` holds the model as fitted; `gapscope simulate fitted.yaml -o FILE` runs it.\n";
}

}  // namespace gapscope::internal::report
