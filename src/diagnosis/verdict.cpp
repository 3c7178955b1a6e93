#include "diagnosis/verdict.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/mismatch_size.h"
#include "diagnosis/motion.h"
#include "diagnosis/report_back.h"
#include "diagnosis/words.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Whether the best candidate shrinks the held-out error, though its cause stays open.
bool best_helps(const Study& study, const Findings& found) {
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
  d.sentence = sentence_of(d, study.options.coordinates);
}

/// Whether the drive lacks nothing that the recordings could show.
bool lacks_nothing(const Findings& found) { return found.candidates.empty() && at_floor(found.before); }

/// Whether effects could be one function of one variable in pieces: three and more, not all of that variable.
bool may_be_pieces(const Additions& added) {
  const auto same = [&](const Addition& a) {
    return variable_of(*a.entry) == variable_of(*added.effects.front().entry);
  };
  return added.effects.size() > 2 && !std::all_of(added.effects.begin(), added.effects.end(), same);
}

/// Effects that were accepted. Where one free-form law on the nominal model does clearly better than all of
/// them, or comes to the floor like three of several variables, they are no causes. Their cause stays open
/// where one of another variable than the first does nearly as well, or one of a variable of theirs takes
/// what they leave.
Diagnosis report_effects(const Study& study, const Findings& found, const Additions& added) {
  const ScoredModel& nominal = nominal_of(found, added);
  const bool at_end = at_floor(added.after) || added.explained;
  const auto instead = at_end && !may_be_pieces(added) ? std::nullopt : search_last_resort(study, nominal);
  const double better = instead ? lead_over(*instead, added.after) : -kInfinity;
  if (better > kRule.tells_apart || (at_end && instead && at_floor(instead->after))) {
    Diagnosis d = report_back(study, found, {});
    tell_law(study, instead, d);
    return d;
  }
  Diagnosis d = report_back(study, found, added);
  const auto on_top = search_last_resort(study, added.after);
  const bool another =
      !at_end && instead && variable_of(*instead->after.entry) != variable_of(*added.effects.front().entry);
  if ((another && better > -kRule.indistinct) || (on_top && continues_one(*on_top, added))) {
    d.verdict = DiagnosisVerdict::kHelps;
    for (AddedEffect& a : d.added) a.established = false;
    d.sentence = sentence_of(d, study.options.coordinates);
  }
  tell_law(study, on_top, d);
  return d;
}

}  // namespace

bool continues_one(const LawSearch& law, const Additions& added) {
  return std::any_of(added.effects.begin(), added.effects.end(), [&](const Addition& a) {
    return variable_of(*a.entry) == variable_of(*law.after.entry);
  });
}

Diagnosis verdict_on(const Study& study, const Findings& found, const Additions& added,
                     const TorqueSearch& ladder, bool explains) {
  if (!ladder.added.empty()) {
    Diagnosis d = report_ladder(study, found, ladder);
    tell_law(study, search_last_resort(study, ladder.after, true), d);
    return d;
  }
  if (added.accepted) return report_effects(study, found, added);
  const bool helped = explains && best_helps(study, found);
  const auto law = lacks_nothing(found) ? std::nullopt : search_last_resort(study, found.before);
  // A named effect that does nearly as well says more.
  const bool beaten =
      law && !found.candidates.empty() && lead_over(*law, found.candidates.front()) < kRule.tells_apart;
  if (helped && (beaten || !law)) return report_help(study, found);
  Diagnosis d = report_back(study, found, added);
  if (!beaten) tell_law(study, law, d);
  return d;
}

void tell_stopped(const Study& study, const Additions& added, bool by_balance, Diagnosis& d) {
  if (d.verdict == DiagnosisVerdict::kNone) return;
  if (added.accepted && (at_floor(added.after) || added.explained) && !may_be_pieces(added)) return;
  d.stopped = true;
  if (!by_balance && d.verdict == DiagnosisVerdict::kEffect) {
    d.verdict = DiagnosisVerdict::kHelps;
    for (AddedEffect& a : d.added) a.established = false;
  }
  d.sentence = sentence_of(d, study.options.coordinates);
}

}  // namespace gapscope::internal::diagnosis
