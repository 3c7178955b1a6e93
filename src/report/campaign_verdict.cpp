#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/campaign_figures.h"

namespace gapscope::internal::report {
namespace {

/// How many runs it brings within 5 %: that it tells nothing counts as well.
int usable(const SummaryCell& cell, const CampaignEstimator& e) { return (cell.*(e.score)).within_5; }

const CampaignEstimator& best_of(const std::vector<CampaignEstimator>& all, const SummaryCell& cell) {
  return *std::max_element(all.begin(), all.end(),
                           [&](const auto& a, const auto& b) { return usable(cell, a) < usable(cell, b); });
}

/// "the reference, told motor_inertia (1.2 of the plant's); its model lacks contact_adhesion"
std::string told_words(const CampaignSummary& s, const CampaignEstimator& e) {
  const auto about =
      std::find_if(s.told.begin(), s.told.end(), [&](const SummaryTold& t) { return t.estimator == e.key; });
  if (about == s.told.end() || about->told.empty()) return ", given nothing of the drive";
  return fmt::format(", given {}{}", about->told.front(),
                     about->told.size() > 1 ? " (others in other runs)" : "");
}

std::string first_line(const CampaignSummary& s, const std::vector<CampaignEstimator>& all) {
  const CampaignEstimator& best = best_of(all, s.total);
  const EstimatorScore& score = s.total.*(best.score);
  const Interval limits = wilson(score.within_5, score.runs);
  std::vector<std::string> others;
  for (const CampaignEstimator& e : all)
    if (e.key != best.key) others.push_back(fmt::format("the {} in {}", e.in_a_sentence, usable(s.total, e)));
  return fmt::format("Take the {}{}: within 5 % of the gap in {} of {} runs (Wilson {} to {}){}{}.",
                     best.in_a_sentence, told_words(s, best), score.within_5, score.runs, percent(limits.low),
                     percent(limits.high), others.empty() ? "" : "; ", fmt::join(others, ", "));
}

/// "gap 5 mrad, mass ratio 10"
std::string setting(const CampaignSummary& s, const SummaryTable& t, const SummaryCell& c) {
  const auto part = [&](int axis, int bin) {
    return fmt::format("{} {}", s.axes[static_cast<std::size_t>(axis)].name,
                       s.axes[static_cast<std::size_t>(axis)].bins[bin].label);
  };
  return t.b < 0 ? part(t.a, c.a) : part(t.a, c.a) + ", " + part(t.b, c.b);
}

/// Of the only one that was asked.
std::string what_it_needs(const CampaignSummary& s) {
  const auto of_5 = std::find_if(s.answers.begin(), s.answers.end(),
                                 [](const SummaryAnswer& a) { return a.tolerance > 0.04; });
  return of_5 == s.answers.end() ? "No other estimator was asked."
                                 : fmt::format("For at most 5 % in nine runs of ten it needs, of {}: {}.",
                                               of_5->parameters, of_5->needs);
}

/// Where another estimator than the best of all brings more runs within 5 %.
std::string second_line(const CampaignSummary& s, const std::vector<CampaignEstimator>& all) {
  constexpr std::size_t kTold = 3;
  if (all.size() == 1) return what_it_needs(s);
  const auto& tables = s.pairs.empty() ? s.lines : s.pairs;
  if (tables.empty()) return "There is no axis but repeats: nothing says when another one is better.";
  const SummaryTable& table = tables.front();
  const CampaignEstimator& best = best_of(all, s.total);
  struct Better {
    int by;
    std::string words;
  };
  std::vector<Better> better;
  for (const SummaryCell& cell : table.cells) {
    const CampaignEstimator& here = best_of(all, cell);
    if (const int by = usable(cell, here) - usable(cell, best); by > 0)
      better.push_back(
          {by, fmt::format("the {} at {} ({} for {} of {})", here.in_a_sentence, setting(s, table, cell),
                           usable(cell, here), usable(cell, best), cell.runs)});
  }
  const std::string over = table.b < 0 ? s.axes[table.a].name
                                       : fmt::format("{} and {}", s.axes[table.a].name, s.axes[table.b].name);
  if (better.empty())
    return fmt::format("At none of the {} settings of {} does another one bring more runs within 5 %.",
                       table.cells.size(), over);
  std::stable_sort(better.begin(), better.end(),
                   [](const Better& a, const Better& b) { return a.by > b.by; });
  std::vector<std::string> told;
  for (std::size_t i = 0; i < std::min(kTold, better.size()); ++i) told.push_back(better[i].words);
  return fmt::format("Take another at {} of the {} settings of {}: {}{}.", better.size(), table.cells.size(),
                     over, fmt::join(told, "; "), better.size() > kTold ? "; ..." : "");
}

/// "2950", "24", "1": passes over the recording.
std::string third_line(const CampaignSummary& s, const std::vector<CampaignEstimator>& all) {
  std::vector<std::string> costs, risks;
  for (const CampaignEstimator& e : all) {
    const EstimatorScore& score = s.total.*(e.score);
    costs.push_back(fmt::format("{} {:.0f}", e.name, score.passes));
    risks.push_back(fmt::format("{} {} of {}", e.name, score.judged - score.within_5, score.judged));
  }
  return fmt::format(
      "That costs, in passes over a recording of {:.0f} samples (median): {}; and of what each gives as the "
      "gap is off by more than 5 %: {}.",
      s.samples, fmt::join(costs, ", "), fmt::join(risks, ", "));
}

}  // namespace

std::vector<std::string> campaign_verdict(const CampaignSummary& s) {
  const std::vector<CampaignEstimator> all = estimators_of(s);
  const bool judged = std::any_of(
      all.begin(), all.end(), [&](const CampaignEstimator& e) { return (s.total.*(e.score)).judged > 0; });
  if (all.empty()) return {};
  if (!judged) {
    std::vector<std::string> told;
    for (const CampaignEstimator& e : all)
      told.push_back(
          fmt::format("{} {} of {}", e.name, (s.total.*(e.score)).answered, (s.total.*(e.score)).runs));
    return {fmt::format(
        "The true gap is not known, or none was given: which is nearer to it is open. Answers: {}.",
        fmt::join(told, ", "))};
  }
  return {first_line(s, all), second_line(s, all), third_line(s, all)};
}

}  // namespace gapscope::internal::report
