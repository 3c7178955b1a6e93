#include "diagnosis/torque_model.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "diagnosis/effect_starts.h"
#include "diagnosis/joint_effects.h"

namespace gapscope::internal::diagnosis {
namespace {

namespace view = torque_view;

/// A harmonic belongs to the effect of its line.
void put_harmonic(ReferenceModel& model, const view::Model& terms, const view::Term& term) {
  const view::Term* line = view::find_term(terms, term.law->simpler);
  for (ModelEffect& effect : model.effects) {
    const int period = effect.entry->period_at();
    if (line == nullptr || effect.entry->name != std::string_view(term.law->effect) ||
        effect.parameters[static_cast<std::size_t>(period)].value != line->shape)
      continue;
    // Sines and cosines of the harmonics, from the second on, stand behind amplitude, period and phase.
    const auto first = static_cast<std::size_t>(2 * term.law->harmonic - 1);
    const bool ripple =
        term.law->kind == view::Kind::kOnTorque;  // its sign is the other one, see ripple_values()
    const auto values =
        view::harmonic_values(ripple ? Eigen::VectorXd(-term.theta) : term.theta, term.law->harmonic,
                              ripple ? Eigen::VectorXd(-line->theta) : line->theta);
    for (std::size_t k = 0; k < values.size(); ++k)
      effect.parameters[first + k] = ParameterSetting::sought(values[k]);
  }
}

/// An effect takes the place of the simpler one that it contains. Where another has taken it, one whose ratio
/// is of the level shares that level; one with a size of its own leaves it there. Bristles bear a part of it,
/// or all where nothing else would hold the rest.
void put_into(ReferenceModel& model, ModelEffect effect) {
  const EffectEntry* simpler = contained_effect(*effect.entry);
  ParameterSetting &level = effect.parameters[0], &ratio = effect.parameters[1];
  for (ModelEffect& other : model.effects) {
    if (simpler == nullptr || contained_effect(*other.entry) != simpler) continue;
    const Scale of_ratio = effect.entry->parameters[1].scale;
    if (of_ratio == Scale::kOne) level.value = 0.0, level.estimate = false;
    if (of_ratio == Scale::kTravel && other.parameters[0].value > level.value) {
      other.parameters[0].value -= level.value;
      break;
    }
    if (of_ratio != Scale::kLevel) continue;
    other.parameters[0].value -= 0.5 * level.value;
    level.value *= 0.5, level.estimate = false, ratio.value /= 0.5;
  }
  for (const ModelEffect& other : model.effects)
    if (other.entry == simpler && effect.entry->parameters[1].scale == Scale::kTravel)
      level.value = std::max(level.value, other.parameters[0].value);
  std::erase_if(model.effects, [&](const ModelEffect& e) { return e.entry == simpler; });
  model.effects.push_back(effect);
}

/// The balance does not bound static friction, which would drive the motor below a ratio of -1: it gets the
/// least that a fit may come to.
void bound_static_friction(ReferenceModel& model) {
  for (ModelEffect& effect : model.effects) {
    if (effect.entry->name != std::string_view("stribeck_friction")) continue;
    ParameterSetting& ratio = effect.parameters[1];
    if (ratio.estimate) ratio.value = std::max(ratio.value, effect.entry->parameters[1].low);
  }
}

/// What the model has already, as the balance has it: its numbers hold together. At one level of speed it may
/// part friction into viscous and Coulomb friction otherwise than the model did.
void take_known(ReferenceModel& model, const view::Budget& budget, const view::Drive& drive) {
  for (ModelEffect& effect : model.effects) {
    const view::Law* law = law_of(*effect.entry);
    const auto end = budget.addable.begin() + std::ssize(budget.nominal);
    const auto term = std::find_if(budget.addable.begin(), end, [&](const view::Term& t) {
      return t.law == law && (law->shape_at < 0 || t.shape == effect.parameters[law->shape_at].value);
    });
    if (term == end || !view::has_its_sign(*law, term->theta[0], drive.inertia)) continue;
    const std::vector<double> values = law->values(term->theta, term->shape, drive);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (effect.parameters[i].estimate && std::isfinite(values[i])) effect.parameters[i].value = values[i];
  }
}

view::Shape shape_in(const ReferenceModel& model, const ModelEffect& effect, const view::Law& law) {
  view::Shape shape = effect.parameters[static_cast<std::size_t>(law.shape_at)].value;
  if (law.sign != view::Sign::kShareOfInertia) return shape;
  const auto& p = effect.parameters;  // as resonance_values() writes them
  const double inertia = p[0].value * model.parameters[place::kMotorInertia].value;
  shape.damping = p[2].value;
  if (inertia > 0.0) shape.drag = p[3].value / inertia, shape.rub = p[4].value / inertia;
  return shape;
}

void add_once(view::Model& model, const view::Law& law, const view::Shape& shape) {
  if (view::find_term(model, law.name) == nullptr)
    model.push_back({&law, shape, Eigen::VectorXd::Zero(law.columns)});
}

/// The contact of a locked output.
view::Term contact_of(const ReferenceModel& model, const view::SplitRecordings& data) {
  const view::Law& spring = view::law("spring_to_ground");
  if (!has_play(model)) return {&spring, kNaN, Eigen::VectorXd::Zero(spring.columns)};
  double low = kInfinity, high = -kInfinity;
  for (const auto* traces : {&data.fit, &data.judge})
    for (const view::StampedTrace& t : *traces)
      for (const double x : t.x) low = std::min(low, x), high = std::max(high, x);
  return view::contact_term(low, high);
}

/// A load on a spring has a part of what the balance has of the whole drive.
void leave_to_spring(const view::Term& spring, ReferenceModel& model) {
  const auto take = [](ParameterSetting& p, double part) {
    if (p.estimate) p.value = std::max(p.value - part, kRule.faded * p.value);
  };
  const double inertia = spring.theta[0];
  take(model.parameters[place::kMotorInertia], inertia);
  take(model.parameters[place::kMotorDamping], inertia * spring.shape.drag);
  for (ModelEffect& e : model.effects)
    if (e.entry == find_effect("motor_coulomb_friction")) take(e.parameters[0], inertia * spring.shape.rub);
}

}  // namespace

bool has_play(const ReferenceModel& model) {
  const ParameterSetting& gap = model.parameters[place::kGap];
  return gap.estimate || !(gap.value == 0.0);
}

const view::Law* law_of(const EffectEntry& entry) {
  for (const view::Law& l : view::laws())
    if (l.values != nullptr && entry.name == std::string_view(l.effect)) return &l;
  return nullptr;
}

view::Model known_terms(const ReferenceModel& model, const view::SplitRecordings& data,
                        const view::Scales& scales) {
  view::Model known;
  if (model.structure.has_load) known.push_back(contact_of(model, data));
  for (const ModelEffect& e : model.effects) {
    const view::Law* law = law_of(*e.entry);
    if (law == nullptr) continue;
    const std::vector<double> shapes = law->shapes(scales);
    if (law->shape_at < 0 && shapes.empty()) continue;
    if (law->simpler != nullptr) add_once(known, view::law(law->simpler), kNaN);
    const EffectEntry* contained = contained_effect(*e.entry);
    if (contained != nullptr && law->kind == view::Kind::kOnTorque)  // of which the law says nothing
      add_once(known, view::law(contained->name), kNaN);
    const view::Shape shape = law->shape_at < 0 ? view::Shape(shapes.front()) : shape_in(model, e, *law);
    known.push_back({law, shape, Eigen::VectorXd::Zero(law->columns)});
  }
  return known;
}

view::Drive drive_of(const view::Model& terms, const view::Budget& budget, const ReferenceModel& model) {
  view::Drive drive;
  drive.inertia = view::first_coefficient(terms, "inertia");
  drive.viscous = view::first_coefficient(terms, "viscous");
  drive.coulomb = view::first_coefficient(terms, "motor_coulomb_friction");
  drive.torque_constant = model.parameters[place::kTorqueConstant].value;
  drive.torque_rms = budget.torque_rms;
  return drive;
}

ReferenceModel with_terms(ReferenceModel model, const view::Budget& budget) {
  const view::Drive drive = drive_of(budget.addable, budget, model);
  const auto take = [&](int index, double value) {
    ParameterSetting& p = model.parameters[index];
    if (p.estimate && value > 0.0) p.value = value;
  };
  take(place::kMotorInertia, drive.inertia);
  take(place::kMotorDamping, drive.viscous);
  take_known(model, budget, drive);
  for (std::size_t i = budget.nominal.size(); i < budget.addable.size(); ++i) {
    const view::Term& term = budget.addable[i];
    if (term.law->harmonic > 0) {
      put_harmonic(model, budget.addable, term);
      continue;
    }
    put_into(model, searched_effect(*find_effect(term.law->effect),
                                    term.law->values(term.theta, term.shape, drive), budget.scales.turns));
  }
  bound_static_friction(model);
  if (const view::Term* spring = view::spring_of(budget.addable)) leave_to_spring(*spring, model);
  return model;
}

bool has_vanished(const ModelEffect& effect) {
  return effect.entry->parameters[0].absent == 0.0 && is_absent(effect);
}

bool has_faded(const ModelEffect& refitted, const ModelEffect& balanced) {
  const std::vector<std::size_t> sizes = sizes_of(*refitted.entry);
  return refitted.entry->parameters[0].absent == 0.0 &&
         std::all_of(sizes.begin(), sizes.end(), [&](std::size_t i) {
           return std::abs(refitted.parameters[i].value) <=
                  kRule.faded * std::abs(balanced.parameters[i].value);
         });
}

ScoredModel refitted_from(const Study& study, const ReferenceModel& balanced, const ScoredModel& nominal) {
  const FitOptions& options = study.options.fit;
  const double hz = study.observer_hz;
  const bool locked = balanced.structure.has_load;
  const auto effort = locked ? study.effort.quick : reference::RefineEffort{};
  ScoredModel refitted =
      judge(nullptr, fit_near(study.train, balanced, options, hz, effort), study.held_out, hz);
  if (std::max(refitted.median_free, refitted.median_innovation) < options.rejected_ratio) return refitted;
  if (is_led_astray(refitted, nominal)) return refitted;
  ScoredModel as_is = judge(nullptr, {balanced, {}, 0.0, {}, {}, true}, study.held_out, hz);
  const auto& effects = refitted.fitted.model.effects;
  const bool kept = std::none_of(effects.begin(), effects.end(), has_vanished);
  const auto error = [&](const ScoredModel& m) {
    return study.repeats_badly() ? m.median_innovation : m.median_free;
  };
  const double least =
      error(as_is) < error(nominal) ? study.effort.far_better * error(as_is) : error(nominal);
  const bool takes = kept && (error(refitted) < least || (locked && refitted.score < as_is.score));
  return takes || !std::isfinite(as_is.score) ? refitted : as_is;
}

}  // namespace gapscope::internal::diagnosis
