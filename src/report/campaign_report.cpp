#include "gapscope/report/campaign_report.h"

#include <fmt/format.h>

#include <cmath>

#include "report/campaign_figures.h"
#include "report/markdown.h"
#include "report/report_files.h"

namespace gapscope {
namespace internal::report {
namespace {

std::string score_row(const char* name, const EstimatorScore& e) {
  const Interval limits = e.judged > 0 ? wilson(e.covered, e.judged) : Interval{};
  return fmt::format("| {} | {} of {} ({}) | {} | {} | {} | {} ({} to {}) | {} |\n", name, e.answered, e.runs,
                     percent(e.runs > 0 ? 1.0 - e.refusal() : kNaN), percent(e.median_error),
                     percent(e.error_90), percent(e.bias), percent(e.coverage()), percent(limits.low),
                     percent(limits.high), e.denied);
}

std::string score_table(const CampaignSummary& s) {
  std::string text =
      "| estimator | answers | median error | 90 % below | bias | 95 % interval holds the true gap (Wilson "
      "limits) | denied a gap |\n|---|---|---|---|---|---|---|\n";
  for (const CampaignEstimator& e : estimators_of(s)) text += score_row(e.name, s.total.*(e.score));
  return text;
}

std::string answer_table(const CampaignSummary& s) {
  if (s.answers.empty()) return "";
  std::string text =
      "\n## What is needed\n\nFor at least 90 % of all runs to be within the tolerance (a run without an "
      "answer is not within):\n\n| for at most | of | estimator | needs |\n|---|---|---|---|\n";
  for (const SummaryAnswer& a : s.answers)
    text +=
        fmt::format("| {:g} % | {} | {} | {} |\n", 100.0 * a.tolerance, a.parameters, a.estimator, a.needs);
  return text;
}

std::vector<std::string> lines_of(const std::vector<SummaryCount>& counts) {
  std::vector<std::string> lines;
  for (const SummaryCount& c : counts) lines.push_back(fmt::format("{} runs: {}", c.runs, c.text));
  return lines;
}

std::string disagreement(const SummaryCell& total) {
  if (total.both == 0) return "";
  return fmt::format(
      "\nBoth answered in {} runs; in {} of these ({}) they differ beyond their joint uncertainty, and then "
      "the model-free estimate was nearer to the true gap in {}.\n",
      total.both, total.disagree, percent(static_cast<double>(total.disagree) / total.both),
      total.model_free_nearer);
}

}  // namespace

std::vector<CampaignEstimator> estimators_of(const CampaignSummary& s) {
  std::vector<CampaignEstimator> all;
  if (s.model_free)
    all.push_back({"model-free", &SummaryCell::model_free, model_free_style(), Marker::kDisc});
  if (s.reference)
    all.push_back({"reference", &SummaryCell::reference, reference_style(), Marker::kTriangleUp});
  return all;
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  const double value = 100.0 * share, size = std::abs(value);
  if (size >= 9.95) return fmt::format("{:.0f} %", value);
  if (size >= 1.0) return fmt::format("{:.1f} %", value);
  if (size == 0.0) return "0 %";
  return size >= 1e-3 ? fmt::format("{:.2g} %", value) : fmt::format("{}0.001 %", value < 0.0 ? "> −" : "< ");
}

std::vector<FigureData> campaign_figures(const CampaignSummary& s) {
  std::vector<FigureData> figures;
  for (const SummaryTable& table : s.pairs) figures.push_back(campaign_map(s, table));
  for (const SummaryTable& table : s.lines) figures.push_back(campaign_line(s, table));
  return figures;
}

std::string campaign_text(const CampaignSummary& s, const std::vector<FigureData>& figures) {
  std::string text = fmt::format("# {}\n\n{} runs", s.name, s.done);
  if (s.done < s.runs) text += fmt::format(" of {}", s.runs);
  text += s.total.failed > 0 ? fmt::format(", of which {} failed", s.total.failed) : "";
  text += ". An answer is a gap with an interval (of the reference: and converged).\n\n" + score_table(s);
  text += disagreement(s.total) + answer_table(s) + figure_section(figures);
  text += bullet_section("Why the model-free detector gave no gap (# for numbers)", lines_of(s.refusals));
  text += bullet_section("Why runs failed (# for numbers)", lines_of(s.errors));
  return text + fmt::format("\ngapscope {}\n", s.version);
}

}  // namespace internal::report

void write_campaign_report(const std::string& folder, const FigureFormats& formats) {
  const CampaignSummary summary = read_campaign_summary(folder);
  const std::vector<internal::report::FigureData> figures = internal::report::campaign_figures(summary);
  internal::report::write_report_files(folder, figures, internal::report::campaign_text(summary, figures),
                                       formats, {summary.name});
}

}  // namespace gapscope
