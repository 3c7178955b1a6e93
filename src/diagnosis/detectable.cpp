#include "diagnosis/detectable.h"

#include <algorithm>
#include <string_view>

namespace gapscope::internal::diagnosis {
namespace {

std::vector<const EffectEntry*> asked_of(const Study& study, const ReferenceModel& model) {
  std::vector<const EffectEntry*> asked;
  for (const EffectEntry* entry : study.catalogue)
    if (is_candidate(*entry, model)) asked.push_back(entry);
  return asked;
}

/// What comes once per turn where nothing turns.
std::vector<const EffectEntry*> turning_with_nothing(const Study& study, const ReferenceModel& model) {
  std::vector<const EffectEntry*> entries;
  for (const EffectEntry* entry : effect_table())
    if (!study.can_turn(*entry) && !study.is_excluded(*entry) && is_candidate(*entry, model))
      entries.push_back(entry);
  return entries;
}

/// Whether the ladder of the balance, not the score of the motion, decides: see climb() in diagnose.cpp.
bool decided_in_torque(const Study& study, const FirstSearch& found, const ReferenceModel& model) {
  if (!found.budget || !found.budget->says_most) return false;
  return study.repeats_badly() ||
         !at_floor(judge(nullptr, {model, {}, 0.0, {}}, study.held_out, study.observer_hz));
}

}  // namespace

DetectableEffect not_detectable(const EffectEntry& entry, std::string hidden_by, std::string why) {
  const EffectParameterSpec& size = entry.parameters.front();
  return {entry.name, {size.key, size.unit, kNaN}, {}, std::move(hidden_by), std::move(why), kNaN};
}

DetectableEffect detectable_from(const EffectEntry& entry, const std::vector<double>& values,
                                 std::size_t size_at, double torque) {
  DetectableEffect d;
  d.effect = entry.name, d.torque = torque;
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const EffectParameterSpec& spec = entry.parameters[i];
    if (i == size_at)
      d.smallest = {spec.key, spec.unit, values[i]};
    else if (spec.key != std::string_view("phase_rad") && values[i] != 0.0)
      d.at.push_back({spec.key, spec.unit, values[i]});
  }
  return d;
}

void tell_detectable(const Study& study, const FirstSearch& found, Diagnosis& d) {
  study.options.progress("foretelling what would have been named");
  const std::vector<const EffectEntry*> asked = asked_of(study, d.fitted);
  d.detectable = decided_in_torque(study, found, d.fitted) ? detectable_in_torque(study, found, asked)
                                                           : detectable_in_motion(study, d.fitted, asked);
  for (const EffectEntry* entry : turning_with_nothing(study, d.fitted))
    d.detectable.push_back(
        not_detectable(*entry, "", "it goes with an angle, and this drive moves along a line"));
  std::stable_sort(d.detectable.begin(), d.detectable.end(),
                   [](const DetectableEffect& a, const DetectableEffect& b) { return a.effect < b.effect; });
}

}  // namespace gapscope::internal::diagnosis
