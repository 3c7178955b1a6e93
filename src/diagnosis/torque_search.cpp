#include "diagnosis/torque_search.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/require.h"
#include "diagnosis/effect_starts.h"
#include "diagnosis/periodic_torque.h"
#include "diagnosis/step.h"
#include "diagnosis/torque_model.h"

namespace gapscope::internal::diagnosis {
namespace {

namespace view = torque_view;

/// One body, or a locked output: no contact opens and closes unseen. Where such an output has play, each
/// recording would have its own place in it.
bool has_one_balance(const Study& study, const ReferenceModel& model) {
  if (!model.structure.has_load) return true;
  const bool of_the_same = study.held_out.scored_from.front() > 0;
  return model.structure.load == LoadKind::kLocked && (!has_play(model) || of_the_same);
}

/// Cycles per turn at which the correcting torque stands out where the model was fitted and holds on what is
/// held out.
std::vector<double> repeating_lines(const Study& study, const ReferenceModel& nominal) {
  const auto held = ripples_of(play(nominal, study.held_out, study.observer_hz, true));
  std::vector<double> lines;
  if (held.empty()) return lines;
  for (const TorqueLine& line : standing_lines(ripples_of(play_on_train(study, nominal)), study.train))
    if (!is_of_encoder(line.line.periods, study.train) &&
        check_line(line.line.periods, held, study.held_out).holds())
      lines.push_back(line.line.periods);
  return lines;
}

/// Position at which the load hangs, by the model; 0 where nothing hangs.
double hangs_at(const ReferenceModel& model) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == find_effect("load_unbalance")) return -e.parameters[1].value;
  return 0.0;
}

/// u in torque and the time since the recording began, as the simulator counts it, from a sample on. What its
/// load has beyond that of the model takes its part of it.
/// @param hangs_at  the position at which that hangs [rad]
view::StampedTrace in_torque(const MotorTrace& trace, std::size_t from, double torque_constant,
                             double hangs_at) {
  view::StampedTrace t{trace.file, {}, {}, {}, trace.quantum, true};
  t.added_inertia = trace.load.inertia;
  for (std::size_t i = from; i < trace.size(); ++i) {
    t.t.push_back(trace.elapsed(i));
    t.u.push_back(torque_constant * trace.u[i] - trace.load.gravity * std::sin(trace.x1[i] - hangs_at));
    t.x.push_back(trace.x1[i]);
  }
  return t;
}

bool is_named(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A free law of the same variable says the same.
bool follows_speed(const EffectEntry& entry) {
  return entry.follows == ResidualPattern::kDirection || entry.follows == ResidualPattern::kSpeed;
}

/// A torque that follows another variable freely and takes nearly as much; nullptr: none does.
const view::Candidate* free_rival(const view::Rung& rung, const EffectEntry& entry) {
  const double enough = (1.0 - view::TorqueViewOptions{}.least_margin) * rung.choice().evidence.share;
  const auto at = std::find_if(rung.ranking.begin(), rung.ranking.end(), [&](const view::Candidate& c) {
    return follows_another(*c.law, entry) && c.evidence.share >= enough;
  });
  return at == rung.ranking.end() ? nullptr : &*at;
}

/// The rung that has brought a term; nothing for a simpler law that came with it.
std::optional<std::size_t> rung_of(const view::Budget& budget, const view::Law& law) {
  for (std::size_t i = 0; i < budget.rungs.size(); ++i)
    if (budget.rungs[i].helps && budget.rungs[i].choice().law == &law) return i;
  return {};
}

/// The same of a term: a law that comes more than once does so with lines of its own.
std::optional<std::size_t> rung_of(const view::Budget& budget, const view::Term& term) {
  const auto off = [&](std::size_t i) {
    return std::abs(budget.rungs[i].choice().model.back().shape - term.shape);
  };
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < budget.rungs.size(); ++i)
    if (budget.rungs[i].helps && budget.rungs[i].choice().law == term.law &&
        (!nearest || off(i) < off(*nearest)))
      nearest = i;
  return nearest;
}

