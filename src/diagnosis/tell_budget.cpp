#include "diagnosis/tell_budget.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/rule.h"
#include "gapscope/base/statistics.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

namespace view = torque_view;

/// Shrink of an rms that a share of the mean square stands for, above a floor.
double shrink_by(double share, double before, double floor) {
  const double after = before * std::sqrt(std::max(0.0, 1.0 - share));
  return before > floor ? (before - after) / (before - floor) : kNaN;
}

Interval inflated(const Interval& interval, double about) {
  return {about - kTelling.inflation * (about - interval.low),
          about + kTelling.inflation * (interval.high - about)};
}

/// What the choice of a rung leaves of what there was before it.
double before_of(const view::Budget& budget, std::size_t rung) {
  return rung == 0 ? budget.nominal_rms : budget.rungs[rung - 1].rms;
}

const view::Share* share_of(const view::Budget& budget, const view::Term& term) {
  const auto at = std::find_if(budget.shares.begin(), budget.shares.end(),
                               [&](const view::Share& s) { return is_of(s, term); });
  return at == budget.shares.end() ? nullptr : &*at;
}

/// Whether a line of the balance, whose period was searched, is the effect of that name in a model: of its
/// period or a harmonic of it. The balance sees slow torques alone, and takes for the line of a fast detent
/// what comes down into its band.
bool is_line_of(const view::Term& term, const ReferenceModel& model) {
  if (!term.law->line || term.law->shape_at < 0) return true;
  const auto has_the_name = [&](const ModelEffect& e) {
    return e.entry->name == std::string(term.law->effect);
  };
  const auto effect = std::ranges::find_if(model.effects, has_the_name);
  if (effect == model.effects.end()) return true;
  const double ratio = term.shape / effect->parameters[term.law->shape_at].value;
  const double times = std::max(ratio, 1.0 / ratio);
  const double harmonic = std::clamp(std::round(times), 1.0, 3.0);  // the cogging's law has three
  return std::abs(times - harmonic) < kRule.same_period * harmonic;
}

BudgetRung rung_of(const view::Budget& budget, std::size_t i, const Diagnosis& d) {
  const view::Candidate& choice = budget.rungs[i].choice();
  BudgetRung rung;
  rung.law = choice.law->name;
  rung.effect = choice.law->effect;
  rung.added = contains(d.effects, rung.effect) && is_line_of(choice.model.back(), d.fitted);
  rung.before = before_of(budget, i), rung.after = budget.rungs[i].rms;
  rung.share = choice.evidence.share;
  rung.share_ci95 = choice.evidence.interval;
  if (std::string rival = rival_of(budget.rungs[i]); !rival.empty()) rung.rivals.push_back(std::move(rival));
  if (choice.law->line)
    rung.period = 2.0 * kPi / (choice.model.back().shape * std::max(1, choice.law->harmonic));
  if (const view::Share* share = share_of(budget, choice.model.back()))
    rung.alone = share->alone.share, rung.last = share->last.share;
  return rung;
}

/// Whether a model with these effects has this one, or one that contains it.
bool has(const std::vector<std::string>& effects, const std::string& effect) {
  return std::any_of(effects.begin(), effects.end(), [&](const std::string& e) {
    const EffectEntry* entry = find_effect(e);
    return e == effect || (entry != nullptr && entry->contains != nullptr && entry->contains == effect);
  });
}

/// What a model with the effects that were added leaves, as far as the budget has one.
struct CountedModel {
  double rms = kNaN;
  std::vector<std::string> effects;  ///< of those that were added
};

/// The model without the laws that nobody can add; where one of the others was not added either, the budget
/// down to that one.
CountedModel counted_of(const view::Budget& budget, const std::vector<std::string>& added,
                        const ReferenceModel& fitted) {
  CountedModel counted{budget.addable_rms, {}};
  bool all = true;
  for (std::size_t i = budget.nominal.size(); i < budget.addable.size(); ++i) {
    counted.effects.emplace_back(budget.addable[i].law->effect);
    all = all && has(added, counted.effects.back()) && is_line_of(budget.addable[i], fitted);
  }
  if (all) return counted;
  counted = {budget.nominal_rms, {}};
  for (const view::Rung& rung : budget.rungs) {
    if (!rung.helps || !has(added, rung.choice().law->effect)) break;
    if (!is_line_of(rung.choice().model.back(), fitted)) break;
    counted.rms = rung.rms;
    counted.effects.emplace_back(rung.choice().law->effect);
  }
  return counted;
}

/// Whether the balance of slow torques leaves much where the simulated motion is at the encoder's floor and
/// an observer has next to nothing to correct, or where its own floor is far below: then it does not know
/// this drive (a delay and friction of a quick motion are no slow torques, nor is friction that holds at each
/// reversal), and what it leaves is not what the model lacks.
bool is_refuted_by_motion(const Diagnosis& d) {
  const double least = kTelling.clearly_more;
  const double left = d.budget.with_effects, floor = d.budget.floor();
  return d.mismatch.remains < kRule.floor_ratio &&
         (left > least * d.mismatch.after_torque || (floor > 0.0 && left > least * floor));
}

