#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "gapscope/base/units.h"
#include "report/diagnosis_figures.h"
#include "report/markdown.h"
#include "report/wording.h"

namespace gapscope::internal {
namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–"; }

std::string measures_table(const DiagnosisResult& r) {
  std::string text =
      "\n## How large, on held-out data\n\n| measure (median over windows) | nominal model | with all that "
      "was added | floor |\n|---|---|---|---|\n";
  for (const MismatchMeasure& m : r.diagnosis.measures)
    text += fmt::format("| {} | {} | {} | {} |\n", m.name, quantity(m.before, m.unit),
                        quantity(m.after, m.unit), std::isfinite(m.floor) ? quantity(m.floor, m.unit) : "–");
  const MismatchSize& g = r.diagnosis.gap;
  static const char* const kFrom[] = {"the encoder's quantum", "the encoder's noise",
                                      "the drive's repeatability"};
  text += fmt::format("\nThe floor is that of {}.", kFrom[static_cast<int>(g.floor_from)]);
  if (std::isfinite(g.shrink)) {
    text += fmt::format(" The error shrinks by {:.3g}", g.shrink);
    if (std::isfinite(g.shrink_ci95.low))
      text += fmt::format(" (95 %: {:.3g} to {:.3g}, for this kind of excitation)", g.shrink_ci95.low,
                          g.shrink_ci95.high);
    text += fmt::format("; what remains is {:.3g} times the floor, {}.", g.remains,
                        r.diagnosis.remaining.headline);
  }
  return text + "\n";
}

std::string parameters_of(const RankedEffect& e, bool rotation) {
  std::vector<std::string> parts;
  for (const NamedValue& p : e.parameters)
    parts.push_back(
        fmt::format("{} {:.4g}{}", p.key, p.value, p.unit == "-" ? "" : " " + shown_unit(p.unit, rotation)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string outside_words(const Diagnosis& d) {
  if (!std::isfinite(d.outside_probability)) return "";
  const bool repeatability = d.gap.floor_from == FloorSource::kRepeatability;
  return fmt::format("; with {:.2f} the catalogue lacks what is missing{}", d.outside_probability,
                     repeatability ? ". None was learned on drives that are judged by their repeatability, "
                                     "as this one is: take them for an order"
                                   : "");
}

std::string ranking_table(const DiagnosisResult& r) {
  if (r.diagnosis.ranking.empty()) return "";
  std::string text =
      "\n## Which effect\n\nEvery candidate was refitted with all parameters of the drive. Probabilities are "
      "those of simulated drives with one missing effect" +
      outside_words(r.diagnosis) +
      ".\n\n| effect | probability | closed share (log) | shrink | windows better | parameters | remark "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const RankedEffect& e : r.diagnosis.ranking)
    text +=
        fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", e.effect,
                    std::isfinite(e.probability) ? fmt::format("{:.2f}", e.probability) : "–", number(e.rel),
                    number(e.shrink), number(e.windows_better), parameters_of(e, r.rotation), e.remark);
  return text;
}

std::string names_list(const std::vector<std::string>& names) {
  return names.empty() ? "–" : fmt::format("`{}`", fmt::join(names, "`, `"));
}

std::string steps_table(const DiagnosisResult& r) {
  const std::string unit = r.rotation ? "rad" : "m";
  std::string text;
  for (const DiagnosisStep& s : r.diagnosis.steps) {
    if (s.ranking.empty()) continue;
    std::vector<std::string> others = s.group;
    std::erase(others, s.effect);
    text +=
        fmt::format("| {} | `{}` | {} | {} | {} | {} | {:.3g} | {} | {} | {} |\n", names_list(s.on_top_of),
                    s.effect, s.accepted ? "added" : "not added", names_list(others),
                    quantity(s.gap.before, unit), quantity(s.gap.after, unit), s.gap.shrink,
                    parameters_of(s.ranking.front(), r.rotation), names_list(s.dropped), s.remaining);
  }
  if (text.empty()) return "";
  return "\n## Further steps\n\nEvery candidate was refitted on top of what was found before it.\n\n| on top "
         "of | effect | outcome | not told from | error before | after | shrink of this step | parameters | "
         "made superfluous | what remains |\n|---|---|---|---|---|---|---|---|---|---|\n" +
         text;
}

std::string periodic_table(const DiagnosisResult& r) {
  if (r.diagnosis.periodic.empty()) return "";
  const std::string angle = r.rotation ? "rad" : "m", torque = r.rotation ? "N·m" : "N";
  std::string text =
      "\n## Torque that repeats with the position\n\nIn what the model leaves with all that was added. "
      "Listed, not added: `cogging_torque` and `torque_ripple` are candidates like any other.\n\n| period | "
      "cycles per turn | amplitude | over neighbouring periods | held-out windows better | holds there "
      "|\n|---|---|---|---|---|---|\n";
  for (const PeriodicTorque& p : r.diagnosis.periodic)
    text += fmt::format("| {} | {} | {} | {} | {} of {} | {} |\n", quantity(p.period, angle),
                        r.rotation ? number(p.periods_per_turn) : "–", quantity(p.amplitude, torque),
                        p.given ? "given" : fmt::format("{:.3g} times", p.stands_out), p.better, p.windows,
                        p.holds ? "yes" : "no");
  return text;
}

std::string blame_table(const DiagnosisResult& r) {
  if (r.diagnosis.blame.empty()) return "";
  std::string text =
      "\n## What the model took the blame for\n\n| parameter | nominal model | with all that was added | the "
      "first reads |\n|---|---|---|---|\n";
  for (const BlameShift& b : r.diagnosis.blame) {
    const double percent = 100.0 * (b.without - b.with) / std::abs(b.with);
    text += fmt::format(
        "| `{}` | {} | {} | {} |\n", b.key, quantity(b.without, shown_unit(b.unit, r.rotation)),
        quantity(b.with, shown_unit(b.unit, r.rotation)),
        std::isfinite(percent) ? fmt::format("{:.3g} % {}", std::abs(percent), percent > 0 ? "high" : "low")
                               : "–");
  }
  return text;
}

std::string experiment_table(const DiagnosisResult& r) {
  const NextExperiment& next = r.diagnosis.next_experiment;
  if (next.sentence.empty()) return "";
  std::string text = "\n## What to record next\n\n" + next.sentence + "\n";
  if (!next.proposes()) return text;
  text +=
      "\n`next_experiment.yaml` and `next_experiment.csv` hold it. Each model was refitted to what the other "
      "one would record; what it then leaves counts, in units of the encoder's noise (σ).\n\n| input | "
      "travel |";
  for (const Separation& s : next.tried.front().separations)
    text += fmt::format(" `{}`, taken for `{}` |", s.truth, s.rival);
  text += "\n|---|---|";
  for (std::size_t i = 0; i < next.tried.front().separations.size(); ++i) text += "---|";
  text += "\n";
  for (const TriedInput& t : next.tried) {
    text += fmt::format("| {} | {} |", t.input, quantity(t.travel, r.rotation ? "rad" : "m"));
    for (const Separation& s : t.separations)
      text += s.contained ? " contained, nothing can tell |" : fmt::format(" {:.3g} σ |", s.excess);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string diagnosis_text(const DiagnosisResult& r, const std::vector<FigureData>& figures) {
  std::string text = fmt::format("# {}: what the simulation lacks\n\n**{}**\n", r.name, r.diagnosis.sentence);
  text += bullet_section("Warnings", r.diagnosis.warnings);
  text += measures_table(r) + ranking_table(r) + steps_table(r) + periodic_table(r) + blame_table(r) +
          experiment_table(r) + figure_section(figures);
  text += "\n`fitted.yaml` holds the model as fitted; `gapscope simulate fitted.yaml -o FILE` runs it.\n";
  return text + fmt::format("\ngapscope {}\n", r.version);
}

}  // namespace gapscope::internal
