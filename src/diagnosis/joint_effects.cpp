#include "diagnosis/joint_effects.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/numbers.h"

namespace gapscope::internal::diagnosis {
namespace {

const EffectEntry* root_of(const EffectEntry* entry) {
  const EffectEntry* simpler = contained_effect(*entry);
  return simpler == nullptr ? entry : simpler;
}

std::vector<std::string> not_told_from(const Diagnosis& d, const EffectEntry* entry) {
  for (const AddedEffect& a : d.added)
    if (a.effect == entry->name) return a.group;
  return {entry->name};
}

bool are_kin(const EffectEntry* a, const Diagnosis& of_a, const EffectEntry* b, const Diagnosis& of_b) {
  return root_of(a) == root_of(b) || contains(not_told_from(of_a, a), b->name) ||
         contains(not_told_from(of_b, b), a->name);
}

bool names_phase(const EffectParameterSpec& spec) {
  return std::string(spec.key).find("phase") != std::string::npos;
}

bool is_free_form(const EffectEntry& entry) {
  return entry.stands_for < 0 && entry.parameters[0].absent != 0.0 &&
         std::isfinite(entry.parameters[0].absent) && entry.parameters.size() > 1;
}

/// With the level of a relative, everything free; of no relation: small, and in the other's shape.
ModelEffect not_there(const ModelEffect& other, const ModelEffect* relative, const ReferenceModel& model) {
  ModelEffect e = other;
  const EffectEntry& entry = *other.entry;
  ParameterSetting& size = e.parameters[0];
  if (relative != nullptr) {
    if (root_of(relative->entry) == root_of(&entry)) size.value = relative->parameters[0].value;
    return e;
  }
  const std::vector<std::size_t> sizes = sizes_of(entry);
  const auto is_size = [&](std::size_t i) { return std::find(sizes.begin(), sizes.end(), i) != sizes.end(); };
  for (std::size_t i = 1; i < entry.parameters.size(); ++i)
    if (!names_phase(entry.parameters[i]) && !is_size(i)) e.parameters[i].estimate = false;
  if (entry.stands_for >= 0) size.value = model.parameters[entry.stands_for].value;
  for (const std::size_t i : sizes)
    if (entry.parameters[i].absent == 0.0)
      e.parameters[i].value *= SearchEffort{}.weaker;  // of nothing at all a phase has no slope
  return e;
}

const ModelEffect* model_effect(const ReferenceModel& model, const EffectEntry* entry) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == entry) return &e;
  return nullptr;
}

const ModelEffect* relative_in(const Diagnosis& there, const EffectEntry* entry, const Diagnosis& of_entry) {
  for (const ModelEffect& e : there.fitted.effects)
    if (are_kin(entry, of_entry, e.entry, there)) return &e;
  return nullptr;
}

JointEffect joint(const ModelEffect& e, const Diagnosis& owner, const Diagnosis& other, bool of_drive) {
  const ModelEffect* same = model_effect(other.fitted, e.entry);
  const ModelEffect* relative = same != nullptr ? same : relative_in(other, e.entry, owner);
  const ModelEffect begun = same != nullptr ? *same : not_there(e, relative, other.fitted);
  JointEffect j;
  j.drive = of_drive ? e : begun, j.simulator = of_drive ? begun : e;
  j.in_drive = of_drive || relative != nullptr;
  j.in_simulator = !of_drive || relative != nullptr;
  j.group = not_told_from(owner, e.entry);
  return j;
}

/// All of the first one's, then those of the second one that are no kin of theirs.
std::vector<JointEffect> preferring(const Diagnosis& first, const Diagnosis& second, bool first_is_drive) {
  std::vector<JointEffect> all;
  for (const ModelEffect& e : first.fitted.effects) all.push_back(joint(e, first, second, first_is_drive));
  for (const ModelEffect& e : second.fitted.effects)
    if (model_effect(first.fitted, e.entry) == nullptr && relative_in(first, e.entry, second) == nullptr)
      all.push_back(joint(e, second, first, !first_is_drive));
  return all;
}

std::vector<std::string> joint_names(const std::vector<JointEffect>& effects) {
  std::vector<std::string> names;
  for (const JointEffect& e : effects) names.emplace_back(e.drive.entry->name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<std::size_t> sizes_of(const EffectEntry& entry) {
  const bool free_form = is_free_form(entry), richer = contained_effect(entry) != nullptr;
  std::vector<std::size_t> sizes;
  if (!free_form) sizes.push_back(0);
  for (std::size_t i = 1; i < entry.parameters.size(); ++i)
    if (entry.parameters[i].absent == 0.0 &&
        (free_form || (richer && entry.parameters[i].scale == Scale::kOne)))
      sizes.push_back(i);
  return sizes;
}

bool is_absent(const ModelEffect& effect) {
  const std::vector<std::size_t> sizes = sizes_of(*effect.entry);
  return std::all_of(sizes.begin(), sizes.end(), [&](std::size_t i) {
    return effect.parameters[i].value == effect.entry->parameters[i].absent;
  });
}

std::vector<std::vector<JointEffect>> joint_effects(const Diagnosis& drive, const Diagnosis& simulator) {
  std::vector<std::vector<JointEffect>> sets = {preferring(drive, simulator, true)};
  std::vector<JointEffect> other = preferring(simulator, drive, false);
  if (joint_names(other) != joint_names(sets.front())) sets.push_back(std::move(other));
  return sets;
}

}  // namespace gapscope::internal::diagnosis
