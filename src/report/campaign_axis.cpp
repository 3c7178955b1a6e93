#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/campaign_figures.h"
#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kLongest = 14;  ///< letters of a label that stand side by side

bool has_long_labels(const SummaryAxis& axis) {
  return std::any_of(axis.bins.begin(), axis.bins.end(),
                     [](const SummaryBin& b) { return b.label.size() > kLongest; });
}

/// "N·m/rad" where every label ends with it.
std::string shared_unit(const SummaryAxis& axis) {
  std::string unit;
  for (const SummaryBin& b : axis.bins) {
    const std::size_t space = b.label.find(' ');
    if (space == b.label.npos || space + 1 == b.label.size()) return "";
    const std::string own = b.label.substr(space + 1);
    if (!unit.empty() && own != unit) return "";
    unit = own;
  }
  return unit.find(' ') == unit.npos ? unit : "";
}

std::string letter(std::size_t i) { return std::string(1, static_cast<char>('A' + i % 26)); }

}  // namespace

Axis campaign_axis(const SummaryAxis& axis, const Interval& room) {
  const auto last = static_cast<double>(axis.bins.size()) - 1.0;
  Axis a{literal(axis.name), "", {-room.low, last + room.high}};
  const bool lettered = has_long_labels(axis);
  const std::string unit = lettered ? "" : shared_unit(axis);
  if (!unit.empty()) a.name += " (" + literal(unit) + ")";
  for (std::size_t i = 0; i < axis.bins.size(); ++i) {
    const std::string& label = axis.bins[i].label;
    a.places.push_back(
        {static_cast<double>(i),
         lettered ? letter(i) : literal(label.substr(0, label.find(unit.empty() ? "\n" : " ")))});
  }
  return a;
}

std::string campaign_key(const SummaryAxis& axis) {
  if (!has_long_labels(axis)) return "";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < axis.bins.size(); ++i)
    names.push_back(letter(i) + " " + literal(axis.bins[i].label));
  return fmt::format("{}: {}.", literal(axis.name), fmt::join(names, ", "));
}

}  // namespace gapscope::internal::report
