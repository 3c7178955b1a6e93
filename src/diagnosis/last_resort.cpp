#include "diagnosis/last_resort.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/periodic_torque.h"
#include "diagnosis/step.h"
#include "gapscope/base/parallel.h"
#include "signals/one_body.h"

namespace gapscope::internal::diagnosis {
namespace {

/// How far a law goes: which of its parameters are estimated.
struct Level {
  std::size_t first = 1, last = 0;  ///< those of [first, last]
  bool period = false;              ///< and the first one
};

/// A law and the abscissa that it begins with.
struct Variant {
  const EffectEntry* entry = nullptr;
  bool from_sheet = false;  ///< begins on the drive of the sheet, from which the fitted one may have drifted
  double abscissa = kNaN;   ///< peak speed, peak input or period
  std::vector<Level> levels;  ///< each contains the one before
};

/// Both directions alike, then each on its own.
std::vector<Level> by_direction(const EffectEntry& entry) {
  const std::size_t all = entry.parameters.size() - 1;
  return {{1, (all - 1) / 2, false}, {1, all, false}};
}

/// One harmonic, two, four, six.
std::vector<Level> by_harmonics(bool period) {
  std::vector<Level> levels;
  for (const std::size_t harmonics : {1u, 2u, 4u, 6u}) levels.push_back({1, 2 * harmonics, period});
  return levels;
}

std::vector<Variant> variants_of(const Study& study, const ScoredModel& model) {
  const signals::OneBody rough = signals::as_one_body(study.train);
  const auto played = play_on_train(study, model.fitted.model);
  const EffectEntry &friction = *find_effect("friction_curve"), &input = *find_effect("input_curve"),
                    &position = *find_effect("position_torque");
  std::vector<Variant> variants = {
      {&friction, false, rough.peak_speed, by_direction(friction)},
      {&input, false, rough.peak_input, by_direction(input)},
      {&position, false, study.effort.past_travel * rough.travel, by_harmonics(false)}};
  std::vector<double> lines = given_periods(study.options.known);
  const auto standing = standing_lines(ripples_of(played), study.train);
  if (!standing.empty()) lines.push_back(standing.front().line.periods);
  for (const double n : lines) variants.push_back({&position, false, 2.0 * kPi / n, by_harmonics(true)});
  for (std::size_t i = 0, all = variants.size(); i < all; ++i) {
    variants.push_back(variants[i]);
    variants.back().from_sheet = true;
  }
  const auto& excluded = study.options.excluded;
  std::erase_if(variants, [&](const Variant& v) {
    return std::find(excluded.begin(), excluded.end(), v.entry->name) != excluded.end();
  });
  return variants;
}

ReferenceModel with_law(ReferenceModel model, const Variant& v) {
  ModelEffect effect;
  effect.entry = v.entry;
  for (std::size_t i = 0; i < v.entry->parameters.size(); ++i) effect.parameters[i].value = 0.0;
  effect.parameters[0].value = v.abscissa;
  model.effects.push_back(effect);
  return model;
}

double estimated_in(const ModelEffect& effect) {
  return static_cast<double>(std::count_if(effect.parameters.begin(), effect.parameters.end(),
                                           [](const ParameterSetting& p) { return p.estimate; }));
}

/// Of the law's parameters those count that are estimated.
ScoredModel judged(const Study& study, const EffectEntry& entry, FittedModel fitted) {
  ScoredModel j = judge(&entry, std::move(fitted), study.held_out, study.observer_hz);
  if (std::isfinite(j.score))
    j.score =
        log_score(j.windows) + kMeasure.score_per_parameter * estimated_in(j.fitted.model.effects.back());
  return j;
}

/// A law that was chosen, refined to the end.
ScoredModel polished(const Study& study, ScoredModel law) {
  const reference::ModelFit fit(study.train, law.fitted.model, study.options.fit, study.observer_hz);
  FittedModel fitted =
      fitted_at(fit, fit.refine_with_loads_placed(fit.point_of(law.fitted.model, law.fitted.starts), {}));
  if (!(fitted.mean_cost < law.fitted.mean_cost)) return law;
  ScoredModel better = judged(study, *law.entry, std::move(fitted));
  return better.score < law.score ? better : law;
}

/// As many parameters as pay, each level from where the one before has led.
ScoredModel climbed(const Study& study, const ScoredModel& before, const Variant& v) {
  ScoredModel best;
  const ReferenceModel& drive = before.fitted.model;
  ReferenceModel model = with_law(v.from_sheet ? with_drive(drive, study.sheet) : drive, v);
  std::vector<reference::RecordingStart> starts = before.fitted.starts;
  for (const Level& level : v.levels) {
    auto& settings = model.effects.back().parameters;
    settings[0].estimate = level.period;
    for (std::size_t i = level.first; i <= level.last; ++i) settings[i].estimate = true;
    const reference::ModelFit fit(study.train, model, study.options.fit, study.observer_hz);
    FittedModel fitted = fitted_at(fit, fit.refine(fit.point_of(model, starts), study.effort.quick));
    if (!(fitted.mean_cost < kInfinity)) break;
    ScoredModel here = judged(study, *v.entry, std::move(fitted));
    if (best.entry != nullptr && !(here.score < best.score)) break;
    model = here.fitted.model, starts = here.fitted.starts;
    best = std::move(here);
  }
  return best;
}

}  // namespace

std::string variable_of(const EffectEntry& entry) {
  switch (entry.follows) {
    case ResidualPattern::kSpeed:
    case ResidualPattern::kDirection:
      return "speed";
    case ResidualPattern::kAngle:
      return "position";
    case ResidualPattern::kInput:
      return "input";
    default:
      return "";
  }
}

double full_score(const ScoredModel& model) {
  double parameters = 0.0;
  for (const ModelEffect& e : model.fitted.model.effects) parameters += estimated_in(e);
  return log_score(model.windows) + kMeasure.score_per_parameter * parameters;
}

std::optional<LawSearch> search_last_resort(const Study& study, const ScoredModel& model) {
  if (at_floor(model) || !(model.fitted.mean_cost < kInfinity)) return {};
  LawSearch found;
  found.before = model;
  found.before.entry = nullptr;
  found.before.score = log_score(model.windows);
  study.options.progress("laying free-form laws over what remains");
  const std::vector<Variant> variants = variants_of(study, found.before);
  std::vector<ScoredModel> laws(variants.size());
  parallel_for(variants.size(), study.options.threads,
               [&](std::size_t i) { laws[i] = climbed(study, found.before, variants[i]); });
  std::erase_if(laws, [](const ScoredModel& law) { return law.entry == nullptr; });
  std::stable_sort(laws.begin(), laws.end(),
                   [](const ScoredModel& a, const ScoredModel& b) { return a.score < b.score; });
  if (laws.empty() || !(found.before.score - laws.front().score >= kRule.tells_apart) ||
      !helps(found.before, laws.front(), study.repeats_badly()))
    return {};
  for (const ScoredModel& law : laws)
    if (law.score - laws.front().score < kRule.tells_apart &&
        std::find(found.group.begin(), found.group.end(), law.entry) == found.group.end())
      found.group.push_back(law.entry);
  found.after = polished(study, std::move(laws.front()));
  return found;
}

}  // namespace gapscope::internal::diagnosis
