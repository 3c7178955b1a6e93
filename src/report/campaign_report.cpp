#include "report/campaign_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "report/campaign_figures.h"
#include "report/markdown.h"
#include "report/report_files.h"

namespace gapscope {
namespace internal::report {
namespace {

/// "−0.2 % (−0.4 to 0.1 %)"
std::string percent_within(double value, const Interval& ci) {
  if (!std::isfinite(ci.low)) return percent(value);
  return fmt::format("{} ({} to {})", percent(value), percent(ci.low), percent(ci.high));
}

/// Every number of an estimator, each with how many runs it is of.
std::string score_cells(const EstimatorScore& e) {
  const Interval limits = e.claimed > 0 ? wilson(e.covered, e.claimed) : Interval{};
  return fmt::format("| {} of {} | {} | {} | {} | {} | {} | {} | {} | {} |", e.answered, e.runs, e.judged,
                     percent(e.median_error), percent(e.error_90), percent_within(e.bias, e.bias_ci),
                     e.within_5,
                     e.claimed > 0 ? fmt::format("{} of {} ({} to {})", e.covered, e.claimed,
                                                 percent(limits.low), percent(limits.high))
                                   : "–",
                     percent(e.median_width), percent(e.interval_score));
}

constexpr const char* kScoreHead =
    " answers | n judged | median error | 90 % below | bias (95 %) | within 5 % | intervals that hold the "
    "gap (Wilson) | median width | mean interval score |\n";

std::string score_table(const CampaignSummary& s) {
  std::string text =
      fmt::format("| estimator |{}|{}\n", kScoreHead, "---|---|---|---|---|---|---|---|---|---|");
  for (const CampaignEstimator& e : estimators_of(s))
    text += fmt::format("| {} {}\n", e.name, score_cells(s.total.*(e.score)));
  return text;
}

/// Trust, denials and cost.
std::string trust_table(const CampaignSummary& s) {
  std::string text =
      "\n| estimator | trust good, of these hold the gap | denied a gap | off by more than 5 % | passes over "
      "the recording | given of the drive |\n|---|---|---|---|---|---|\n";
  for (const CampaignEstimator& e : estimators_of(s)) {
    const EstimatorScore& score = s.total.*(e.score);
    std::string told = "nothing";
    for (const SummaryTold& t : s.told) {
      if (t.estimator != e.key) continue;
      if (!t.told.empty()) told = fmt::format("{}", fmt::join(t.told, "; or "));
      if (!t.lacks.empty()) told += fmt::format("; its model lacks {}", fmt::join(t.lacks, "; or "));
    }
    text +=
        fmt::format("| {} | {}, {} | {} | {} of {} | {:.0f} | {} |\n", e.name, score.good, score.good_covered,
                    score.denied, score.judged - score.within_5, score.judged, score.passes, told);
  }
  return text;
}

/// On what both answer, so that no one gains by refusing what is hard.
std::string contest_table(const CampaignSummary& s) {
  if (s.contests.empty()) return "";
  std::string text =
      "\n## On the runs that both answer\n\n| both | n | median error of the first | of the second | first "
      "less second (95 %) | first nearer | n with two intervals | disagree | correlation ρ of their errors "
      "(95 %) | disagree by ρ |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const EstimatorPair& p : s.contests) {
    const std::string rho = std::isfinite(p.correlation)
                                ? fmt::format("{:.2f} ({:.2f} to {:.2f})", p.correlation,
                                              p.correlation_ci.low, p.correlation_ci.high)
                                : "–";
    text += fmt::format("| {}, {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", estimator_name(p.first),
                        estimator_name(p.second), p.both, percent(p.first_error), percent(p.second_error),
                        percent_within(p.advantage, p.advantage_ci), p.first_nearer, p.claimed, p.disagree,
                        rho, std::isfinite(p.correlation) ? fmt::format("{}", p.disagree_correlated) : "–");
  }
  return text +
         "\nThey disagree where they differ by more than 1.96 √(σ₁² + σ₂² − 2ρσ₁σ₂): with ρ = 0, as a single "
         "run takes it, and with that of their errors here, as both read the same noise.\n";
}

/// Every setting of an axis with its n.
std::string line_table(const CampaignSummary& s, const SummaryTable& t) {
  const SummaryAxis& axis = s.axes[t.a];
  std::string text = fmt::format("\n| {} | estimator |{}|{}\n", axis.name, kScoreHead,
                                 "---|---|---|---|---|---|---|---|---|---|---|");
  for (const SummaryCell& cell : t.cells)
    for (const CampaignEstimator& e : estimators_of(s))
      text += fmt::format("| {} | {} {}\n", axis.bins[cell.a].label, e.name, score_cells(cell.*(e.score)));
  return text;
}

std::string line_tables(const CampaignSummary& s) {
  std::string text;
  for (const SummaryTable& table : s.lines)
    text += fmt::format("\n## Along the {}\n", s.axes[table.a].name) + line_table(s, table);
  return text;
}

std::string answer_table(const CampaignSummary& s) {
  if (s.answers.empty()) return "";
  std::string text =
      "\n## What is needed\n\nFor at least 90 % of all runs to be within the tolerance (a run without an "
      "answer is not within):\n\n| for at most | of | estimator | needs |\n|---|---|---|---|\n";
  for (const SummaryAnswer& a : s.answers)
    text += fmt::format("| {:g} % | {} | {} | {} |\n", 100.0 * a.tolerance, a.parameters,
                        estimator_name(a.estimator), a.needs);
  return text;
}

std::vector<std::string> lines_of(const std::vector<SummaryCount>& counts) {
  std::vector<std::string> lines;
  for (const SummaryCount& c : counts) lines.push_back(fmt::format("{} runs: {}", c.runs, c.text));
  return lines;
}

}  // namespace

std::vector<CampaignEstimator> estimators_of(const CampaignSummary& s) {
  std::vector<CampaignEstimator> all;
  if (s.literal)
    all.push_back(
        {"literal", "literal", "method as printed", &SummaryCell::literal, literal_style(), Marker::kCircle});
  if (s.model_free)
    all.push_back({"model_free", "model-free", "model-free detector", &SummaryCell::model_free,
                   model_free_style(), Marker::kDisc});
  if (s.reference)
    all.push_back({"reference", "reference", "fitted model", &SummaryCell::reference, reference_style(),
                   Marker::kTriangleUp});
  return all;
}

std::string estimator_name(const std::string& key) { return key == "model_free" ? "model-free" : key; }

std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  const double value = 100.0 * share, size = std::abs(value);
  if (size >= 9.95) return fmt::format("{:.0f} %", value);
  if (size >= 1.0) return fmt::format("{:.1f} %", value);
  if (size == 0.0) return "0 %";
  return size >= 1e-3 ? fmt::format("{:.2g} %", value) : fmt::format("{}0.001 %", value < 0.0 ? "> −" : "< ");
}

