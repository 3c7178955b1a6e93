#include "diagnosis/remark.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/text.h"

namespace gapscope::internal::diagnosis {
namespace {

std::string words_on(double innovation, double free) {
  const double counts = kRule.indistinct;
  if (innovation < -counts && free > counts) return "flatters the predictions, spoils the free runs";
  if (free < -counts && innovation > counts) return "flatters the free runs, spoils the predictions";
  if (std::abs(free) < counts && std::abs(innovation) < counts) return "as without it";
  return "";
}

}  // namespace

std::string remark_on(const ScoredModel& c, const ScoredModel& before) {
  if (!std::isfinite(c.score)) return "the motion with it diverges";
  const std::string words = words_on(mean_log(c.windows.innovation) - mean_log(before.windows.innovation),
                                     mean_log(c.windows.free) - mean_log(before.windows.free));
  if (c.fitted.at_bound.empty()) return words;
  std::vector<std::string> names;
  for (const std::string& key : c.fitted.at_bound) names.push_back(name_of_key(key));
  return fmt::format("{}{}{} at a bound", words, words.empty() ? "" : "; ", fmt::join(names, ", "));
}

}  // namespace gapscope::internal::diagnosis
