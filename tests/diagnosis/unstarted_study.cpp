#include "diagnosis/unstarted_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "diagnosis/law_study.h"

namespace gapscope::test {
namespace {

ReferenceModel without_starts(ReferenceModel sheet) {
  for (ParameterSetting& p : sheet.parameters)
    if (p.estimate) p.value = kNaN;
  return sheet;
}

}  // namespace

StudyRow examine_unstarted(const blind::BlindPair& pair, std::uint64_t seed) {
  auto [d, row] = diagnosed(pair, without_starts(pair.sheet), seed);
  row.shrink = d.mismatch.shrink;
  row.in_group = std::ranges::find(d.group, pair.effect) != d.group.end();
  const double gap = pair.truth.parameters[place::kGap].value;
  row.details = fmt::format("[{}] leaves {:.3g}", fmt::join(d.effects, " "), d.mismatch.remains);
  if (!d.model_gap || !(d.model_gap->value > 0.0)) return row;
  const ModelGap& told = *d.model_gap;
  row.place = "yes";
  if (std::isfinite(told.ci95.low))
    row.covered = told.ci95.low <= gap && gap <= told.ci95.high ? "yes" : "no";
  row.details += fmt::format("; gap {:.5g} [{:.5g}, {:.5g}] of {:.5g} rad", told.value, told.ci95.low,
                             told.ci95.high, gap);
  return row;
}

void print_unstarted(const std::vector<StudyRow>& rows) {
  const auto count = [&](auto is) { return std::count_if(rows.begin(), rows.end(), is); };
  fmt::print("{} drives; named {}, another effect named {}, helps {}, unknown {}, none {}\n", rows.size(),
             count([](const StudyRow& r) { return r.named(); }),
             count([](const StudyRow& r) { return r.wrong(); }),
             count([](const StudyRow& r) { return r.verdict == "helps"; }),
             count([](const StudyRow& r) { return r.verdict == "unknown"; }),
             count([](const StudyRow& r) { return r.verdict == "none"; }));
  fmt::print("gap told of {}; its interval holds {} of {}\n",
             count([](const StudyRow& r) { return r.place == "yes"; }),
             count([](const StudyRow& r) { return r.covered == "yes"; }),
             count([](const StudyRow& r) { return r.covered != "-"; }));
  double seconds = 0.0;
  for (const StudyRow& r : rows) seconds += r.seconds;
  fmt::print("processor time {:.0f} s\n", seconds);
}

}  // namespace gapscope::test
