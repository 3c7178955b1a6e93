#include <algorithm>
#include <functional>

#include "base/text.h"
#include "blind/scored_answer.h"
#include "gapscope/plant/effect.h"

namespace gapscope::blind {
namespace {

/// Shares of the held-out error from which an implant shows, and from which it shows clearly.
constexpr double kShows = 0.1, kShowsClearly = 0.3;

double foretold(const ScoredAnswer& s) { return s.label->implant->foretold_share; }

/// One is a special case of the other: friction with a Stribeck dip is Coulomb friction, too.
bool same_family(const std::string& a, const std::string& b) {
  const EffectEntry *one = find_effect(a), *other = find_effect(b);
  if (one == nullptr || other == nullptr) return false;
  return one == other || contained_effect(*one) == other || contained_effect(*other) == one;
}

}  // namespace

bool ScoredAnswer::told() const {
  return std::all_of(label->effects.begin(), label->effects.end(), [&](const std::string& truth) {
    return holds(truth) || contains(answer->alike, truth);
  });
}

bool ScoredAnswer::stranger() const {
  const auto& own = label->implant->own;
  const bool in_a_group =
      std::any_of(label->effects.begin(), label->effects.end(), [&](const std::string& truth) {
        return contains(answer->group, truth) || contains(answer->alike, truth);
      });
  const auto explained = [&](const std::string& effect) {
    const auto same = [&](const std::string& other) { return same_family(effect, other); };
    return std::any_of(label->effects.begin(), label->effects.end(), same) ||
           std::any_of(own.begin(), own.end(), same);
  };
  return answer->verdict == "effect" && !in_a_group &&
         !std::all_of(answer->established.begin(), answer->established.end(), explained);
}

bool ScoredAnswer::as_undisturbed() const {
  std::vector<std::string> now = answer->effects, own = label->implant->undisturbed;
  std::sort(now.begin(), now.end()), std::sort(own.begin(), own.end());
  return now == own;
}

std::vector<BlindCount> count_implants(const std::vector<ScoredAnswer>& cases) {
  using Property = std::function<bool(const ScoredAnswer&)>;
  const auto count = [&](const char* name, const Property& among, const Property& property, double aim,
                         bool at_most = false) {
    BlindCount c{name, 0, 0, aim, at_most};
    for (const ScoredAnswer& s : cases)
      if (s.label->implant && among(s)) ++c.of, c.count += property(s) ? 1 : 0;
    return c;
  };
  const auto told = [](const ScoredAnswer& s) { return s.told(); };
  const auto stranger = [](const ScoredAnswer& s) { return s.stranger(); };
  const auto with = [](double low, double high) {
    return [=](const ScoredAnswer& s) { return s.known() && foretold(s) >= low && foretold(s) < high; };
  };
  std::vector<BlindCount> counts = {
      count("implant with a foretold share of 0.3 or more: named or in the group", with(kShowsClearly, 2.0),
            told, 0.85),
      count("foretold share of 0.1 to 0.3: named or in the group", with(kShows, kShowsClearly), told, 0.5),
      count("foretold share below 0.1: named or in the group", with(-1.0, kShows), told, kNaN),
      count(
          "share not foretold: named or in the group",
          [](const ScoredAnswer& s) { return s.known() && !(foretold(s) >= 0.0); }, told, kNaN),
      count(
          "all cases: an effect called the cause that is neither implanted nor the drive's own",
          [](const ScoredAnswer&) { return true; }, stranger, 0.03, true),
      count(
          "outside the catalogue: the same", [](const ScoredAnswer& s) { return s.outside(); }, stranger,
          kNaN),
      count(
          "no implant: the effects of the recordings as they are",
          [](const ScoredAnswer& s) { return s.none(); },
          [](const ScoredAnswer& s) { return s.as_undisturbed(); }, 1.0)};
  std::erase_if(counts, [](const BlindCount& c) { return c.of == 0; });
  return counts;
}

}  // namespace gapscope::blind
