#include "gapscope/campaign/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

#include "campaign/answers.h"
#include "campaign/axis_names.h"
#include "campaign/score.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "gapscope/campaign/store.h"

namespace gapscope {
namespace {

using internal::campaign::axis_name;
using internal::campaign::Scorer;
using internal::campaign::with_unit;

constexpr int kParts = 6;               // of a range without values of its own
constexpr std::size_t kMostPairs = 10;  // with a figure each
constexpr std::size_t kMostTexts = 8;

/// An axis of the summary and how a value of a row finds its bin.
struct Binning {
  SummaryAxis axis;
  std::size_t place = 0;              ///< in the point of a row
  std::map<std::string, int> listed;  ///< value → bin
  Interval range;
  bool logarithmic = false;

  /// -1: no value of this axis
  int bin_of(const std::string& value) const {
    if (const auto found = listed.find(value); found != listed.end()) return found->second;
    const double v = axis_value(value).number;
    const double share = logarithmic ? std::log(v / range.low) / std::log(range.high / range.low)
                                     : (v - range.low) / (range.high - range.low);
    if (!listed.empty() || std::isnan(share)) return -1;
    return static_cast<int>(std::clamp(share * kParts, 0.0, kParts - 1.0));
  }
};

double at_share(const CampaignAxis& axis, double share) {
  return axis.logarithmic ? axis.range.low * std::pow(axis.range.high / axis.range.low, share)
                          : axis.range.low + share * (axis.range.high - axis.range.low);
}

Binning binning_of(const CampaignAxis& axis, std::size_t place, Coordinates coordinates) {
  const auto [name, unit] = axis_name(axis.path, coordinates);
  Binning b{{axis.path, name, {}}, place, {}, axis.range, axis.logarithmic};
  for (const AxisValue& v : axis.values)
    if (b.listed.emplace(v.yaml, static_cast<int>(b.axis.bins.size())).second)
      b.axis.bins.push_back({std::isnan(v.number) ? v.yaml : with_unit(v.number, unit), v.number});
  if (!axis.values.empty()) return b;
  for (int i = 0; i < kParts; ++i)
    b.axis.bins.push_back({fmt::format("{:.3g} to {}", at_share(axis, static_cast<double>(i) / kParts),
                                       with_unit(at_share(axis, (i + 1.0) / kParts), unit)),
                           at_share(axis, (i + 0.5) / kParts)});
  return b;
}

std::vector<Binning> binnings(const CampaignHeader& header) {
  std::vector<Binning> all;
  for (std::size_t i = 0; i < header.axes.size(); ++i)
    if (!header.axes[i].repeat) all.push_back(binning_of(header.axes[i], i, header.coordinates));
  return all;
}

/// All pairs, sampling × resolution first.
std::vector<std::pair<int, int>> pairs_of(const std::vector<Binning>& axes) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (std::size_t b = a + 1; b < axes.size(); ++b) pairs.emplace_back(a, b);
  const auto is = [&](int i, const char* start) { return axes[i].axis.path.starts_with(start); };
  for (auto& [a, b] : pairs)
    if (is(a, "encoder.") && is(b, "simulation.rate")) std::swap(a, b);
  std::stable_partition(pairs.begin(), pairs.end(), [&](const auto& p) {
    return is(p.first, "simulation.rate") && is(p.second, "encoder.");
  });
  pairs.resize(std::min(pairs.size(), kMostPairs));
  return pairs;
}

/// Scores of one table while rows come in.
class TableScorer {
 public:
  TableScorer(const CampaignHeader& header, int a, int b) : header_(header), a_(a), b_(b) {}

  void add(const CampaignRow& row, const std::vector<int>& bins) {
    const std::pair<int, int> place{bins[a_], b_ < 0 ? -1 : bins[b_]};
    cells_.try_emplace(place, header_.model_free, header_.reference).first->second.add(row);
  }

