#include "diagnosis/verdict.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/text.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/motion.h"
#include "diagnosis/report_back.h"
#include "diagnosis/rule.h"
#include "diagnosis/told_facts.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Whether the best candidate shrinks the held-out error, though its cause stays open.
bool best_helps(const Study& study, const FirstSearch& found) {
  return !found.candidates.empty() &&
         shrink_of(found.before.median_free, found.candidates.front().median_free) > 0.0 &&
         std::isfinite(found.candidates.front().score) && !found.decision.group.empty() &&
         helps(found.before, found.candidates.front(), study.repeats_badly()) &&
         motion_left(study.held_out, found.candidates.front()).empty();
}

void tell_law(const Study& study, const std::optional<LawSearch>& law, Diagnosis& d) {
  if (!law) return;
  d.laws.push_back(told(study, *law));
  if (law->wider)
    d.warnings.push_back(
        "the recordings that were fitted do not determine the free-form law: the first half of what was held "
        "out was fitted with them, and the second half judges it.");
}

/// Whether the drive lacks nothing that the recordings could show.
bool lacks_nothing(const FirstSearch& found) { return found.candidates.empty() && at_floor(found.before); }

/// Whether effects could be one function of one variable in pieces: three and more, not all of that variable.
bool may_be_pieces(const Additions& added) {
  const auto same = [&](const Addition& a) {
    return variable_of(*a.entry) == variable_of(*added.effects.front().entry);
  };
  return added.effects.size() > 2 && !std::all_of(added.effects.begin(), added.effects.end(), same);
}

/// The verdict, once causes were left open.
void settle_verdict(Diagnosis& d) {
  if (!d.added.empty() && !d.added.front().established) d.verdict = DiagnosisVerdict::kHelps;
}

void open_all_causes(Diagnosis& d) {
  for (AddedEffect& a : d.added) a.established = false;
  settle_verdict(d);
}

/// Whether another effect that was added has the level of the same simple law: the recordings determine their
/// sum, and neither alone.
bool shares_level(const AddedEffect& a, const std::vector<AddedEffect>& added) {
  const auto simplest = [](const AddedEffect& of) {
    const EffectEntry* entry = find_effect(of.effect);
    const EffectEntry* contained = contained_effect(*entry);
    return contained == nullptr ? entry : contained;
  };
  return std::any_of(added.begin(), added.end(), [&](const AddedEffect& other) {
    return other.effect != a.effect && simplest(other) == simplest(a);
  });
}

/// The numbers that say how much there is of an effect: of a law that contains a simpler one its own shares
/// where it has some, else the first. A level that is shared says nothing, nor does a share of it.
std::vector<std::size_t> amounts_of(const EffectEntry& entry, bool shared) {
  std::vector<std::size_t> own;
  for (std::size_t i = 1; contained_effect(entry) != nullptr && i < entry.parameters.size(); ++i) {
    const EffectParameterSpec& p = entry.parameters[i];
    if (p.absent == 0.0 && (p.scale == Scale::kOne || p.scale == Scale::kLevel)) own.push_back(i);
  }
  if (own.empty()) own.push_back(0);
  if (shared)
    std::erase_if(own, [&](std::size_t i) { return i == 0 || entry.parameters[i].scale == Scale::kLevel; });
  return own;
}

/// Whether the torque balance takes more than none by it, by blocks of held-out time.
bool shown_by_balance(const AddedEffect& a, const ErrorBudget& budget) {
  return std::any_of(budget.rungs.begin(), budget.rungs.end(), [&](const BudgetRung& r) {
    return r.added && r.effect == a.effect && r.share_ci95.low > 0.0;
  });
}

}  // namespace

bool may_be_absent(const AddedEffect& a, const Diagnosis& d) {
  const EffectEntry* entry = find_effect(a.effect);
  if (entry == nullptr || a.parameters.empty() || reads_counts(*entry)) return false;
  bool none = false, told = false, ended = false;
  for (const std::size_t i : amounts_of(*entry, shares_level(a, d.added))) {
    if (i >= a.parameters.size()) continue;
    const NamedValue& amount = a.parameters[i];
    if (amount.ci95.low > 0.0 || amount.ci95.high < 0.0) return false;
    none = true;
    told = told || std::isfinite(amount.ci95.low);
    ended = ended || contains(a.at_bound, amount.key);
  }
  return none && (told || ended || !shown_by_balance(a, d.budget));
}

namespace {

/// Of the held-out motion, the largest of any recording [rad]; NaN: not known.
double held_out_travel(const Diagnosis& d) {
  double travel = d.whole_run ? d.whole_run->travel : kNaN;
  for (const MismatchTrace& t : d.traces) {
    if (t.scored_from >= t.x1.size()) continue;
    const auto begin = t.x1.begin() + static_cast<std::ptrdiff_t>(t.scored_from);
    const auto [low, high] = std::minmax_element(begin, t.x1.end());
    travel = std::fmax(travel, *high - *low);
  }
  return travel;
}

/// Whether somebody has given a period, which is then known of the drive.
bool was_given(double periods_per_turn, const Diagnosis& d) {
  return std::ranges::any_of(d.periodic, [&](const PeriodicTorque& p) {
    return p.given && std::abs(p.periods_per_turn - periods_per_turn) < kRule.same_period * periods_per_turn;
  });
}

}  // namespace