std::vector<FigureData> campaign_figures(const CampaignSummary& s) {
  std::vector<FigureData> figures = {campaign_cost(s)};
  for (const SummaryTable& table : s.pairs) figures.push_back(campaign_map(s, table));
  for (const SummaryTable& table : s.lines) figures.push_back(campaign_line(s, table));
  return figures;
}

std::string campaign_text(const CampaignSummary& s, const std::vector<FigureData>& figures) {
  std::string text = fmt::format("# {}\n\n", s.name);
  for (const std::string& line : campaign_verdict(s)) text += "- " + line + "\n";
  text += fmt::format("\n{} runs", s.done);
  if (s.done < s.runs) text += fmt::format(" of {}", s.runs);
  text += s.total.failed > 0 ? fmt::format(", of which {} failed", s.total.failed) : "";
  if (s.repeated > 0)
    text += fmt::format(
        ", of which {} are another one to the last digit: their seeds change nothing, and they are not counted",
        s.repeated);
  text +=
      ". An answer is the gap: a bound is none, nor is a play at zero torque, the first of several gaps, or "
      "a fit that is rejected or did not converge; all but `literal`, which claims none, have an interval. "
      "The interval score is the width and 40 times what the gap lies outside.\n\n" +
      score_table(s) + trust_table(s);
  text += contest_table(s) + answer_table(s) + figure_section(figures) + line_tables(s);
  text += bullet_section("Why the model-free detector gave no gap (# for numbers)", lines_of(s.refusals));
  text += bullet_section("Why runs failed (# for numbers)", lines_of(s.errors));
  return text + fmt::format("\ngapscope {}\n", s.version);
}

}  // namespace internal::report

std::vector<std::string> which_estimator(const CampaignSummary& summary) {
  return internal::report::campaign_verdict(summary);
}

void write_campaign_report(const std::string& folder, const FigureFormats& formats) {
  const CampaignSummary summary = read_campaign_summary(folder);
  const std::vector<internal::report::FigureData> figures = internal::report::campaign_figures(summary);
  internal::report::write_report_files(folder, figures, internal::report::campaign_text(summary, figures),
                                       formats, {summary.name});
}

}  // namespace gapscope
