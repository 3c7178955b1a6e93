#include "campaign/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <set>

#include "base/shown.h"
#include "campaign/answers.h"
#include "campaign/axis_names.h"
#include "campaign/pair_scorer.h"
#include "campaign/score.h"
#include "campaign/store.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

using internal::campaign::axis_name;
using internal::campaign::PairScorer;
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

/// A list of effects by their names, "none" for an empty one; any other text as it is.
std::string in_short(const std::string& yaml) {
  if (yaml == "[]") return "none";
  if (!yaml.starts_with("[")) return yaml;
  static const std::regex name(R"((\w+): ?\{)");
  std::string names;
  for (std::sregex_iterator found(yaml.begin(), yaml.end(), name), end; found != end; ++found)
    names += (names.empty() ? "" : " + ") + (*found)[1].str();
  return names.empty() ? yaml : names;
}

Binning binning_of(const CampaignAxis& axis, std::size_t place, Coordinates coordinates) {
  const auto [name, unit] = axis_name(axis.path, coordinates);
  Binning b{{axis.path, name, {}}, place, {}, axis.range, axis.logarithmic};
  for (const AxisValue& v : axis.values)
    if (b.listed.emplace(v.yaml, static_cast<int>(b.axis.bins.size())).second)
      b.axis.bins.push_back({std::isnan(v.number) ? in_short(v.yaml) : with_unit(v.number, unit), v.number});
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
    cells_.try_emplace(place, header_).first->second.add(row);
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

/// The same reason has the same codes, whatever its numbers. A number of another quantity is none of the gap.
void count_refusal(const CampaignEstimate& e, Counts& counts) {
  if (!e.quantity.empty())
    return count("tells " + e.quantity, "tells another quantity: " + e.quantity, counts);
  const std::string text = e.outcome + ": " + without_numbers(e.reason);
  count(e.reason_codes.empty() ? text : e.outcome + ": " + e.reason_codes, text, counts);
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

/// What a run made of its data, but for its seed; without numbers that no estimator told.
struct Outcome {
  std::string text;
  void operator()(const std::string& name, std::string& value) {
    if (name != "seed" && name != "configuration") text += value + '\n';
  }
  void operator()(const std::string&, double& value) { text += fmt::format("{}\n", value); }
  void operator()(const std::string&, std::optional<bool>& value) {
    text += !value ? "-\n" : *value ? "1\n" : "0\n";
  }
};

/// Finds runs that are another one to the last digit but for what is repeated: such seeds change nothing.
class Repeats {
 public:
  explicit Repeats(const CampaignHeader& header) : header_(header) {}

  bool is_one(CampaignRow& row) {
    if (!row.error.empty() || row.data.empty()) return false;
    Outcome outcome;
    for (std::size_t i = 0; i < header_.axes.size(); ++i)
      if (!header_.axes[i].repeat) outcome.text += row.point[i] + '\n';
    fields(outcome, row);
    return !seen_.insert(std::hash<std::string>()(outcome.text)).second;
  }

 private:
  const CampaignHeader& header_;
  std::set<std::size_t> seen_;
};

/// What each estimator was told, in the order of the runs that told something new.
class ToldThings {
 public:
  void add(const CampaignRow& row) {
    note(row.literal.told, literal_.told);
    note(row.model_free.told, model_free_.told);
    note(row.reference.told, reference_.told);
    note(row.lacks, reference_.lacks);
  }
  std::vector<SummaryTold> of(const CampaignHeader& header) const {
    std::vector<SummaryTold> all;
    if (header.literal) all.push_back(literal_);
    if (header.model_free) all.push_back(model_free_);
    if (header.reference) all.push_back(reference_);
    return all;
  }

 private:
  static void note(const std::string& text, std::vector<std::string>& all) {
    if (!text.empty() && all.size() < kMostTexts && std::find(all.begin(), all.end(), text) == all.end())
      all.push_back(text);
  }
  SummaryTold literal_{"literal", {}, {}}, model_free_{"model_free", {}, {}}, reference_{"reference", {}, {}};
};

/// Every two of those that were asked.
std::vector<PairScorer> contests_of(const CampaignHeader& header) {
  std::vector<PairScorer> all;
  const auto add = [&](bool asked, const char* first, PairScorer::Estimate a, const char* second,
                       PairScorer::Estimate b) {
    if (asked) all.emplace_back(first, a, second, b);
  };
  add(header.model_free && header.reference, "model_free", &CampaignRow::model_free, "reference",
      &CampaignRow::reference);
  add(header.literal && header.model_free, "literal", &CampaignRow::literal, "model_free",
      &CampaignRow::model_free);
  add(header.literal && header.reference, "literal", &CampaignRow::literal, "reference",
      &CampaignRow::reference);
  return all;
}

/// Numbers of every run that are told by their median.
struct Typical {
  std::vector<double> samples, recorded;
};

}  // namespace

CampaignSummary summarise(const CampaignStore& store) {
  const CampaignHeader& header = store.header();
  const std::vector<Binning> axes = binnings(header);
  CampaignSummary s;
  Scorer total(header);
  std::vector<TableScorer> lines, pairs;
  for (std::size_t i = 0; i < axes.size(); ++i) lines.emplace_back(header, static_cast<int>(i), -1);
  for (const auto& [a, b] : pairs_of(axes)) pairs.emplace_back(header, a, b);
  std::vector<PairScorer> contests = contests_of(header);
  Counts refusals, errors;
  Repeats repeats(header);
  ToldThings told;
  Typical typical;
  store.each([&](CampaignRow& row, CampaignTiming&) {
    const std::vector<int> bins = bins_of(store, axes, row);
    ++s.done;
    if (repeats.is_one(row)) return void(++s.repeated);
    total.add(row);
    for (auto* tables : {&lines, &pairs})
      for (TableScorer& table : *tables) table.add(row, bins);
    for (PairScorer& contest : contests) contest.add(row);
    told.add(row);
    if (std::isfinite(row.samples)) {
      typical.samples.push_back(row.samples);
      typical.recorded.push_back(row.recorded);
    }
    if (!row.error.empty())
      count(without_numbers(row.error), without_numbers(row.error), errors);
    else if (header.model_free && !row.model_free.answers.value_or(false))
      count_refusal(row.model_free, refusals);
  });
  s.name = header.name;
  s.version = header.version;
  s.configuration = header.identity;
  s.runs = static_cast<int>(header.runs);
  s.literal = header.literal;
  s.model_free = header.model_free;
  s.reference = header.reference;
  s.samples = median(typical.samples);
  s.recorded = median(typical.recorded);
  s.told = told.of(header);
  for (const Binning& axis : axes) s.axes.push_back(axis.axis);
  s.total = total.cell();
  for (const PairScorer& contest : contests) s.contests.push_back(contest.pair());
  for (const TableScorer& table : lines) s.lines.push_back(table.table());
  for (const TableScorer& table : pairs) s.pairs.push_back(table.table());
  s.refusals = most_frequent(refusals);
  s.errors = most_frequent(errors);
  s.answers = internal::campaign::answers(s);
  return s;
}

CampaignTimes times_of(const CampaignStore& store) {
  std::vector<double> literal, model_free, reference;
  const auto note = [](double time, std::vector<double>& times) {
    if (std::isfinite(time)) times.push_back(time);
  };
  store.each([&](CampaignRow&, CampaignTiming& t) {
    note(t.literal_s, literal);
    note(t.model_free_s, model_free);
    note(t.reference_s, reference);
  });
  return {median(literal), median(model_free), median(reference)};
}

}  // namespace gapscope
