#include "report/blind_report.h"

#include <fmt/format.h>

#include <cmath>

#include "report/blind_figures.h"
#include "report/implant_report.h"
#include "report/markdown.h"
#include "report/report_files.h"
#include "results/blind_score.h"

namespace gapscope {
namespace internal::report {
namespace {

constexpr double kOftenNamed = 0.8;

std::string percent_of(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : "–";
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–";
}

/// True without an aim.
bool held(const BlindCount& c) {
  return !std::isfinite(c.aim) || (c.at_most ? c.share() <= c.aim : c.share() >= c.aim);
}

/// The aim and whether it is held; "–" without one.
std::string reached(const BlindCount& c) {
  if (!std::isfinite(c.aim)) return "–";
  const bool open = c.limits().low < c.aim && c.aim < c.limits().high;  // chance may have made it so
  return fmt::format("{} {}: {}{}", c.at_most ? "at most" : "at least", percent_of(c.aim),
                     held(c) ? "held" : "**missed**", open ? " in these cases, too few to be sure" : "");
}

std::string count_table(const BlindScore& s) {
  std::string text = "| | cases | share | 95 % limits (Wilson) | aim |\n|---|---|---|---|---|\n";
  for (const BlindCount& c : s.counts)
    text +=
        fmt::format("| {} | {} of {} | {} | {} to {} | {} |\n", c.name, c.count, c.of, percent_of(c.share()),
                    percent_of(c.limits().low), percent_of(c.limits().high), reached(c));
  return text;
}

std::string size_lines(const BlindScore& s) {
  return fmt::format(
      "\nShrink of the held-out error, of effects that were named and had at least 3 floors of mismatch: "
      "median {} (aim 0.97), tenth percentile {} (aim 0.8); of effects whose law is another than the "
      "catalogue's, median {} (aim 0.9). Effects in a group that the data does not separate: median {}, mean {}.\n",
      number(s.shrink_median, 3), number(s.shrink_tenth, 3), number(s.shrink_other_law, 3),
      number(s.group_median, 0), number(s.group_mean, 2));
}

std::string slice_table(const BlindScore& s) {
  std::string text =
      "\n## One effect, by rig, severity and effect\n\n| | cases | above 2 floors | first | named | another "
      "named | median shrink |\n|---|---|---|---|---|---|---|\n";
  for (const BlindSlice& x : s.slices)
    text += fmt::format("| {} {} | {} | {} | {} | {} | {} | {} |\n", x.by, x.name, x.cases, x.seen, x.first,
                        x.named, x.wrong, number(x.shrink, 3));
  return text;
}

/// What a reader must not expect: aims that were missed, effects that are often not named, what was not
/// asked.
std::string limits_section(const BlindScore& s) {
  std::string text = "\n## What it cannot do\n\n";
  for (const BlindCount& c : s.counts)
    if (!held(c))
      text += fmt::format("- {}: {} where {} {} was aimed at.\n", c.name, percent_of(c.share()),
                          c.at_most ? "at most" : "at least", percent_of(c.aim));
  for (const BlindSlice& x : s.slices)
    if (x.by == "effect" && x.seen > 0 && x.named < kOftenNamed * x.seen)
      text += fmt::format("- {} is named in {} of {} cases only.\n", x.name, x.named, x.seen);
  return text +
         "- An effect that leaves less than 2 floors of mismatch is counted in the confusion matrix alone.\n"
         "- Only drives like the rigs above were asked about: two inertias and a gap, contact stiffness and "
         "damping known, recordings of seconds. Nothing here says how often it is right on a real drive.\n";
}

/// Cases of the report part that were answered with an effect that is not there, or missed one.
std::string failures(const BlindScore& s) {
  std::string text = "\n## Every case that was not answered right\n\n";
  text +=
      "| case | rig | severity | truth | answer | mismatch, floors | probability "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const ScoredCase& c : s.cases)
    if (c.part == "report" && !c.right)
      text +=
          fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", c.name, c.rig, number(c.severity, 2), c.truth,
                      c.named.empty() ? c.verdict : c.named, number(c.before, 1), number(c.probability, 2));
  return text;
}

/// What the seal of the answers proves, and what it does not.
std::string seal_sentence(const BlindScore& s) {
  if (s.announced_seal.empty())
    return "Labels and answers are those that were sealed; whether the answers were sealed before the labels "
           "were opened was not checked: no seal was announced (`blind score --seal`).";
  return "Labels and answers are those that were sealed, and the answers' seal is the one that was announced (" +
         s.announced_seal + ").";
}

std::string blind_text(const BlindScore& s, const std::vector<FigureData>& figures) {
  std::string text = fmt::format(
      "# {}\n\n{} cases were counted; {} others served to calibrate the probabilities. {}, which saw "
      "recordings and data sheets alone. {}"
      "\n\nOne and two effects are counted where the refitted nominal model leaves more than 2 floors. "
      "Named: the effect, or a group that holds it. Taken out: the first step decides again from what it had "
      "found, without the truth among its candidates.\n\n",
      s.name, s.report_cases, s.calibration_cases,
      s.configuration.empty()
          ? "Recordings are those that were sealed, and the answers those of the diagnosis"
          : "Recordings are made by a plant that shares no code with the diagnosis",
      seal_sentence(s));
  text += count_table(s) + size_lines(s) + limits_section(s) + figure_section(figures) + slice_table(s) +
          failures(s);
  return text + fmt::format("\nSHA-256 of the manifest {}, seal of the answers {}.\n\ngapscope {}\n",
                            s.manifest_sha256, s.answers_seal, s.version);
}

}  // namespace
}  // namespace internal::report

void write_blind_report(const std::string& folder, const FigureFormats& formats) {
  const BlindScore score = read_blind_score(folder);
  if (score.of_implants()) {
    const std::vector<internal::report::FigureData> figures = {internal::report::implant_figure(score)};
    internal::report::write_report_files(
        folder, figures,
        internal::report::implant_text(score, figures, internal::report::seal_sentence(score),
                                       internal::report::count_table(score)),
        formats, {"Implants"});
    return;
  }
  const std::vector<internal::report::FigureData> figures = internal::report::blind_figures(score);
  internal::report::write_report_files(folder, figures, internal::report::blind_text(score, figures), formats,
                                       {"Blind check"});
}

}  // namespace gapscope
