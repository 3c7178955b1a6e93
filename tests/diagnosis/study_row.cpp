#include "diagnosis/study_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

namespace gapscope::test {
namespace {

using Rows = std::vector<StudyRow>;
using Property = std::function<bool(const StudyRow&)>;

Rows only(const Rows& rows, const Property& property) {
  Rows some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some), property);
  return some;
}

void count(const char* what, const Rows& rows, const Property& property) {
  const auto yes = static_cast<int>(std::count_if(rows.begin(), rows.end(), property));
  const auto all = static_cast<int>(rows.size());
  if (all == 0) return;
  const Interval w = wilson(yes, all);
  fmt::print("{:<44}{:4} of {:4} = {:5.1f} %  [{:.1f}, {:.1f}]\n", what, yes, all, 100.0 * yes / all,
             100.0 * std::max(0.0, w.low), 100.0 * w.high);
}

/// Of those that were named and had a gap of three floors.
std::vector<double> shrinks(const Rows& rows) {
  std::vector<double> values;
  for (const StudyRow& r : rows)
    if (r.named() && r.before >= 3.0 && std::isfinite(r.shrink)) values.push_back(r.shrink);
  return values;
}

bool has_another_law(const StudyRow& r) {
  for (const char* name : {"presliding_friction", "viscous_drift", "load_inertia_variation",
                           "encoder_eccentricity", "gap_eccentricity"})
    if (r.effect == name) return true;
  return false;
}

void print_effects(const Rows& rows) {
  std::map<std::string, Rows> by_effect;
  for (const StudyRow& r : rows) by_effect[r.effect].push_back(r);
  for (const auto& [effect, some] : by_effect) {
    const auto number = [&, &of = some](const Property& p) { return std::count_if(of.begin(), of.end(), p); };
    const auto found = shrinks(some);
    fmt::print("  {:<24} {:3}: first {:3}, named {:3}, wrong {:2}, shrink {:.3f}\n", effect, some.size(),
               number([](const StudyRow& r) { return r.first == r.effect; }),
               number([](const StudyRow& r) { return r.named(); }),
               number([](const StudyRow& r) { return r.wrong(); }), found.empty() ? kNaN : median(found));
  }
}

/// Of those that are told to help only.
void print_helps(const Rows& rows) {
  const Rows told = only(rows, [](const StudyRow& r) { return r.verdict == "helps" && r.covered != "-"; });
  count("helps: next recording's shrink in the interval", told,
        [](const StudyRow& r) { return r.covered == "yes"; });
}

void print_costs(const Rows& rows) {
  std::vector<double> seconds;
  for (const StudyRow& r : rows) seconds.push_back(r.seconds);
  if (!seconds.empty())
    fmt::print("processor time a case: mean {:.1f} s, median {:.1f} s, longest {:.1f} s\n", mean(seconds),
               median(seconds), *std::max_element(seconds.begin(), seconds.end()));
}

}  // namespace

std::string line_of(const StudyRow& r) {
  return fmt::format("{} {} {} {} {:.3f} {} {} {} {} {:.4g} {:.4g} {} {} {} {} {:.3f} {:.1f} | {}", r.seed,
                     r.rig, r.effect, r.excitations, r.severity, r.verdict, r.first, r.in_group ? 1 : 0,
                     r.group, r.before, r.shrink, r.removed, r.place, r.blind_place, r.covered, r.probability,
                     r.seconds, r.details);
}

std::vector<StudyRow> read_rows(const std::string& file) {
  std::ifstream in(file);
  Rows rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream columns(line);
    StudyRow r;
    int in_group = 0;
    std::string before, shrink, probability;  // may be nan
    if (!(columns >> r.seed >> r.rig >> r.effect >> r.excitations >> r.severity >> r.verdict >> r.first >>
          in_group >> r.group >> before >> shrink >> r.removed >> r.place >> r.blind_place >> r.covered >>
          probability >> r.seconds))
      continue;
    r.in_group = in_group != 0;
    if (const std::size_t bar = line.find(" | "); bar != std::string::npos) r.details = line.substr(bar + 3);
    r.before = std::stod(before), r.shrink = std::stod(shrink), r.probability = std::stod(probability);
    rows.push_back(r);
  }
  std::sort(rows.begin(), rows.end(), [](const StudyRow& a, const StudyRow& b) { return a.seed < b.seed; });
  return rows;
}

