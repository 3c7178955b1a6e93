#include "campaign/answers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gapscope::internal::campaign {
namespace {

using Score = EstimatorScore SummaryCell::*;
using Within = int EstimatorScore::*;

struct Tolerance {
  double value;
  Within within;
};
constexpr Tolerance kTolerances[] = {
    {0.01, &EstimatorScore::within_1}, {0.02, &EstimatorScore::within_2}, {0.05, &EstimatorScore::within_5}};

bool is_good(const SummaryCell& cell, Score score, Within within) {
  return cell.runs > 0 && (cell.*score).*within >= kGoodShare * cell.runs;
}

bool rises(const std::vector<SummaryBin>& bins) {
  for (std::size_t i = 1; i < bins.size(); ++i)
    if (!(bins[i - 1].value < bins[i].value)) return false;  // also for values that are no numbers
  return !bins.empty() && !std::isnan(bins[0].value);
}

/// For each value of the first axis, which values of the second are good.
std::vector<std::vector<bool>> good_cells(const CampaignSummary& s, const SummaryTable& table, Score score,
                                          Within within) {
  std::vector<std::vector<bool>> good(s.axes[table.a].bins.size(),
                                      std::vector<bool>(s.axes[table.b].bins.size(), false));
  for (const SummaryCell& cell : table.cells) good[cell.a][cell.b] = is_good(cell, score, within);
  return good;
}

/// All values that were tried; of others nothing is known.
std::string every(const SummaryAxis& axis) { return fmt::format("every {} that was tried", axis.name); }

/// Neighbouring values of the first axis that need the same are told together.
std::string needs_over_pair(const CampaignSummary& s, const SummaryTable& table, Score score, Within within) {
  const auto& outer = s.axes[table.a].bins;
  const auto good = good_cells(s, table, score, within);
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end = 0; begin < outer.size(); begin = end) {
    const std::string words = range_in_words(s.axes[table.b].bins, good[begin]);
    for (end = begin; end < outer.size() && good[end] == good[begin];) ++end;
    if (words == "none") continue;
    std::vector<bool> here(outer.size(), false);
    std::fill(here.begin() + static_cast<long>(begin), here.begin() + static_cast<long>(end), true);
    const std::string where = range_in_words(outer, here);
    const std::string what = words == "any" ? every(s.axes[table.b]) : words;
    parts.push_back(where == "any" ? what : what + " with " + where);
  }
  return parts.empty() ? "nothing in this campaign is enough" : fmt::format("{}", fmt::join(parts, "; "));
}

std::string needs_over_line(const CampaignSummary& s, const SummaryTable& table, Score score, Within within) {
  std::vector<bool> good(s.axes[table.a].bins.size(), false);
  for (const SummaryCell& cell : table.cells) good[cell.a] = is_good(cell, score, within);
  const std::string words = range_in_words(s.axes[table.a].bins, good);
  return words == "none"  ? "nothing in this campaign is enough"
         : words == "any" ? every(s.axes[table.a])
                          : words;
}

/// "14" of "14 bit" beside "18 bit"; with its unit beside another one.
std::string without_unit(const std::string& label, const std::string& beside) {
  const std::size_t space = label.rfind(' '), other = beside.rfind(' ');
  const bool same =
      space != label.npos && other != beside.npos && label.substr(space) == beside.substr(other);
  return same ? label.substr(0, space) : label;
}

}  // namespace

std::string range_in_words(const std::vector<SummaryBin>& bins, const std::vector<bool>& good) {
  const auto first = std::find(good.begin(), good.end(), true);
  if (first == good.end()) return "none";
  if (std::find(good.begin(), good.end(), false) == good.end()) return "any";
  const auto after = std::find(first, good.end(), false);
  const bool in_one_piece = std::find(after, good.end(), true) == good.end();
  const auto low = static_cast<std::size_t>(first - good.begin()),
             high = static_cast<std::size_t>(after - good.begin()) - 1;
  if (in_one_piece && rises(bins)) {
    if (high + 1 == bins.size()) return low == high ? bins[low].label : "at least " + bins[low].label;
    if (low == 0) return low == high ? bins[low].label : "at most " + bins[high].label;
    return low == high ? bins[low].label
                       : without_unit(bins[low].label, bins[high].label) + " to " + bins[high].label;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bins.size(); ++i)
    if (good[i]) names.push_back(bins[i].label);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<SummaryAnswer> answers(const CampaignSummary& s) {
  struct Asked {
    const char* key;
    bool asked;
    Score score;
  };
  const Asked estimators[] = {{"literal", s.literal, &SummaryCell::literal},
                              {"model_free", s.model_free, &SummaryCell::model_free},
                              {"reference", s.reference, &SummaryCell::reference}};
  std::vector<SummaryAnswer> all;
  const auto& tables = s.pairs.empty() ? s.lines : s.pairs;
  for (const SummaryTable& table : tables)
    for (const Tolerance& tolerance : kTolerances)
      for (const auto& [key, asked, score] : estimators) {
        if (!asked) continue;
        const bool pair = table.b >= 0;
        all.push_back({tolerance.value, key,
                       pair ? s.axes[table.b].name + " by " + s.axes[table.a].name : s.axes[table.a].name,
                       pair ? needs_over_pair(s, table, score, tolerance.within)
                            : needs_over_line(s, table, score, tolerance.within)});
      }
  return all;
}

}  // namespace gapscope::internal::campaign
