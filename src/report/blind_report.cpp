#include "gapscope/report/blind_report.h"

#include <fmt/format.h>

#include <cmath>

#include "gapscope/results/blind_score.h"
#include "report/blind_figures.h"
#include "report/markdown.h"
#include "report/report_files.h"

namespace gapscope {
namespace internal {
namespace {

std::string percent_of(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : "–";
}

/// "yes", or by how much it is missed; "–" without an aim.
std::string reached(const BlindCount& c) {
  if (!std::isfinite(c.aim)) return "–";
  const bool yes = c.at_most ? c.share() <= c.aim : c.share() >= c.aim;
  return fmt::format("{} {}: {}", c.at_most ? "at most" : "at least", percent_of(c.aim),
                     yes ? "held" : "**missed**");
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
  const auto number = [](double x) { return std::isfinite(x) ? fmt::format("{:.3f}", x) : "–"; };
  return fmt::format(
      "\nShrink of the held-out error, of effects that were named and had at least 3 floors of mismatch: "
      "median {} "
      "(aim 0.97), tenth percentile {} (aim 0.8); of effects whose law is another than the catalogue's, "
      "median {} "
      "(aim 0.9). Effects in a group that the data does not tell apart: median {:g}, mean {:.2f}.\n",
      number(s.shrink_median), number(s.shrink_tenth), number(s.shrink_other_law), s.group_median,
      s.group_mean);
}

/// Cases of the report part that were answered with an effect that is not there, or missed one.
std::string failures(const BlindScore& s) {
  std::string text = "\n## Every case that was not answered right\n\n";
  text +=
      "| case | rig | severity | truth | answer | mismatch, floors | probability "
      "|\n|---|---|---|---|---|---|---|\n";
  const auto number = [](double x, int digits) {
    return std::isfinite(x) ? fmt::format("{:.{}f}", x, digits) : std::string("–");
  };
  for (const ScoredCase& c : s.cases)
    if (c.part == "report" && !c.right)
      text +=
          fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", c.name, c.rig, number(c.severity, 2), c.truth,
                      c.named.empty() ? c.verdict : c.named, number(c.before, 1), number(c.probability, 2));
  return text;
}

std::string blind_text(const BlindScore& s, const std::vector<FigureData>& figures) {
  std::string text = fmt::format(
      "# {}\n\n{} cases were counted; {} others served to calibrate the probabilities. Recordings are made "
      "by a "
      "plant that shares no code with the diagnosis, which saw recordings and data sheets alone; labels were "
      "opened "
      "when the answers were sealed.\n\nOne and two effects are counted where the refitted nominal model "
      "leaves more "
      "than 2 floors. Named: the effect, or a group that holds it. Taken out: the first step decides again "
      "from "
      "what it had found, without the truth among its candidates.\n\n",
      s.name, s.report_cases, s.calibration_cases);
  text += count_table(s) + size_lines(s) + figure_section(figures) + failures(s);
  return text + fmt::format("\nSHA-256 of the manifest {}, seal of the answers {}.\n\ngapscope {}\n",
                            s.manifest_sha256, s.answers_seal, s.version);
}

}  // namespace
}  // namespace internal

void write_blind_report(const std::string& folder) {
  const BlindScore score = read_blind_score(folder);
  const std::vector<internal::FigureData> figures = internal::blind_figures(score);
  internal::write_report_files(folder, figures, internal::blind_text(score, figures));
}

}  // namespace gapscope
