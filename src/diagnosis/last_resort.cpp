#include "diagnosis/last_resort.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "diagnosis/law_fit.h"
#include "diagnosis/motion.h"
#include "diagnosis/place.h"

namespace gapscope::internal::diagnosis {
namespace {

/// All laws over a model.
struct FittedLaws {
  std::vector<ScoredModel> judged;  ///< each with the level that serves best, best first
  FittedModel closest;              ///< the one that leaves least of what was fitted
};

/// Every law with the level that serves best, best first.
std::vector<ScoredModel> ranked(const std::vector<LawFit>& laws) {
  std::vector<ScoredModel> all;
  for (const LawFit& law : laws) all.push_back(law.best());
  std::erase_if(all, [](const ScoredModel& law) { return law.entry == nullptr; });
  std::stable_sort(all.begin(), all.end(),
                   [](const ScoredModel& a, const ScoredModel& b) { return a.score < b.score; });
  return all;
}

std::vector<LawFit> laws_over(const Study& study, const LawWork& work, const ScoredModel& before) {
  std::vector<LawFit> laws;
  for (const LawVariant& v : law_variants(study, before)) laws.emplace_back(study, work, before, v);
  return laws;
}

/// On a drive that is known each law climbs by itself, and the best is refined to the end.
FittedLaws laws_of_known_drive(const Study& study, const ScoredModel& before) {
  const LawWork work(study);
  std::vector<LawFit> laws = laws_over(study, work, before);
  Counted counted(study.options.progress, laws.size());
  parallel_for(laws.size(), study.options.threads, [&](std::size_t i) {
    laws[i].tell(counted);
    laws[i].climb();
  });
  FittedLaws found{ranked(laws), {}};
  if (found.judged.empty()) return found;
  ScoredModel& best = found.judged.front();
  FittedModel refined = fit_from(study, best.fitted, {});
  if (!costs_less(refined, best.fitted)) return found;
  if (ScoredModel better = judged(study, *best.entry, std::move(refined)); better.score < best.score)
    best = std::move(better);
  return found;
}

/// All laws race from the fitted drive, which may have drifted to hide what is missing, and from others. The
/// leader is refined first; the rest then begin on its drive, too, and where it does not explain what was
/// fitted, they are refined as well, unless the work is done.
FittedLaws fitted_laws(const Study& study, const ScoredModel& before,
                       const std::vector<ReferenceModel>& other_drives) {
  const LawWork work(study);
  std::vector<LawFit> laws = laws_over(study, work, before);
  if (laws.empty()) return {};
  Counted counted(study.options.progress, 2 * laws.size());
  parallel_for(laws.size(), study.options.threads, [&](std::size_t i) {
    laws[i].tell(counted);
    laws[i].race_on(before.fitted.model);
    for (const ReferenceModel& drive : other_drives) laws[i].race_on(drive);
  });
  std::stable_sort(laws.begin(), laws.end(),
                   [](const LawFit& a, const LawFit& b) { return costs_less(a.closest(), b.closest()); });
  if (!(laws.front().closest().mean_cost < kInfinity)) return {};
  laws.front().tell(counted);
  laws.front().refine();
  FittedLaws found{{}, laws.front().closest()};
  const bool ends = found.closest.mean_cost < kExplained || work.is_done();
  parallel_for(laws.size() - 1, study.options.threads, [&](std::size_t i) {
    laws[i + 1].tell(counted);
    laws[i + 1].race_on(found.closest.model);
    if (!ends) laws[i + 1].refine();
  });
  for (const LawFit& law : laws)
    if (costs_less(law.closest(), found.closest)) found.closest = law.closest();
  found.judged = ranked(laws);
  return found;
}

/// Whether a law explains what was fitted but not what is held out, which asks for what that leaves open.
bool asks_far_too_little(const Study& study, const FittedLaws& laws) {
  if (!may_fit_half_of_the_held_out(study) || !(laws.closest.mean_cost < kRule.near_floor)) return false;
  const ScoredModel closest = judge(nullptr, laws.closest, study.held_out, study.observer_hz);
  // Its median may lie among windows that move no farther than what was fitted.
  const double typical = std::exp(0.5 * log_score(closest.windows));
  return leaves_far_more_held_out(closest, laws.closest.mean_cost) ||
         typical > kRule.far * std::sqrt(laws.closest.mean_cost);
}

/// S with all that was estimated of the effects counted.
double full_score(const ScoredModel& model) {
  double parameters = 0.0;
  for (const ModelEffect& e : model.fitted.model.effects) parameters += estimated_in(e);
  return log_score(model.windows) + kMeasure.score_per_parameter * parameters;
}

/// A fitted model once more, by what a study fits and holds out.
ScoredModel fitted_and_judged(const Study& study, const ScoredModel& model) {
  return judge(model.entry, fit_near(study.train, model.fitted.model, study.options.fit, study.observer_hz),
               study.held_out, study.observer_hz);
}

/// The model as one that laws are laid over: its score counts no parameters.
ScoredModel as_base(ScoredModel model) {
  model.entry = nullptr;
  model.score = log_score(model.windows);
  return model;
}

/// Lays the laws over the model with the first half of what is held out among what is fitted, too; not where
/// the other half shows a drive at rest, which asks for nothing.
/// @returns whether a law is asked for at all
bool widen(const Study& study, LawSearch& found, FittedLaws& laws) {
  const auto wider = std::make_shared<Study>(study);
  fit_half_of_the_held_out(*wider);
  if (mostly_rests(wider->held_out)) return true;
  found.wider = wider;
  found.before = as_base(fitted_and_judged(*wider, found.before));
  if (at_floor(found.before) || !(found.before.fitted.mean_cost < kInfinity)) return false;
  laws = fitted_laws(*wider, found.before, {study.sheet, laws.closest.model});
  return true;
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

Lead lead_over(const LawSearch& law, const ScoredModel& model) {
  const ScoredModel other = law.wider ? fitted_and_judged(*law.wider, model) : model;
  const double least = kRule.asked_for * other.fitted.mean_cost;
  return {full_score(other) - full_score(law.after), law.after.fitted.mean_cost < least};
}

bool is_series_of(const LawSearch& law, const ModelEffect& effect) {
  const ModelEffect& series = law.after.fitted.model.effects.back();
  if (effect.entry == nullptr || series.entry->side != effect.entry->side) return false;
  if (variable_of(*series.entry) != "position" || variable_of(*effect.entry) != "position") return false;
  const double cycles = 2.0 * kPi / series.parameters.front().value, of_effect = cycles_of(effect);
  const double whole = std::round(cycles / of_effect);
  return whole >= 1.0 && std::abs(cycles - whole * of_effect) < kRule.same_period * of_effect;
}

std::optional<LawSearch> search_last_resort(const Study& study, const ScoredModel& model, bool drive_known) {
  if (at_floor(model) || !(model.fitted.mean_cost < kInfinity) || finish_requested()) return {};
  LawSearch found;
  found.before = as_base(model);
  FittedLaws laws = drive_known ? laws_of_known_drive(study, found.before)
                                : fitted_laws(study, found.before, {study.sheet});
  if (!drive_known && asks_far_too_little(study, laws) && !widen(study, found, laws)) return {};
  if (laws.judged.empty() || finish_requested()) return {};
  ScoredModel& best = laws.judged.front();
  if (!(found.before.score - best.score >= kRule.tells_apart) ||
      !helps(found.before, best, study.repeats_badly()))
    return {};
  for (const ScoredModel& law : laws.judged)
    if (law.score - best.score < kRule.tells_apart &&
        std::find(found.group.begin(), found.group.end(), law.entry) == found.group.end())
      found.group.push_back(law.entry);
  found.after = std::move(best);
  return found;
}

}  // namespace gapscope::internal::diagnosis