  SummaryTable table() const {
    SummaryTable t{a_, b_, {}};
    for (const auto& [place, scorer] : cells_) {
      t.cells.push_back(scorer.cell());
      std::tie(t.cells.back().a, t.cells.back().b) = place;
    }
    return t;
  }

 private:
  const CampaignHeader& header_;
  int a_, b_;
  std::map<std::pair<int, int>, Scorer> cells_;
};

/// The bin of each axis that a run falls into.
std::vector<int> bins_of(const CampaignStore& store, const std::vector<Binning>& axes,
                         const CampaignRow& row) {
  std::vector<int> bins;
  for (const Binning& b : axes) {
    bins.push_back(b.bin_of(row.point[b.place]));
    if (bins.back() < 0)
      throw ConfigError(store.file(), fmt::format("run {} has the value {} of {}, expected one of its axis",
                                                  row.run, shown(row.point[b.place]), shown(b.axis.path)));
  }
  return bins;
}

/// The text with its numbers, which differ from run to run, as "#".
std::string without_numbers(const std::string& text) {
  constexpr std::size_t kLongest = 2000;  // which is walked digit by digit
  static const std::regex number(R"(-?\d+(\.\d+)?(e[-+]?\d+)?)");
  return std::regex_replace(text.substr(0, kLongest), number, "#");
}

/// What was said in several runs, in the words of the first of them, by what makes it the same.
using Counts = std::map<std::string, SummaryCount>;

void count(const std::string& what, const std::string& text, Counts& counts) {
  ++counts.try_emplace(what, SummaryCount{text, 0}).first->second.runs;
}

/// The same reason has the same codes, whatever its numbers; stores that were made without codes go by the
/// words.
void count_refusal(const CampaignRow& row, Counts& counts) {
  const std::string text = row.verdict + ": " + without_numbers(row.reason);
  count(row.reason_codes.empty() ? text : row.verdict + ": " + row.reason_codes, text, counts);
}

std::vector<SummaryCount> most_frequent(const Counts& counts) {
  std::vector<SummaryCount> all;
  for (const auto& [what, said] : counts) all.push_back(said);
  std::stable_sort(all.begin(), all.end(), [](const SummaryCount& x, const SummaryCount& y) {
    return x.runs != y.runs ? x.runs > y.runs : x.text < y.text;
  });
  all.resize(std::min(all.size(), kMostTexts));
  return all;
}

}  // namespace

CampaignSummary summarise(const CampaignStore& store) {
  const CampaignHeader& header = store.header();
  const std::vector<Binning> axes = binnings(header);
  Scorer total(header.model_free, header.reference);
  std::vector<TableScorer> lines, pairs;
  for (std::size_t i = 0; i < axes.size(); ++i) lines.emplace_back(header, static_cast<int>(i), -1);
  for (const auto& [a, b] : pairs_of(axes)) pairs.emplace_back(header, a, b);
  Counts refusals, errors;
  store.each([&](CampaignRow& row, const CampaignTiming&) {
    const std::vector<int> bins = bins_of(store, axes, row);
    total.add(row);
    for (auto* tables : {&lines, &pairs})
      for (TableScorer& table : *tables) table.add(row, bins);
    if (!row.error.empty())
      count(without_numbers(row.error), without_numbers(row.error), errors);
    else if (header.model_free && std::isnan(row.gap))
      count_refusal(row, refusals);
  });
  CampaignSummary s;
  s.name = header.name;
  s.version = header.version;
  s.configuration = header.identity;
  s.runs = static_cast<int>(header.runs);
  s.model_free = header.model_free;
  s.reference = header.reference;
  for (const Binning& axis : axes) s.axes.push_back(axis.axis);
  s.total = total.cell();
  s.done = s.total.runs;
  for (const TableScorer& table : lines) s.lines.push_back(table.table());
  for (const TableScorer& table : pairs) s.pairs.push_back(table.table());
  s.refusals = most_frequent(refusals);
  s.errors = most_frequent(errors);
  s.answers = internal::campaign::answers(s);
  return s;
}

}  // namespace gapscope