double or_zero(double value) { return std::isnan(value) ? 0.0 : value; }

}  // namespace

std::vector<NamedValue> effect_values(const ModelEffect& effect) {
  std::vector<NamedValue> values;
  for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i) {
    const EffectParameterSpec& spec = effect.entry->parameters[i];
    double value = effect.parameters[i].value;
    if (spec.key == std::string("phase_rad")) value = std::remainder(value, 2.0 * kPi);
    values.push_back({spec.key, spec.unit, value});
  }
  return values;
}

std::vector<NamedValue> values_in(const ReferenceModel& model, const EffectEntry& entry) {
  const ModelEffect* found = nullptr;
  for (const ModelEffect& e : model.effects)
    if (e.entry == &entry || (found == nullptr && contained_effect(*e.entry) == &entry)) found = &e;
  return found == nullptr ? std::vector<NamedValue>{} : effect_values(*found);
}

void count_added(const view::Budget& budget, Diagnosis& d) {
  const CountedModel counted =
      d.effects.empty() ? CountedModel{budget.nominal_rms, {}} : counted_of(budget, d.effects, d.fitted);
  d.budget.with_effects = counted.rms;
  for (const std::string& effect : d.effects) {
    const EffectEntry* simpler = contained_effect(*find_effect(effect));
    const bool in_part = simpler != nullptr && contains(counted.effects, simpler->name);
    if (!in_part && !contains(counted.effects, effect)) d.budget.uncounted.push_back(effect);
  }
}

void tell_budget(const Study& study, const view::Budget& budget, Diagnosis& d) {
  ErrorBudget& told = d.budget;
  told.band_hz = budget.band.hz;
  told.input = budget.input_rms, told.nominal = budget.nominal_rms;
  count_added(budget, d);
  told.remains = budget.rms;
  told.encoder = budget.floors.encoder;
  told.repeatability = budget.floors.repeatability;
  told.records = study.train.size() + study.held_out.traces.size() > 1 ? budget.floors.disagreement() : kNaN;
  for (std::size_t i = 0; i < budget.rungs.size(); ++i)
    if (budget.rungs[i].helps) told.rungs.push_back(rung_of(budget, i, d));
  if (is_refuted_by_motion(d)) {
    told = {};
    return;
  }
  if (!told.uncounted.empty()) return;  // the observer's residual has them all
  d.mismatch.before_torque = told.nominal, d.mismatch.after_torque = told.with_effects;
  d.mismatch.floor_torque = told.floor(), d.mismatch.input_torque = told.input;
}

std::vector<AddedEffect> added_effects(const view::Budget& budget, const TorqueSearch& ladder) {
  ErrorBudget floors;
  floors.encoder = budget.floors.encoder, floors.repeatability = budget.floors.repeatability;
  std::vector<AddedEffect> added;
  for (std::size_t i = 0; i < ladder.added.size(); ++i) {
    const TorqueAddition& addition = ladder.added[i];
    const view::Rung& rung = budget.rungs[addition.rung];
    AddedEffect a;
    a.effect = addition.group.front()->name;
    a.established = addition.established;
    for (const EffectEntry* entry : addition.group) a.group.emplace_back(entry->name);
    const double before = before_of(budget, addition.rung);
    const double floor = std::min(floors.floor(), 0.5 * before);
    const Interval share = inflated(rung.choice().evidence.interval, rung.choice().evidence.share);
    a.shrink = shrink_by(rung.choice().evidence.share, before, floor);
    a.shrink_ci95 = {shrink_by(share.low, before, floor), shrink_by(share.high, before, floor)};
    a.share_of = ShareOf::kTorque;
    a.after_torque = rung.rms;
    const ModelEffect* effect = effect_of(ladder, i);
    a.parameters = effect != nullptr ? effect_values(*effect)
                                     : values_in(ladder.after.fitted.model, *addition.group.front());
    added.push_back(std::move(a));
  }
  return added;
}

}  // namespace internal::diagnosis

const char* to_string(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::kEffect:
      return "effect";
    case DiagnosisVerdict::kHelps:
      return "helps";
    case DiagnosisVerdict::kNone:
      return "none";
    case DiagnosisVerdict::kUnknown:
      return "unknown";
    case DiagnosisVerdict::kNotRun:
      return "not run";
  }
  return "";
}

bool ErrorBudget::exists() const { return !std::isnan(band_hz); }

double ErrorBudget::floor() const {
  using internal::diagnosis::or_zero;
  return std::max({or_zero(encoder), or_zero(repeatability), or_zero(records)});
}

}  // namespace gapscope