/// Whether the recordings show the simpler law that this one adds to: at one speed they show neither.
/// Friction beside a spring may be the load's alone.
bool shows_simpler(const view::Budget& budget, const view::Rung& rung, const view::Law& law) {
  if (law.simpler == nullptr || view::find_term(budget.nominal, law.simpler) != nullptr) return true;
  if (law.sign == view::Sign::kShareOfInertia) return true;
  const auto is_simpler = [&](const view::Candidate& c) {
    return c.law->name == std::string_view(law.simpler);
  };
  return rung_of(budget, view::law(law.simpler)).has_value() ||
         std::any_of(rung.ranking.begin(), rung.ranking.end(), is_simpler);
}

/// A law is established with one that contains it.
void establish_contained(std::vector<TorqueAddition>& added) {
  for (TorqueAddition& a : added)
    a.established =
        a.established || std::any_of(added.begin(), added.end(), [&](const TorqueAddition& other) {
          return other.established && contained_effect(*other.group.front()) == a.group.front();
        });
}

/// At one speed the torque hardly varies, and a line is one of position, of command and of sensor alike.
bool is_same_line(const view::Candidate& choice, const view::Law& law, const view::Scales& scales) {
  if (!choice.law->line || !law.line) return false;
  if (law.shapes == view::line_grid) return true;
  const std::vector<double> turn = law.shapes(scales);
  return !turn.empty() && std::abs(choice.model.back().shape - turn.front()) * scales.travel < 0.5 * kPi;
}

/// All that the choice of a rung cannot be told from: its group, and rivals that it does not lead clearly.
std::vector<const EffectEntry*> group_of(const view::Budget& budget, const view::Rung& rung,
                                         const EffectEntry& chosen, const view::TorqueViewOptions& options) {
  std::vector<const EffectEntry*> group{&chosen};
  const double near = (1.0 - options.least_margin) * rung.choice().evidence.share;
  for (const view::Candidate& c : rung.ranking) {
    const EffectEntry* entry = find_effect(c.law->effect);
    const bool alike = is_named(rung.group, c.law->name) || (!rung.named && c.evidence.share >= near);
    const bool same_line =
        is_named(rung.group, c.law->name) && view::contains_line(*c.law, *rung.choice().law);
    const bool nested =
        same_line ||
        (entry != nullptr && (contained_effect(*entry) == &chosen || contained_effect(chosen) == entry));
    if (entry != nullptr && alike && !nested && std::find(group.begin(), group.end(), entry) == group.end())
      group.push_back(entry);
  }
  if (!budget.band.free_constant) return group;
  for (const view::Law& l : view::laws()) {
    const EffectEntry* entry = find_effect(l.effect);
    if (entry != nullptr && is_same_line(rung.choice(), l, budget.scales) &&
        std::find(group.begin(), group.end(), entry) == group.end())
      group.push_back(entry);
  }
  return group;
}

/// Whether a model can be run, and departs no further than far from the one that it was added to, unless that
/// says nothing.
bool is_usable(const ScoredModel& model, const ScoredModel& nominal) {
  return std::isfinite(model.score) &&
         (!(model.median_free > kRule.far * nominal.median_free) || is_led_astray(model, nominal));
}

/// Whether an effect is one of those that are asked, the simpler one within one of them, or what one of them
/// that the balance has no law of may be mistaken for: the balance has not told these apart.
bool is_asked_with(const std::vector<const EffectEntry*>& asked, const EffectEntry& entry) {
  return std::any_of(asked.begin(), asked.end(), [&](const EffectEntry* e) {
    return e == &entry || contained_effect(*e) == &entry || (law_of(*e) == nullptr && look_alike(*e, entry));
  });
}

/// A delay and a first order of the same time differ in its square only. The balance does not see that; the
/// motion may, and then the worse of them is none of the group.
void tell_delays_apart(const Study& study, const ScoredModel& nominal, TorqueSearch& search) {
  for (TorqueAddition& a : search.added) {
    if (std::none_of(a.group.begin(), a.group.end(), [](const EffectEntry* e) { return acts_as_delay(*e); }))
      continue;
    const ReferenceModel delayed = search.after.fitted.model;
    const auto at = std::ranges::find(delayed.effects, a.group.front(), &ModelEffect::entry);
    if (at == delayed.effects.end()) continue;
    std::vector<std::pair<const EffectEntry*, ScoredModel>> tried = {{a.group.front(), search.after}};
    for (const EffectEntry* entry : a.group) {
      const bool is_there =
          std::ranges::find(delayed.effects, entry, &ModelEffect::entry) != delayed.effects.end();
      if (!acts_as_delay(*entry) || is_there) continue;
      ReferenceModel lagging = delayed;
      lagging.effects[static_cast<std::size_t>(at - delayed.effects.begin())] =
          searched_effect(*entry, {at->parameters[0].value}, study.turns);
      tried.emplace_back(entry, refitted_from(study, lagging, nominal));
    }
    std::ranges::stable_sort(tried, {}, [](const auto& t) { return t.second.score; });
    for (const auto& [entry, model] : tried)
      if (!(model.score < tried.front().second.score + kRule.tells_apart)) std::erase(a.group, entry);
    if (a.group.front() == at->entry) continue;
    std::ranges::stable_partition(a.group, [&](const EffectEntry* e) { return e == tried.front().first; });
    search.after = tried.front().second;
  }
}

}  // namespace

