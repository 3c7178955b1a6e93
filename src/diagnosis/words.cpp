#include "diagnosis/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gapscope {
namespace internal {
namespace {

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string listed(const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) words.push_back(readable(name));
  return fmt::format("{}", fmt::join(words, ", then "));
}

std::string ratio(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g} times the floor", value) : "unknown";
}

std::string effect_sentence(const Diagnosis& d) {
  std::string text = fmt::format("The model lacks {}", listed(d.effects));
  if (d.group.size() > 1) {
    std::vector<std::string> others(d.group.begin() + 1, d.group.end());
    for (std::string& o : others) o = readable(o);
    text += fmt::format(" (this recording cannot tell it from {})", fmt::join(others, " or "));
  }
  if (std::isfinite(d.gap.shrink))
    text += fmt::format(": with it the held-out error shrinks by {:.0f} %", 100.0 * d.gap.shrink);
  return text + fmt::format(", to {}.", ratio(d.gap.remains));
}

std::string unknown_sentence(const Diagnosis& d) {
  std::string text =
      fmt::format("Something is missing that the catalogue does not explain: the held-out error is {}, {}",
                  ratio(d.gap.before / d.gap.floor), d.where.headline);
  if (!d.ranking.empty() && d.ranking.front().rel > 0.0)
    text += fmt::format(
        "; {} comes nearest and closes {:.0f} % of the distance to the floor, which is not enough to blame "
        "it",
        readable(d.ranking.front().effect), 100.0 * std::clamp(d.ranking.front().rel, 0.0, 1.0));
  return text + ".";
}

}  // namespace

std::string sentence_of(const Diagnosis& d, bool) {
  switch (d.verdict) {
    case DiagnosisVerdict::kEffect:
      return effect_sentence(d);
    case DiagnosisVerdict::kNone:
      return fmt::format("Nothing is missing that this recording could show: the held-out error is {}.",
                         ratio(d.gap.before / d.gap.floor));
    case DiagnosisVerdict::kUnknown:
      return unknown_sentence(d);
    case DiagnosisVerdict::kNotRun:
      break;
  }
  return d.sentence;
}

}  // namespace internal

std::string Diagnosis::brief_report() const { return sentence; }

}  // namespace gapscope
