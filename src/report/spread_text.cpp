// Several axes of a machine, or units of a drive, in one table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/normal.h"
#include "report/changes_report.h"
#include "report/changes_words.h"

namespace gapscope {
namespace {

constexpr std::size_t kNameWidth = 26, kCellWidth = 20;

/// Of a quantity over the reports that tell it.
struct Spread {
  int told = 0;
  double mean = 0.0;
  double between = kNaN;  ///< standard deviation from report to report, without what the fits add to it
  double within = kNaN;   ///< root mean square of the fits' standard errors
};

Spread spread_of(const DriveQuantity& q) {
  Spread s;
  double squares = 0.0, errors = 0.0;
  for (const Observation& o : q.observed)
    if (std::isfinite(o.value)) ++s.told, s.mean += o.value, errors += o.std * o.std;
  if (s.told == 0) return s;
  s.mean /= s.told;
  s.within = std::sqrt(errors / s.told);
  for (const Observation& o : q.observed)
    if (std::isfinite(o.value)) squares += (o.value - s.mean) * (o.value - s.mean);
  if (s.told > 1) s.between = std::sqrt(std::max(squares / (s.told - 1) - s.within * s.within, 0.0));
  return s;
}

std::string cell(const Observation& o) {
  if (std::isfinite(o.value)) return fmt::format("{:.4g} ± {:.2g}", o.value, kNormal95 * o.std);
  if (std::isfinite(o.at_most)) return fmt::format("< {:.4g}", o.at_most);
  return std::isfinite(o.at_least) ? fmt::format("> {:.4g}", o.at_least) : "-";
}

bool begins_letter(char c) { return (c & 0xc0) != 0x80; }  // in UTF-8

std::string first_letters(const std::string& text, std::size_t most) {
  std::size_t seen = 0, end = 0;
  while (end < text.size() && (seen < most || !begins_letter(text[end])))
    seen += begins_letter(text[end++]) ? 1 : 0;
  return text.substr(0, end);
}

/// Padded by what is seen: ± takes two bytes.
std::string padded(const std::string& text, std::size_t width) {
  const auto seen = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_letter));
  return text + std::string(seen < width ? width - seen : 1, ' ');
}

std::string name_of(const std::string& folder) {
  return std::filesystem::path(folder + "/").lexically_normal().parent_path().filename().string();
}

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.3g}", x) : "-"; }

}  // namespace

std::string spread_text(const DriveChanges& all) {
  std::string text;
  if (all.order == ReportOrder::kUnits) {
    text = internal::report::changes_headline(all) + ".\n";
    for (const std::string& line : internal::report::order_lines(all)) text += "  " + line + "\n";
    text += "\n";
  }
  text += padded("", kNameWidth);
  for (const std::string& report : all.reports)
    text += padded(first_letters(name_of(report), kCellWidth - 1), kCellWidth);
  text += padded("mean", 12) + padded("spread", 12) + "of a fit\n";
  for (const DriveQuantity& q : all.quantities) {
    const Spread s = spread_of(q);
    const char* const from = q.from == "model_free" ? " (free)" : q.from == "answer" ? " (answer)" : "";
    const std::string level = std::isfinite(q.level) ? fmt::format(" ±{:.3g}", q.level) : "";
    text += padded(fmt::format("{}{}{}", q.key, level, from), kNameWidth);
    for (const Observation& o : q.observed) text += padded(cell(o), kCellWidth);
    text += padded(s.told > 0 ? number(s.mean) : "-", 12) + padded(number(s.between), 12) + number(s.within) +
            " " + internal::report::changes_unit(all, q) + "\n";
  }
  return text +
         "± is half of a 95 % interval; spread: standard deviation from one to the next, without what the "
         "fits add to it;\nof a fit: their standard error. (free): model-free.\n";
}

}  // namespace gapscope
