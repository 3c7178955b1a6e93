#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/text.h"
#include "diagnosis/detectable.h"
#include "diagnosis/torque_model.h"
#include "diagnosis/torque_search.h"
#include "torque_view/implanted_ladder.h"

namespace gapscope::internal::diagnosis {
namespace {

namespace view = torque_view;

/// The first parameter that grows or falls with the coefficients.
std::size_t size_of(const view::LeastNamed& least, const view::Drive& drive) {
  const std::vector<double> once = least.law->values(least.theta, least.shape, drive),
                            twice = least.law->values(2.0 * least.theta, least.shape, drive);
  return static_cast<std::size_t>(std::mismatch(once.begin(), once.end(), twice.begin()).first -
                                  once.begin());
}

const char* name_of_law(const view::Law& law) { return *law.effect == '\0' ? law.name : law.effect; }

DetectableEffect told(const EffectEntry& entry, const view::LeastNamed& least, const view::Drive& drive,
                      const char* torque) {
  if (least.exists())
    return detectable_from(entry, least.law->values(least.theta, least.shape, drive), size_of(least, drive),
                           least.torque);
  if (least.said_by_model)
    return not_detectable(entry, "model", "the model's numbers absorb it, whatever its size");
  if (least.hidden_by == nullptr)
    return not_detectable(
        entry, "",
        fmt::format("not even a {} as large as the input's would be clear of what remains", torque));
  return not_detectable(
      entry, name_of_law(*least.hidden_by),
      fmt::format("a {} says it as well, whatever its size", readable(name_of_law(*least.hidden_by))));
}

/// See acts_as_delay().
constexpr const char* kActsAlike = "input_delay";

DetectableEffect without_law(const EffectEntry& entry, const std::vector<DetectableEffect>& others,
                             bool in_budget) {
  const auto delay = std::find_if(others.begin(), others.end(), [](const DetectableEffect& d) {
    return d.effect == kActsAlike && d.can_be_shown();
  });
  if (acts_as_delay(entry) && delay != others.end())
    return not_detectable(entry, kActsAlike, "it acts as an input delay does, and would be named as one");
  if (acts_as_delay(entry)) return not_detectable(entry, kActsAlike, "it acts as an input delay does");
  if (in_budget) return not_detectable(entry, "model", "the error budget has a torque of its kind already");
  if (reads_counts(entry))
    return not_detectable(entry, "", "coarser counts explain nothing of what this model leaves");
  if (contained_effect(entry) != nullptr)
    return not_detectable(entry, contained_effect(entry)->name,
                          "the drive shows nothing that it would change");
  return not_detectable(entry, "", "the torque balance has no law for it");
}

bool is_in(const view::Model& model, const EffectEntry& entry) {
  return std::any_of(model.begin(), model.end(), [&](const view::Term& term) {
    return entry.name == std::string_view(term.law->effect);
  });
}

}  // namespace

std::vector<DetectableEffect> detectable_in_torque(const Study& study, const FirstSearch& found,
                                                   const std::vector<const EffectEntry*>& asked) {
  const view::Budget& budget = *found.budget;
  const ReferenceModel& nominal = found.before.fitted.model;
  view::Drive drive = drive_of(budget.model, budget, nominal);
  const auto another = [](const view::Law& free_form, const view::Law& law) {
    return follows_another(free_form, *find_effect(law.effect));
  };
  view::SplitRecordings data = in_torque(study, nominal);
  data.lines = budget.scales.lines;
  std::vector<view::LeastNamed> laws = view::least_named(data, budget, another);
  if (study.options.known.detectable) {  // takes longer than the diagnosis
    study.options.progress("trying what would have been named");
    view::correct_by_implants(data, budget, laws);
  }
  std::vector<DetectableEffect> detectable;
  for (const EffectEntry* entry : asked)
    for (const view::LeastNamed& least : laws)
      if (entry->name == std::string_view(least.law->effect))
        detectable.push_back(told(*entry, least, drive, study.options.coordinates.torque_word()));
  for (const EffectEntry* entry : asked)
    if (std::none_of(laws.begin(), laws.end(), [&](const view::LeastNamed& least) {
          return entry->name == std::string_view(least.law->effect);
        }))
      detectable.push_back(without_law(*entry, detectable, is_in(budget.model, *entry)));
  return detectable;
}

}  // namespace gapscope::internal::diagnosis