const ModelEffect* effect_of(const TorqueSearch& search, std::size_t addition) {
  const EffectEntry* entry = search.added[addition].group.front();
  std::size_t behind = 0;  // further additions of the same effect
  for (std::size_t i = addition + 1; i < search.added.size(); ++i)
    if (search.added[i].group.front() == entry) ++behind;
  const auto& effects = search.after.fitted.model.effects;
  for (auto e = effects.rbegin(); e != effects.rend(); ++e)
    if (e->entry == entry && behind-- == 0) return &*e;
  return nullptr;
}

std::string rival_of(const view::Rung& rung) {
  if (!rung.named && view::is_clear(rung.choice().evidence, view::TorqueViewOptions{})) return rung.rival;
  const EffectEntry* entry = find_effect(rung.choice().law->effect);
  const view::Candidate* free = entry == nullptr ? nullptr : free_rival(rung, *entry);
  return free == nullptr ? "" : free->law->name;
}

bool is_of(const view::Share& share, const view::Term& term) {
  if (share.law->sign == view::Sign::kShareOfInertia)
    return share.law == term.law;                                               // its shape is asked again
  return share.law == term.law && !(std::abs(share.shape - term.shape) > 0.0);  // NaN: a law without a shape
}

bool follows_another(const view::Law& free_form, const EffectEntry& entry) {
  const std::string_view name = free_form.name;
  return (name == "free_speed_curve" && !follows_speed(entry)) ||
         (name == "free_position_curve" && entry.follows != ResidualPattern::kAngle);
}

bool acts_as_delay(const EffectEntry& entry) {
  return entry.name == std::string_view("actuator_lag") || entry.name == std::string_view("measurement_lag");
}

view::SplitRecordings in_torque(const Study& study, const ReferenceModel& nominal) {
  const double km = nominal.parameters[place::kTorqueConstant].value;
  view::SplitRecordings data;
  const double down = hangs_at(nominal);
  for (const MotorTrace& t : study.train) data.fit.push_back(in_torque(t, 0, km, down));
  for (std::size_t r = 0; r < study.held_out.traces.size(); ++r)
    data.judge.push_back(in_torque(study.held_out.traces[r], study.held_out.scored_from[r], km, down));
  data.turns = study.turns;
  data.held_output = nominal.structure.has_load;
  data.new_phase = study.held_out.scored_from.front() == 0;  // other recordings, not the rest of these
  view::Scales scales;
  scales.turns = data.turns, scales.held_output = data.held_output;
  double square = 0.0, samples = 0.0;
  for (const view::StampedTrace& t : data.fit)
    for (const double torque : t.u) square += torque * torque, samples += 1.0;
  scales.torque_rms = std::sqrt(square / samples);
  data.known = known_terms(nominal, data, scales);
  data.closed = study.options.excluded;
  data.threads = study.options.threads;
  for (const EffectEntry* entry : study.catalogue)
    if (is_candidate(*entry, nominal)) data.addable.emplace_back(entry->name);
  return data;
}

std::optional<view::Budget> torque_budget(const Study& study, const ReferenceModel& nominal) {
  if (!has_one_balance(study, nominal)) return {};
  view::SplitRecordings data = in_torque(study, nominal);
  data.lines = repeating_lines(study, nominal);
  const view::Budget budget = view::error_budget(data);
  return std::isnan(budget.band.hz) ? std::optional<view::Budget>() : budget;
}

bool rests_on_balance(const view::Budget& budget, const ReferenceModel& nominal) {
  return nominal.structure.has_load && budget.says_most && !budget.rungs.empty() &&
         budget.rungs.front().helps;
}

