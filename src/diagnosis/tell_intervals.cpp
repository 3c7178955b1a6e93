#include "diagnosis/tell_intervals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/normal.h"
#include "diagnosis/tell_budget.h"
#include "diagnosis/told_facts.h"

namespace gapscope::internal::diagnosis {
namespace {

/// What the fit says of its numbers.
struct FitErrors {
  std::vector<std::pair<reference::ParameterId, double>> errors;
  std::vector<Interval> bounds;  ///< of each of them
  std::vector<reference::ParameterId> at_bound;
  std::vector<Doubt> doubts;
};

FitErrors errors_of(const Study& study, const FittedModel& fitted) {
  const reference::ModelFit fit(study.train, fitted.model, study.options.fit, study.observer_hz);
  const reference::FitPoint at = fit.point_of(fitted.model, starts_on(study, fitted));
  reference::StandardErrors errors = fitted.errors ? *fitted.errors : fit.standard_errors(at);
  FitErrors told{std::move(errors.numbers), {}, fit.at_bound(at), std::move(errors.doubts)};
  for (const auto& [id, error] : told.errors) told.bounds.push_back(fit.bounds(id));
  return told;
}

/// No further than the fit could have gone; a bound that is NaN is none.
Interval within(const Interval& ci95, const Interval& bounds) {
  return {std::fmax(ci95.low, bounds.low), std::fmin(ci95.high, bounds.high)};
}

/// 95 % intervals of the numbers of a model's effects, by effect and place in its specification.
std::vector<std::vector<Interval>> intervals_of_effects(const ReferenceModel& model, const FitErrors& fit) {
  std::vector<std::vector<Interval>> all;
  for (const ModelEffect& e : model.effects) all.emplace_back(e.entry->parameters.size());
  for (std::size_t i = 0; i < fit.errors.size(); ++i) {
    const auto& [id, error] = fit.errors[i];
    if (id.effect < 0 || std::isnan(error)) continue;
    const auto effect = static_cast<std::size_t>(id.effect), index = static_cast<std::size_t>(id.index);
    const double value = model.effects[effect].parameters[index].value;
    all[effect][index] = within(normal_interval(value, error), fit.bounds[i]);
  }
  return all;
}

bool are_same(const std::vector<NamedValue>& one, const std::vector<NamedValue>& other) {
  return std::ranges::equal(one, other, [](const NamedValue& a, const NamedValue& b) {
    return a.key == b.key && std::equal_to<>()(a.value, b.value);
  });
}

/// Keys of an effect's parameters that have ended at a bound.
std::vector<std::string> at_bound_of(const EffectEntry& entry, std::size_t effect, const FitErrors& fit) {
  std::vector<std::string> keys;
  for (const reference::ParameterId& id : fit.at_bound)
    if (id.effect == static_cast<int>(effect)) keys.emplace_back(entry.parameters[id.index].key);
  return keys;
}

void tell_added_intervals(const ReferenceModel& model, const FitErrors& fit,
                          std::vector<AddedEffect>& added) {
  const auto intervals = intervals_of_effects(model, fit);
  for (AddedEffect& a : added)
    for (std::size_t e = 0; e < intervals.size(); ++e) {
      if (!are_same(a.parameters, effect_values(model.effects[e]))) continue;
      a.at_bound = at_bound_of(*model.effects[e].entry, e, fit);
      for (std::size_t i = 0; i < a.parameters.size(); ++i) {
        const Interval& ci95 = intervals[e][i];
        const double turned = a.parameters[i].value - model.effects[e].parameters[i].value;
        a.parameters[i].ci95 = {ci95.low + turned, ci95.high + turned};  // a phase is told within a turn
      }
    }
}

/// Of the coupling; of one body, of an effect that gives it a gap.
ModelGap gap_of(const ReferenceModel& model, const std::vector<AddedEffect>& added) {
  const ParameterSetting &ratio = model.parameters[place::kMassRatio], &gap = model.parameters[place::kGap];
  if (has_parameter(model.structure, place::kGap) && (ratio.estimate || ratio.value != 0.0))
    return {gap.estimate ? GapOrigin::kEstimated : GapOrigin::kGiven, gap.value, {}};
  for (const AddedEffect& a : added)
    for (const NamedValue& p : a.parameters)
      if (a.effect == "backlash" && p.key == "gap_rad") return {GapOrigin::kEstimated, p.value, p.ci95};
  return {};
}

bool is_at_bound(const FitErrors& fit, reference::ParameterId id) {
  return std::find(fit.at_bound.begin(), fit.at_bound.end(), id) != fit.at_bound.end();
}

/// A number of the model as it was configured; its effects stand in a fitted model in the same order, what
/// was added behind them. Nothing where its effect has become part of another law.
std::optional<RefittedNumber> as_configured(const ReferenceModel& sheet, const ReferenceModel& model,
                                            reference::ParameterId id) {
  const auto index = static_cast<std::size_t>(id.index);
  if (id.effect == reference::ParameterId::kDrive)
    return RefittedNumber{kDriveParameters[id.index].key,
                          kDriveParameters[id.index].unit,
                          sheet.parameters[index].begun ? kNaN : sheet.parameters[index].value,
                          model.parameters[index].value,
                          {}};
  const auto effect = static_cast<std::size_t>(std::max(0, id.effect));
  if (id.effect < 0 || effect >= sheet.effects.size() || effect >= model.effects.size()) return {};
  const EffectEntry* entry = sheet.effects[effect].entry;
  if (entry != model.effects[effect].entry) return {};
  const NamedValue was = effect_values(sheet.effects[effect])[index],
                   is = effect_values(model.effects[effect])[index];
  return RefittedNumber{fmt::format("{}.{}", entry->name, was.key), was.unit, was.value, is.value, {}};
}

/// Along a slide a count per turn is a length.
RefittedNumber for_people(RefittedNumber n, Coordinates coordinates) {
  constexpr std::string_view kCount = "periods_per_turn";
  if (coordinates.rotational() || !n.key.ends_with(kCount)) return n;
  const auto period = [](double cycles) { return 2.0 * kPi / cycles; };
  n.key.replace(n.key.size() - kCount.size(), kCount.size(), "period");
  n.unit = "rad", n.configured = period(n.configured), n.fitted = period(n.fitted);
  n.ci95 = {period(n.ci95.high), period(n.ci95.low)};
  return n;
}

/// Whether the torque balance has left a number where the nominal fit had it.
bool is_held(const FittedModel& fitted, const ReferenceModel& nominal, reference::ParameterId id) {
  if (!fitted.balanced) return false;
  ReferenceModel is = fitted.model, was = nominal;
  if (id.effect >= 0) {
    const auto at = static_cast<std::size_t>(id.effect);
    if (at >= was.effects.size() || was.effects[at].entry != is.effects[at].entry) return false;
  }
  return std::equal_to<>()(setting_of(is, id).value, setting_of(was, id).value);
}

std::vector<RefittedNumber> refitted_of(const Study& study, const FittedModel& fitted,
                                        const ReferenceModel& nominal, const FitErrors& fit) {
  std::vector<RefittedNumber> all;
  for (std::size_t i = 0; i < fit.errors.size(); ++i) {
    const auto& [id, error] = fit.errors[i];
    if (!std::isfinite(error) || is_at_bound(fit, id) || is_held(fitted, nominal, id)) continue;
    std::optional<RefittedNumber> n = as_configured(study.sheet, fitted.model, id);
    if (!n || !std::isfinite(n->configured)) continue;
    n->ci95 = within(normal_interval(n->fitted, error), fit.bounds[i]);
    const double turn = n->key.ends_with("phase_rad") ? 2.0 * kPi : 0.0;
    const double off =
        turn > 0.0 ? std::remainder(n->configured - n->fitted, turn) : n->configured - n->fitted;
    if (n->fitted + off < n->ci95.low || n->fitted + off > n->ci95.high)
      all.push_back(for_people(std::move(*n), study.options.coordinates));
  }
  std::stable_sort(all.begin(), all.end(), [](const RefittedNumber& a, const RefittedNumber& b) {
    return moved_by(a) > moved_by(b);
  });
  return all;
}

/// Dampings and frictions that the drive has and no fit moves.
std::vector<std::string> held_of(const ReferenceModel& sheet) {
  std::vector<std::string> held;
  for (const int i : {place::kMotorDamping, place::kLoadDamping, place::kLoadCoulombFriction})
    if (has_parameter(sheet.structure, i) && !sheet.parameters[i].estimate)
      held.emplace_back(kDriveParameters[i].key);
  return held;
}

/// "motor_inertia (93.3 and 94.9 kg)"
std::string words_of(const Disagreement& it, const ReferenceModel& model, Coordinates coordinates) {
  const auto index = static_cast<std::size_t>(it.id.index);
  if (it.id.effect < 0) {
    const DriveParameterSpec& p = kDriveParameters[it.id.index];
    return fmt::format("{} ({:.3g} and {:.3g} {})", p.key, it.by_run, it.by_torque,
                       coordinates.shown_unit(p.unit));
  }
  const EffectEntry& entry = *model.effects[it.id.effect].entry;
  const std::string unit = coordinates.shown_unit(entry.parameters[index].unit);
  return fmt::format("{}.{} ({:.3g} and {:.3g}{})", entry.name, entry.parameters[index].key, it.by_run,
                     it.by_torque, unit == "-" || unit.empty() ? "" : " " + unit);
}

/// Numbers of which the free run and the torque alone have clearly different values: neither is sure of them.
void warn_of_disagreements(const Study& study, const FittedModel& fitted, Diagnosis& d) {
  std::vector<std::string> numbers;
  for (const Disagreement& it : fitted.disagreements)
    numbers.push_back(words_of(it, fitted.model, study.options.coordinates));
  if (numbers.empty()) return;
  d.warnings.push_back(fmt::format(
      "fitted to follow the motion and fitted to balance the {} alone, the model differs in {}: it has the "
      "former values, and the intervals in the report hold both.",
      study.options.coordinates.torque_word(), fmt::join(numbers, ", ")));
}

bool has_estimates(const ReferenceModel& model) {
  const auto estimated = [](const ParameterSetting& p) { return p.estimate; };
  return std::ranges::any_of(model.parameters, estimated) ||
         std::ranges::any_of(model.effects, [&](const ModelEffect& e) {
           return std::ranges::any_of(e.parameters, estimated);
         });
}

}  // namespace

double moved_by(const RefittedNumber& n) {
  if (n.key.ends_with("phase_rad"))
    return std::abs(std::remainder(n.fitted - n.configured, 2.0 * kPi)) / (2.0 * kPi);
  return std::abs(n.fitted - n.configured) /
         std::max(std::min(std::abs(n.fitted), std::abs(n.configured)), 1e-9 * std::abs(n.fitted));
}

void tell_intervals(const Study& study, const FittedModel& fitted, const ReferenceModel& nominal,
                    Diagnosis& d) {
  d.model_gap = gap_of(fitted.model, d.added);
  d.model_gap->encoder = fitted.model.structure.encoder;
  d.held = held_of(study.sheet);
  for (const ModelEffect& e : study.sheet.effects) d.modelled.emplace_back(e.entry->name);
  const bool known = d.verdict != DiagnosisVerdict::kUnknown;
  const bool asked = !d.added.empty() || d.model_gap->origin == GapOrigin::kEstimated ||
                     (known && has_estimates(study.sheet));
  if (!asked || !std::isfinite(fitted.mean_cost)) return;
  const FitErrors fit = errors_of(study, fitted);
  tell_added_intervals(fitted.model, fit, d.added);
  d.model_gap = gap_of(fitted.model, d.added);
  d.model_gap->encoder = fitted.model.structure.encoder;
  for (const auto& [id, error] : fit.errors)
    if (id == reference::drive_number(place::kGap) && !std::isnan(error))
      d.model_gap->ci95 = normal_interval(d.model_gap->value, error);
  if (d.mismatch.after < kRule.floor_ratio * d.mismatch.floor) d.doubts = fit.doubts;  // else more is missing
  for (const Doubt& doubt : d.doubts) d.warnings.push_back(fmt::format("{}: {}.", doubt.found, doubt.advice));
  warn_of_disagreements(study, fitted, d);
  if (known) d.refitted = refitted_of(study, fitted, nominal, fit);
}

}  // namespace gapscope::internal::diagnosis
