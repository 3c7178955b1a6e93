#include "changes/which.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "changes/judge.h"
#include "changes/two_groups.h"
#include "gapscope/plant/effect.h"

namespace gapscope::internal::changes {
namespace {

using Keys = std::vector<std::string>;

/// A difference that moves the motion by less is none that can be told from the errors of the simulation,
/// however many samples average over it [floor, rms]. Of 101 numbers that had
/// changed (`study_changes pairs 100229 120`) the least moved it by 0.34: half and double would have named
/// the same.
constexpr double kSeen = 0.1;

/// What one fit leaves over what the other does, beyond which something acts in one of them alone. As much as
/// leaves a model behind (FitOptions::rejected_ratio); recordings twice as large leave at most twice as much.
constexpr double kCame = 3.0;

bool is_usable(const DriveReport& r) {
  return r.reference && !r.reference->rejected() && r.reference->converged();
}

bool is_determined(const FittedParameter* p) {
  return p != nullptr && p->estimated && p->identifiable && !p->at_bound && p->ci95.high > p->ci95.low;
}

/// Numbers of the drive that one encoder hardly tells from an effect, as the effects say of each other.
const std::map<std::string, Keys>& alike_numbers() {
  static const std::map<std::string, Keys> alike = {
      {"motor_damping", {"motor_coulomb_friction"}},
      {"load_damping", {"load_coulomb_friction"}},
      {"load_coulomb_friction", {"load_damping"}},
      {"contact_stiffness", {"contact_hardening"}},
      {"mass_ratio", {"motor_inertia"}},
      {"motor_coulomb_friction", {"motor_damping"}},
  };
  return alike;
}

/// "cogging_torque" of "cogging_torque.amplitude_nm".
std::string cause_of(const std::string& key) { return key.substr(0, key.find('.')); }

/// What acts alike and is not determined by both fits, so that nothing tells it apart here.
Keys look_alikes(const std::string& key, const Keys& compared) {
  const std::string cause = cause_of(key);
  Keys alike;
  if (const auto found = alike_numbers().find(cause); found != alike_numbers().end()) alike = found->second;
  if (const EffectEntry* effect = find_effect(cause))
    alike.insert(alike.end(), effect->look_alikes.begin(), effect->look_alikes.end());
  std::erase_if(alike, [&](const std::string& other) {
    return std::ranges::any_of(compared, [&](const std::string& k) { return cause_of(k) == other; });
  });
  return alike;
}

Observation widened(const FitSummary& fit, const std::string& key) {
  const FittedParameter& p = *fit.find(key);
  Observation o;
  o.value = p.value;
  o.ci95 = {p.value - misfit(fit) * (p.value - p.ci95.low), p.value + misfit(fit) * (p.ci95.high - p.value)};
  return o;
}

/// Numbers whose difference is beyond chance whatever else differs, the surest first; gives `p_same`, too.
std::vector<DifferingNumber> beyond_chance(const FitSummary& first, const FitSummary& now, double rate,
                                           WhichDiffers& told) {
  const auto n = static_cast<double>(told.compared.size());
  std::vector<DifferingNumber> numbers;
  told.p_same = 1.0;
  for (const std::string& key : told.compared) {
    const Change c = change_between(widened(first, key), widened(now, key));
    told.p_same = std::min(told.p_same, n * c.p);
    if (n * c.p < rate) numbers.push_back({key, look_alikes(key, told.compared), c.p});
  }
  std::ranges::stable_sort(numbers, {}, &DifferingNumber::p);
  return numbers;
}

TwoGroups::Differ those(const std::vector<DifferingNumber>& numbers, const Keys& compared) {
  TwoGroups::Differ differ;
  for (const std::string& key : compared)
    differ.push_back(std::ranges::find(numbers, key, &DifferingNumber::key) != numbers.end());
  return differ;
}

/// How far the motion moves by what the second joint fit can explain and the first cannot [floor].
double seen_by(double off_without, double off_with) {
  return std::sqrt(std::max(0.0, off_without * off_without - off_with * off_with));
}

/// Drops the numbers without which a joint fit foretells what it has not seen as well, the least one first.
void keep_what_is_seen(const TwoGroups& groups, WhichDiffers& told) {
  while (!told.numbers.empty()) {
    const TwoGroups::Differ named = those(told.numbers, told.compared);
    const double off = groups.held_out(named);
    if (!std::isfinite(off)) return;
    std::vector<double> seen;
    for (const DifferingNumber& n : told.numbers) {
      TwoGroups::Differ without = named;
      const auto place = std::ranges::find(told.compared, n.key) - told.compared.begin();
      without[static_cast<std::size_t>(place)] = false;
      seen.push_back(seen_by(groups.held_out(without), off));
    }
    const auto least = std::ranges::min_element(seen);
    if (*least >= kSeen) return;
    told.numbers.erase(told.numbers.begin() + (least - seen.begin()));
  }
}

/// What else differs where those named do not explain all.
void look_for_rest(const TwoGroups& groups, double rate, WhichDiffers& told) {
  const TwoGroups::Differ named = those(told.numbers, told.compared);
  told.p_rest = groups.p_if_only(named);
  if (!(told.p_rest < rate) || seen_by(told.off_named, told.off_free) < kSeen) return;
  told.verdict = told.numbers.empty() ? WhichVerdict::kUntold : WhichVerdict::kMore;
  for (std::size_t i = 0; i < named.size(); ++i) {
    TwoGroups::Differ with = named;
    if (with[i]) continue;
    with[i] = true;
    if (groups.p_if_only(with) >= rate && !(groups.held_out(with) >= told.off_named))
      told.one_of.push_back(told.compared[i]);
  }
}

/// What a fit leaves, no less than the encoder does [rad].
double left_by(const FitSummary& fit) { return std::max(fit.innovation_rmse, fit.floor); }

bool differ_in_structure(const FitSummary& first, const FitSummary& now) {
  const double a = left_by(first), b = left_by(now);
  const FitSummary& worse = a > b ? first : now;
  return std::max(a, b) > kCame * std::max(std::min(a, b), worse.floor);
}

}  // namespace

WhichDiffers which_differs(const DriveReport& first, const DriveReport& now) {
  WhichDiffers told;
  if (!first.reference || !now.reference) return told;
  told.left_first = left_by(*first.reference) / first.reference->floor;
  told.left_now = left_by(*now.reference) / now.reference->floor;
  if (differ_in_structure(*first.reference, *now.reference)) {
    told.verdict = WhichVerdict::kStructure;
    return told;
  }
  if (!is_usable(first) || !is_usable(now)) return told;
  for (const FittedParameter& p : now.reference->parameters)
    if (is_determined(&p) && is_determined(first.reference->find(p.key))) told.compared.push_back(p.key);
  if (told.compared.empty()) return told;
  const TwoGroups groups(*first.reference, *now.reference, told.compared);
  const TwoGroups::Differ none(told.compared.size(), false), all(told.compared.size(), true);
  const double together = groups.p_if_only(none);
  const double rate = std::isfinite(together) ? 0.5 * kErrorRate : kErrorRate;  // half for either question
  told.numbers = beyond_chance(*first.reference, *now.reference, rate, told);
  keep_what_is_seen(groups, told);
  told.verdict = told.numbers.empty() ? WhichVerdict::kNone : WhichVerdict::kNamed;
  told.off_shared = groups.held_out(none), told.off_free = groups.held_out(all);
  told.off_named = groups.held_out(those(told.numbers, told.compared));
  if (!std::isfinite(together)) return told;
  told.p_same = std::min(1.0, 2.0 * std::min(told.p_same, together));
  look_for_rest(groups, rate, told);
  return told;
}

}  // namespace gapscope::internal::changes