std::vector<const EffectEntry*> worth_refitting(const Study& study, const view::Budget& budget) {
  if (budget.rungs.empty()) return study.catalogue;
  const std::vector<view::Candidate>& ranking = budget.rungs.front().ranking;
  std::vector<std::string> leading;
  for (const view::Candidate& c : ranking)
    if (*c.law->effect != '\0' &&
        (leading.size() < study.effort.leaders ||
         c.evidence.share >= ranking.front().evidence.share - view::TorqueViewOptions{}.least_margin))
      leading.emplace_back(c.law->effect);
  std::vector<const EffectEntry*> asked = study.catalogue;
  std::erase_if(asked,
                [&](const EffectEntry* e) { return law_of(*e) != nullptr && !is_named(leading, e->name); });
  std::vector<const EffectEntry*> entries = study.catalogue;
  std::erase_if(entries, [&](const EffectEntry* e) { return !is_asked_with(asked, *e); });
  return entries;
}

bool drop_what_vanished(const ReferenceModel& balanced, TorqueSearch& search) {
  std::vector<ModelEffect>& effects = search.after.fitted.model.effects;
  GAPSCOPE_REQUIRE(effects.size() == balanced.effects.size());
  bool changes = false;
  std::vector<bool> gone;
  for (const ModelEffect& e : effects) gone.push_back(has_vanished(e));
  std::vector<TorqueAddition> kept;
  for (std::size_t i = 0; i < search.added.size(); ++i) {
    const ModelEffect* effect = effect_of(search, i);
    const auto at = static_cast<std::size_t>(effect == nullptr ? 0 : effect - effects.data());
    if (effect != nullptr && !gone[at] && has_faded(*effect, balanced.effects[at])) gone[at] = changes = true;
    if (effect == nullptr || !gone[at]) kept.push_back(search.added[i]);
  }
  search.added = std::move(kept);
  std::vector<ModelEffect> left;
  for (std::size_t i = 0; i < effects.size(); ++i)
    if (!gone[i]) left.push_back(effects[i]);
  effects = std::move(left);
  return changes;
}

TorqueSearch take_ladder(const Study& study, const ScoredModel& nominal, const view::Budget& budget) {
  const view::TorqueViewOptions options;
  TorqueSearch search;
  for (std::size_t i = budget.nominal.size(); i < budget.addable.size(); ++i) {
    const view::Law& law = *budget.addable[i].law;
    if (law.harmonic > 0) continue;  // the effect is there already
    const std::optional<std::size_t> at = rung_of(budget, budget.addable[i]);
    const EffectEntry& entry = *find_effect(law.effect);
    if (!at) continue;
    const view::Rung& rung = budget.rungs[*at];
    const auto share = std::find_if(budget.shares.begin(), budget.shares.end(),
                                    [&](const view::Share& s) { return is_of(s, budget.addable[i]); });
    const bool needed = share == budget.shares.end() || share->last.share >= options.least_share;
    search.added.push_back(
        {*at, rung.named && needed && shows_simpler(budget, rung, law) && free_rival(rung, entry) == nullptr,
         group_of(budget, rung, entry, options)});
    if (law.name == std::string_view("input_delay"))
      std::copy_if(study.catalogue.begin(), study.catalogue.end(),
                   std::back_inserter(search.added.back().group),
                   [](const EffectEntry* e) { return acts_as_delay(*e); });
  }
  std::stable_sort(search.added.begin(), search.added.end(),
                   [](const TorqueAddition& a, const TorqueAddition& b) { return a.rung < b.rung; });
  establish_contained(search.added);
  if (search.added.empty()) return search;
  const ReferenceModel balanced = with_terms(nominal.fitted.model, budget);
  for (const ReferenceModel& values : {balanced, with_drive(balanced, nominal.fitted.model)})
    if (!std::isfinite(search.after.score)) search.after = refitted_from(study, values, nominal);
  if (!is_usable(search.after, nominal)) return {};
  tell_delays_apart(study, nominal, search);
  if (drop_what_vanished(balanced, search)) {
    search.after = refitted_from(study, search.after.fitted.model, nominal);
    if (!is_usable(search.after, nominal)) return {};
  }
  return search;
}

}  // namespace gapscope::internal::diagnosis
