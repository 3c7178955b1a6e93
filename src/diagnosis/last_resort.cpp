#include "diagnosis/last_resort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/counted.h"
#include "diagnosis/law_variants.h"
#include "diagnosis/motion.h"
#include "diagnosis/step.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/parallel.h"

namespace gapscope::internal::diagnosis {
namespace {

ReferenceModel with_law(ReferenceModel model, const LawVariant& v) {
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

bool costs_less(const FittedModel& a, const FittedModel& b) { return a.mean_cost < b.mean_cost; }

void keep_lower(FittedModel& best, FittedModel other) {
  if (costs_less(other, best)) best = std::move(other);
}

FittedModel fit_from(const Study& study, const FittedModel& from, const reference::RefineEffort& effort) {
  const reference::ModelFit fit(study.train, from.model, study.options.fit, study.observer_hz);
  return fitted_at(fit, fit.refine_with_loads_placed(fit.point_of(from.model, from.starts), effort));
}

/// A law over a model: its levels, each as far as it has been fitted.
class LawFit {
 public:
  LawFit(const Study& study, const ScoredModel& before, const LawVariant& variant)
      : study_(&study), variant_(variant), fitted_(variant.levels.size()) {
    origin_ = before.fitted;
    origin_.model = with_law(origin_.model, variant);
  }

  void tell(Counted& counted) const {
    counted.begin(fmt::format("laying free-form laws over what remains: {}", variant_.entry->name));
  }

  /// The level that leaves least of what was fitted.
  const FittedModel& closest() const { return *std::min_element(fitted_.begin(), fitted_.end(), costs_less); }

  /// Every level on the numbers of a drive: without the law, and with that of the level before.
  void race_on(const ReferenceModel& drive) {
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

  /// Level by level on the model's own drive, as long as what is held out asks for more.
  void climb() {
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

  /// Level by level to the end, until one explains what was fitted.
  void refine() {
    for (std::size_t i = 0; i < fitted_.size() && !finish_requested(); ++i) {
      FittedModel& here = fitted_[i];
      if (i > 0 && costs_less(fitted_[i - 1], here)) keep_lower(here, quickly(fitted_[i - 1], i));
      if (!(here.mean_cost < kInfinity)) continue;
      settle(here);
      if (!(here.mean_cost < kExplained) && study_->observer_hz < kMeasure.fast_hz)
        keep_lower(here, led_by_faster_observer(*study_, here));
      if (here.mean_cost < kExplained) break;
    }
  }

  /// With as many parameters as what is held out asks for.
  ScoredModel best() const {
    ScoredModel best;
    for (const FittedModel& f : fitted_) {
      if (!(f.mean_cost < kInfinity)) continue;
      ScoredModel here = judged(*study_, *variant_.entry, f);
      if (best.entry == nullptr || here.score < best.score) best = std::move(here);
    }
    return best;
  }

 private:
  /// Refines as long as a round takes what is worth having: a curve's values act on each other and on the
  /// drive's numbers, and one round ends before they have settled.
  void settle(FittedModel& here) const {
    for (std::size_t round = 0; round < study_->effort.leaders; ++round) {
      const double worth = (1.0 - kRule.part) * here.mean_cost;
      keep_lower(here, fit_from(*study_, here, {}));
      if (here.mean_cost < kExplained || !(here.mean_cost < worth)) return;
    }
  }

  FittedModel quickly(FittedModel from, std::size_t level) const {
    const LawLevel& l = variant_.levels[level];
    auto& settings = from.model.effects.back().parameters;
    settings[0].estimate = l.period;
    for (std::size_t i = l.first; i <= l.last; ++i) settings[i].estimate = true;
    return fit_from(*study_, from, study_->effort.quick);
  }

  const Study* study_;
  LawVariant variant_;
  FittedModel origin_;               ///< the model without the law
  std::vector<FittedModel> fitted_;  ///< of each level
};

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

std::vector<LawFit> laws_over(const Study& study, const ScoredModel& before) {
  std::vector<LawFit> laws;
  for (const LawVariant& v : law_variants(study, before)) laws.emplace_back(study, before, v);
  return laws;
}

/// On a drive that is known each law climbs by itself, and the best is refined to the end.
FittedLaws laws_of_known_drive(const Study& study, const ScoredModel& before) {
  std::vector<LawFit> laws = laws_over(study, before);
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
/// fitted, they are refined as well, unless the work of the search is done.
FittedLaws fitted_laws(const Study& study, const ScoredModel& before,
                       const std::vector<ReferenceModel>& other_drives) {
  std::vector<LawFit> laws = laws_over(study, before);
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
  const bool ends = found.closest.mean_cost < kExplained || study.has_done_its_work();
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
  return {full_score(other) - full_score(law.after),
          law.after.fitted.mean_cost < kRule.asked_for * other.fitted.mean_cost};
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
