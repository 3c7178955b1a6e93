#include "changes/which.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/normal.h"
#include "changes/chance.h"
#include "changes/judge.h"
#include "gapscope/plant/effect.h"

namespace gapscope::internal::changes {
namespace {

using Keys = std::vector<std::string>;

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

/// Where the model leaves more than the encoder, its errors are that much larger.
double misfit(const FitSummary& fit) {
  const double floors = fit.innovation_rmse / fit.floor;
  return std::isfinite(floors) ? std::max(1.0, floors) : 1.0;
}

Observation widened(const FitSummary& fit, const std::string& key) {
  const FittedParameter& p = *fit.find(key);
  Observation o;
  o.value = p.value;
  o.ci95 = {p.value - misfit(fit) * (p.value - p.ci95.low), p.value + misfit(fit) * (p.ci95.high - p.value)};
  return o;
}

}  // namespace

WhichDiffers which_differs(const DriveReport& first, const DriveReport& now) {
  WhichDiffers told;
  if (!is_usable(first) || !is_usable(now)) return told;
  for (const FittedParameter& p : now.reference->parameters)
    if (is_determined(&p) && is_determined(first.reference->find(p.key))) told.compared.push_back(p.key);
  if (told.compared.empty()) return told;
  const auto n = static_cast<double>(told.compared.size());
  told.verdict = WhichVerdict::kNone;
  told.p_same = 1.0;
  for (const std::string& key : told.compared) {
    const Change c = change_between(widened(*first.reference, key), widened(*now.reference, key));
    told.p_same = std::min(told.p_same, n * c.p);
    if (!(n * c.p < kErrorRate)) continue;
    told.verdict = WhichVerdict::kNamed;
    told.numbers.push_back({key, look_alikes(key, told.compared), c.p});
  }
  std::ranges::stable_sort(told.numbers, {}, &DifferingNumber::p);
  return told;
}

}  // namespace gapscope::internal::changes
