#include "diagnosis/law_variants.h"

#include <algorithm>

#include "diagnosis/periodic_torque.h"
#include "diagnosis/step.h"
#include "signals/one_body.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Both directions alike, then each on its own.
std::vector<LawLevel> by_direction(const EffectEntry& entry) {
  const std::size_t all = entry.parameters.size() - 1;
  return {{1, (all - 1) / 2, false}, {1, all, false}};
}

/// One harmonic, two, four, six.
std::vector<LawLevel> by_harmonics(bool period) {
  std::vector<LawLevel> levels;
  for (const std::size_t harmonics : {1u, 2u, 4u, 6u}) levels.push_back({1, 2 * harmonics, period});
  return levels;
}

}  // namespace

std::vector<LawVariant> law_variants(const Study& study, const ScoredModel& model) {
  const signals::OneBody rough = signals::as_one_body(study.train);
  const auto played = play_on_train(study, model.fitted.model);
  const EffectEntry &friction = *find_effect("friction_curve"), &input = *find_effect("input_curve"),
                    &position = *find_effect("position_torque");
  std::vector<LawVariant> variants = {
      {&input, rough.peak_input, by_direction(input)},
      {&position, study.effort.past_travel * rough.travel, by_harmonics(false)}};
  for (const double share : kSpeedShares)
    variants.push_back({&friction, share * rough.peak_speed, by_direction(friction)});
  std::vector<double> lines = given_periods(study.options.known);
  const auto standing = standing_lines(ripples_of(played), study.train);
  if (!standing.empty()) lines.push_back(standing.front().line.periods);
  for (const double n : lines) variants.push_back({&position, 2.0 * kPi / n, by_harmonics(true)});
  const auto& excluded = study.options.excluded;
  std::erase_if(variants, [&](const LawVariant& v) {
    return std::find(excluded.begin(), excluded.end(), v.entry->name) != excluded.end();
  });
  return variants;
}

}  // namespace gapscope::internal::diagnosis