void print_known(const std::vector<StudyRow>& all) {
  const Rows rows = only(all, [](const StudyRow& r) { return r.relevant(); });
  const Rows named = only(rows, [](const StudyRow& r) { return r.named(); });
  fmt::print("{} cases, {} of them above 2 floors\n", all.size(), rows.size());
  count("first or in the group (96 %)", rows, [](const StudyRow& r) { return r.in_group; });
  count("first (90 %)", rows, [](const StudyRow& r) { return r.first == r.effect; });
  count("named (90 %)", rows, [](const StudyRow& r) { return r.named(); });
  count("wrong name (at most 2 %)", rows, [](const StudyRow& r) { return r.wrong(); });
  std::vector<double> groups;
  for (const StudyRow& r : named) groups.push_back(r.group);
  const std::vector<double> found = shrinks(rows), others = shrinks(only(rows, has_another_law));
  if (!found.empty())
    fmt::print(
        "group: median {:g}, mean {:.2f} (1); shrink: median {:.3f} (0.97), tenth percentile {:.3f} (0.8)\n",
        median(groups), mean(groups), median(found), quantile(found, 0.1));
  if (!others.empty())
    fmt::print("shrink where the law is another than ours: median {:.3f} of {} (0.9)\n", median(others),
               others.size());
  count("truth and look-alikes excluded: not named (93 %)", rows,
        [](const StudyRow& r) { return r.removed != "effect"; });
  count("headline names the place (85 %)", named, [](const StudyRow& r) { return r.place == "yes"; });
  count("headline not told the effect", named, [](const StudyRow& r) { return r.blind_place == "yes"; });
  count("next recording's shrink in the interval",
        only(named, [](const StudyRow& r) { return r.covered != "-"; }),
        [](const StudyRow& r) { return r.covered == "yes"; });
  print_effects(rows);
  print_costs(all);
}

void print_none(const std::vector<StudyRow>& rows) {
  count("none (97 %)", rows, [](const StudyRow& r) { return r.verdict == "none"; });
  count("an effect blamed (at most 1 of 150)", rows, [](const StudyRow& r) { return r.verdict == "effect"; });
  print_costs(rows);
}

void print_steps(const std::vector<StudyRow>& all) {
  const Rows rows = only(all, [](const StudyRow& r) { return r.relevant(); });
  const auto added = [](const StudyRow& r) {
    return r.verdict == "effect" ? 1 + std::count(r.first.begin(), r.first.end(), '+') : 0;
  };
  const auto truths = [](const StudyRow& r) { return 1 + std::count(r.effect.begin(), r.effect.end(), '+'); };
  fmt::print("{} cases, {} of them with each effect above 2 floors without it\n", all.size(), rows.size());
  count("all found (85 %)", rows, [&](const StudyRow& r) { return r.in_group; });
  count("exactly these (75 %; of one effect 90 %)", rows,
        [&](const StudyRow& r) { return r.in_group && added(r) == truths(r); });
  count("a wrong one among them (10 %)", rows, [&](const StudyRow& r) { return added(r) > r.group; });
  count("unknown", rows, [&](const StudyRow& r) { return r.verdict == "unknown"; });
  std::vector<double> ratios;
  for (const StudyRow& r : rows)
    if (r.in_group && added(r) == 2) ratios.push_back(r.probability);
  if (!ratios.empty())
    fmt::print("processor time over that of the first step, two found: median {:.2f}, mean {:.2f} (3)\n",
               median(ratios), mean(ratios));
  print_costs(all);
}

void print_questions(const std::vector<StudyRow>& rows) {
  count("separated on the independent plant (1 sigma)", rows, [](const StudyRow& r) { return r.in_group; });
  for (const StudyRow& r : rows)
    fmt::print("  {:<44} {:<12} predicted {:.3g}, seen {:.3g} sigma\n", r.effect, r.first, r.before,
               r.shrink);
  print_costs(rows);
}

void print_outside(const std::vector<StudyRow>& all) {
  const Rows rows = only(all, [](const StudyRow& r) { return r.relevant(); });
  fmt::print("{} cases, {} of them above 2 floors\n", all.size(), rows.size());
  count("no effect blamed (90 %)", rows, [](const StudyRow& r) { return r.verdict != "effect"; });
  count("unknown", rows, [](const StudyRow& r) { return r.verdict == "unknown"; });
  print_helps(rows);
  print_effects(rows);
  print_costs(all);
}

}  // namespace gapscope::test