bool outlasts_motion(const AddedEffect& a, const Diagnosis& d) {
  constexpr std::string_view kSearched[] = {"cogging_torque", "encoder_eccentricity", "torque_ripple"};
  if (std::ranges::find(kSearched, a.effect) == std::end(kSearched)) return false;
  return std::ranges::any_of(a.parameters, [&](const NamedValue& p) {
    return p.key == "periods_per_turn" && p.value * held_out_travel(d) < 2.0 * kPi && !was_given(p.value, d);
  });
}

namespace {

/// Whether a law is the series of the only effect that was added: its shape, not another cause.
bool tells_its_shape(const LawSearch& law, const Additions& added) {
  const auto& effects = added.after.fitted.model.effects;
  const auto only = std::ranges::find(effects, added.effects.front().entry, &ModelEffect::entry);
  return added.effects.size() == 1 && only != effects.end() && is_series_of(law, *only);
}

/// Effects that were accepted. Where one free-form law on the nominal model does clearly better than all of
/// them, or comes to the floor like three of several variables, they are no causes. Their cause stays open
/// where one of another variable than the first does nearly as well, or one of a variable of theirs takes
/// what they leave. Neither holds of the series that the only effect begins.
Diagnosis report_effects(const Study& study, const FirstSearch& found, const Additions& added) {
  const ScoredModel& nominal = nominal_of(found, added);
  const bool at_end = at_floor(added.after) || added.explained;
  const auto instead = at_end && !may_be_pieces(added) ? std::nullopt : search_last_resort(study, nominal);
  const bool against = instead && !tells_its_shape(*instead, added);
  const Lead lead = against ? lead_over(*instead, added.after) : Lead();
  if (lead.is_clear() || (at_end && against && at_floor(instead->after))) {
    Diagnosis d = report_back(study, found, {});
    tell_law(study, instead, d);
    return d;
  }
  Diagnosis d = report_back(study, found, added);
  const auto on_top = search_last_resort(study, added.after);
  const bool another =
      !at_end && against && variable_of(*instead->after.entry) != variable_of(*added.effects.front().entry);
  if ((another && lead.score > -kRule.indistinct) ||
      (on_top && continues_one(*on_top, added) && !tells_its_shape(*on_top, added)))
    open_all_causes(d);
  tell_law(study, on_top, d);
  return d;
}

}  // namespace

bool continues_one(const LawSearch& law, const Additions& added) {
  return std::any_of(added.effects.begin(), added.effects.end(), [&](const Addition& a) {
    return variable_of(*a.entry) == variable_of(*law.after.entry);
  });
}

void open_undetermined(Diagnosis& d) {
  const bool comes_no_nearer = d.mismatch.after > d.mismatch.before;
  const auto is_open = [&](const AddedEffect& a) {
    return comes_no_nearer || may_be_absent(a, d) || outlasts_motion(a, d);
  };
  if (std::none_of(d.added.begin(), d.added.end(), is_open)) return;
  for (AddedEffect& a : d.added) a.established = a.established && !is_open(a);
  settle_verdict(d);
}

Diagnosis verdict_on(const Study& study, const FirstSearch& found, const Additions& added,
                     const TorqueSearch& ladder, bool explains) {
  if (!ladder.added.empty()) {
    Diagnosis d = report_ladder(study, found, ladder);
    tell_law(study, search_last_resort(study, ladder.after, true), d);
    return d;
  }
  if (added.accepted) return report_effects(study, found, added);
  const bool helped = explains && best_helps(study, found);
  const auto law = lacks_nothing(found) ? std::nullopt : search_last_resort(study, found.before);
  const Lead lead = law && !found.candidates.empty() ? lead_over(*law, found.candidates.front()) : Lead();
  // A named effect that does nearly as well says more.
  if (helped && !lead.is_clear()) return report_help(study, found);
  Diagnosis d = report_back(study, found, added);
  if (found.candidates.empty() || !(lead.score < kRule.tells_apart)) tell_law(study, law, d);
  return d;
}

void tell_stopped(const Additions& added, bool by_balance, Diagnosis& d) {
  if (d.verdict == DiagnosisVerdict::kNone) return;
  if (added.accepted && (at_floor(added.after) || added.explained) && !may_be_pieces(added)) return;
  d.stopped = true;
  const bool is_cause = by_balance || d.verdict != DiagnosisVerdict::kEffect;
  is_cause ? settle_verdict(d) : open_all_causes(d);
}

}  // namespace gapscope::internal::diagnosis
