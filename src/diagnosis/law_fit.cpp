#include "diagnosis/law_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
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

namespace {

ReferenceModel with_law(ReferenceModel model, const LawVariant& v) {
  ModelEffect effect;
  effect.entry = v.entry;
  for (std::size_t i = 0; i < v.entry->parameters.size(); ++i) effect.parameters[i].value = 0.0;
  effect.parameters[0].value = v.abscissa;
  model.effects.push_back(effect);
  return model;
}

void keep_lower(FittedModel& best, FittedModel other) {
  if (costs_less(other, best)) best = std::move(other);
}

}  // namespace

LawWork::LawWork(const Study& study)
    : study_(&study), begun_(study.options.fit.work ? study.options.fit.work->load() : 0) {}

bool LawWork::is_done() const {
  if (finish_requested()) return true;
  if (!(study_->step_work > 0.0)) return false;
  const auto spent = static_cast<double>(*study_->options.fit.work - begun_);
  return study_->has_done_its_work() || spent > study_->step_work;
}

double estimated_in(const ModelEffect& effect) {
  return static_cast<double>(std::count_if(effect.parameters.begin(), effect.parameters.end(),
                                           [](const ParameterSetting& p) { return p.estimate; }));
}

ScoredModel judged(const Study& study, const EffectEntry& law, FittedModel fitted) {
  ScoredModel j = judge(&law, std::move(fitted), study.held_out, study.observer_hz);
  if (std::isfinite(j.score))
    j.score =
        log_score(j.windows) + kMeasure.score_per_parameter * estimated_in(j.fitted.model.effects.back());
  return j;
}

bool costs_less(const FittedModel& a, const FittedModel& b) { return a.mean_cost < b.mean_cost; }

FittedModel fit_from(const Study& study, const FittedModel& from, const reference::RefineEffort& effort) {
  const reference::ModelFit fit(study.train, from.model, study.options.fit, study.observer_hz);
  return fitted_at(fit, fit.refine_with_loads_placed(fit.point_of(from.model, from.starts), effort));
}

LawFit::LawFit(const Study& study, const LawWork& work, const ScoredModel& before, const LawVariant& variant)
    : study_(&study),
      work_(&work),
      variant_(variant),
      origin_(before.fitted),
      fitted_(variant.levels.size()) {
  origin_.model = with_law(origin_.model, variant);
}

void LawFit::tell(Counted& counted) const {
  counted.begin(fmt::format("laying free-form laws over what remains: {}", variant_.entry->name));
}

const FittedModel& LawFit::closest() const {
  return *std::min_element(fitted_.begin(), fitted_.end(), costs_less);
}

void LawFit::race_on(const ReferenceModel& drive) {
  FittedModel origin = origin_;
  origin.model = with_drive(origin.model, drive);
  FittedModel before;
  for (std::size_t i = 0; i < fitted_.size() && !finish_requested(); ++i) {
    FittedModel here = quickly(origin, i);
    if (before.mean_cost < kInfinity) keep_lower(here, quickly(before, i));
    keep_lower(fitted_[i], here);
    before = std::move(here);
  }
}

void LawFit::climb() {
  FittedModel from = origin_;
  double least = kInfinity;
  for (std::size_t i = 0; i < fitted_.size() && !finish_requested(); ++i) {
    FittedModel here = quickly(from, i);
    if (!(here.mean_cost < kInfinity)) return;
    const double score = judged(*study_, *variant_.entry, here).score;
    if (!(score < least)) return;
    least = score;
    fitted_[i] = from = std::move(here);
  }
}

void LawFit::refine() {
  for (std::size_t i = 0; i < fitted_.size() && !work_->is_done(); ++i) {
    FittedModel& here = fitted_[i];
    if (i > 0 && costs_less(fitted_[i - 1], here)) keep_lower(here, quickly(fitted_[i - 1], i));
    if (!(here.mean_cost < kInfinity)) continue;
    settle(here);
    if (!(here.mean_cost < kExplained) && study_->observer_hz < kMeasure.fast_hz)
      keep_lower(here, led_by_faster_observer(*study_, here));
    if (here.mean_cost < kExplained) break;
  }
}

ScoredModel LawFit::best() const {
  ScoredModel best;
  for (const FittedModel& f : fitted_) {
    if (!(f.mean_cost < kInfinity)) continue;
    ScoredModel here = judged(*study_, *variant_.entry, f);
    if (best.entry == nullptr || here.score < best.score) best = std::move(here);
  }
  return best;
}

/// Refines as long as a round takes what is worth having: a curve's values act on each other and on the
/// drive's numbers, and one round ends before they have settled.
void LawFit::settle(FittedModel& here) const {
  for (std::size_t round = 0; round < study_->effort.leaders && !work_->is_done(); ++round) {
    const double worth = (1.0 - kRule.worth_having) * here.mean_cost;
    keep_lower(here, fit_from(*study_, here, {}));
    if (here.mean_cost < kExplained || !(here.mean_cost < worth)) return;
  }
}

FittedModel LawFit::quickly(FittedModel from, std::size_t level) const {
  const LawLevel& l = variant_.levels[level];
  auto& settings = from.model.effects.back().parameters;
  settings[0].estimate = l.period;
  for (std::size_t i = l.first; i <= l.last; ++i) settings[i].estimate = true;
  return fit_from(*study_, from, study_->effort.quick);
}

}  // namespace gapscope::internal::diagnosis
