#pragma once

#include <fmt/format.h>

#include <cmath>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::test {

/// "friction! 0.3 [0.2, 0.4], delay 1 [-1, 3]": what was added, causes that are established marked, each with
/// those of its numbers that have an interval.
inline std::string added_in_words(const Diagnosis& d) {
  std::string text;
  for (const AddedEffect& a : d.added) {
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", a.effect, a.established ? "!" : "");
    for (const NamedValue& p : a.parameters)
      if (!std::isnan(p.ci95.low))
        text += fmt::format(" {} {:.3g} [{:.3g}, {:.3g}]", p.key, p.value, p.ci95.low, p.ci95.high);
  }
  return text;
}

}  // namespace gapscope::test
