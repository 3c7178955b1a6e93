#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "blind/expected_place.h"
#include "blind/scored_answer.h"

namespace gapscope::blind {
namespace {

using CountedCases = std::vector<ScoredAnswer>;
using Property = std::function<bool(const ScoredAnswer&)>;

BlindCount count(const char* name, const CountedCases& cases, const Property& among, const Property& property,
                 double aim = kNaN, bool at_most = false) {
  BlindCount c{name, 0, 0, aim, at_most};
  for (const ScoredAnswer& s : cases) {
    if (!s.reported() || !among(s)) continue;
    ++c.of;
    c.count += property(s) ? 1 : 0;
  }
  return c;
}

bool seen_known(const ScoredAnswer& s) { return s.known() && s.seen(); }
bool seen_outside(const ScoredAnswer& s) { return s.outside() && s.seen(); }
bool seen_pair(const ScoredAnswer& s) { return s.pair() && s.seen(); }

/// Without the truth: whether another effect is blamed.
bool blames_another(const ScoredAnswer& s) {
  return decide_again(s.answer->evidence, truth_of(s, false)).accepted;
}
bool blames_a_stranger(const ScoredAnswer& s) {
  return decide_again(s.answer->evidence, truth_of(s, true)).accepted;
}

void add_known(const CountedCases& cases, std::vector<BlindCount>& counts) {
  counts.push_back(count(
      "one effect: first or in the group", cases, seen_known,
      [](const ScoredAnswer& s) { return s.in_group(); }, 0.96));
  counts.push_back(count(
      "one effect: first of the ranking", cases, seen_known,
      [](const ScoredAnswer& s) { return s.place() == 0; }, 0.9));
  counts.push_back(count("one effect: among the first three", cases, seen_known,
                         [](const ScoredAnswer& s) { return s.place() < 3; }));
  counts.push_back(count(
      "one effect: named", cases, seen_known, [](const ScoredAnswer& s) { return s.named(); }, 0.9));
  counts.push_back(count(
      "one effect: named, and no other", cases, seen_known, [](const ScoredAnswer& s) { return s.right(); },
      0.9));
  counts.push_back(count(
      "one effect: another one named", cases, seen_known, [](const ScoredAnswer& s) { return s.wrong(); },
      0.02, true));
  counts.push_back(count(
      "one effect, named: the headline names its place", cases,
      [](const ScoredAnswer& s) { return seen_known(s) && s.named(); },
      [](const ScoredAnswer& s) {
        return names_the_place(s.answer->where, s.label->effects.front(), s.label->cycles_per_turn);
      },
      0.85));
}

}  // namespace

std::vector<BlindCount> count_answers(const CountedCases& cases) {
  std::vector<BlindCount> counts;
  add_known(cases, counts);
  const auto none = [](const ScoredAnswer& s) { return s.none(); };
  const auto blamed = [](const ScoredAnswer& s) { return s.blamed(); };
  counts.push_back(count(
      "no effect: none", cases, none, [](const ScoredAnswer& s) { return s.answer->verdict == "none"; },
      0.97));
  counts.push_back(count("no effect: one blamed", cases, none, blamed, 1.0 / 150.0, true));
  counts.push_back(count(
      "outside the catalogue: unknown", cases, seen_outside,
      [](const ScoredAnswer& s) { return s.claims_no_cause(); }, 0.9));
  counts.push_back(count("outside the catalogue: an effect blamed", cases, seen_outside, blamed));
  counts.push_back(count("truth taken out: another effect blamed", cases, seen_known, blames_another));
  counts.push_back(count("truth and look-alikes taken out: no other effect blamed", cases, seen_known,
                         std::not_fn(blames_a_stranger), 0.93));
  counts.push_back(count(
      "two effects: both named", cases, seen_pair,
      [](const ScoredAnswer& s) { return s.blamed() && s.found() == s.label->effects.size(); }, 0.85));
  counts.push_back(count(
      "two effects: these and no other", cases, seen_pair, [](const ScoredAnswer& s) { return s.right(); },
      0.75));
  counts.push_back(count(
      "two effects: a wrong one among those named", cases, seen_pair,
      [](const ScoredAnswer& s) { return s.standing() > s.found(); }, 0.1, true));
  std::erase_if(counts, [](const BlindCount& c) { return c.of == 0; });
  return counts;
}

namespace {

const char* severity_range(double severity) {
  if (!std::isfinite(severity)) return "not known";
  return severity < 1.0 / 3.0 ? "0 to 1/3" : severity < 2.0 / 3.0 ? "1/3 to 2/3" : "2/3 to 1";
}

BlindSlice slice(const CountedCases& cases, const std::string& by, const std::string& name,
                 const std::function<std::string(const ScoredAnswer&)>& key) {
  BlindSlice out{by, name, 0, 0, 0, 0, 0, kNaN};
  std::vector<double> shrinks;
  for (const ScoredAnswer& s : cases) {
    if (!s.reported() || !s.known() || key(s) != name) continue;
    ++out.cases;
    if (!s.seen()) continue;
    ++out.seen;
    out.first += s.place() == 0 ? 1 : 0;
    out.named += s.named() ? 1 : 0;
    out.wrong += s.wrong() ? 1 : 0;
    if (s.named() && s.answer->evidence.before() >= 3.0 && std::isfinite(s.answer->shrink))
      shrinks.push_back(s.answer->shrink);
  }
  if (!shrinks.empty()) out.shrink = median(shrinks);
  return out;
}

}  // namespace

std::vector<BlindSlice> slice_answers(const CountedCases& cases) {
  std::vector<BlindSlice> slices;
  const auto add = [&](const char* by, const std::function<std::string(const ScoredAnswer&)>& key) {
    std::set<std::string> names;
    for (const ScoredAnswer& s : cases)
      if (s.reported() && s.known()) names.insert(key(s));
    for (const std::string& name : names) slices.push_back(slice(cases, by, name, key));
  };
  add("rig", [](const ScoredAnswer& s) { return s.label->rig; });
  add("severity", [](const ScoredAnswer& s) { return std::string(severity_range(s.label->severity)); });
  add("effect", [](const ScoredAnswer& s) { return s.label->effects.front(); });
  return slices;
}

}  // namespace gapscope::blind
