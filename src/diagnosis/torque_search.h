#pragma once

#include <optional>
#include <vector>

#include "diagnosis/diagnose.h"

namespace gapscope::internal::diagnosis {

/// What is fitted and what is held out, with u in torque, as the torque view takes it.
torque_view::SplitRecordings in_torque(const Study& study, const ReferenceModel& nominal);

/// Whether a free-form law follows another variable than an effect: where it takes nearly as much, the cause
/// stays open.
bool follows_another(const torque_view::Law& free_form, const EffectEntry& entry);

/// The error budget in torque of a drive of one body, or of one whose output is locked; nothing
/// for others, whose torque balance depends on the contact, or where the recordings admit no band.
std::optional<torque_view::Budget> torque_budget(const Study& study, const ReferenceModel& nominal);

/// The effects that the exact simulator refits: those that lead in torque, those that have no law there with
/// their look-alikes, and the simpler effects within any of these.
std::vector<const EffectEntry*> worth_refitting(const Study& study, const torque_view::Budget& budget);

/// Whether the balance alone is to be climbed: that of a locked output, which has the contact in no parameter
/// of the model, says most of the input and knows a law that helps.
bool rests_on_balance(const torque_view::Budget& budget, const ReferenceModel& nominal);

/// The law that a rung does not lead by enough to be the cause: another one of the budget, or a torque that
/// follows another variable freely; empty: none keeps it back.
std::string rival_of(const torque_view::Rung& rung);

/// Whether a share is that of a term: a law that comes more than once does so with lines of its own.
bool is_of(const torque_view::Share& share, const torque_view::Term& term);

/// A rung of the ladder that stands for an effect of the catalogue, added to the model.
struct TorqueAddition {
  std::size_t rung = 0;  ///< of the budget
  bool established = false;
  std::vector<const EffectEntry*> group;  ///< with it: what this recording cannot tell apart; itself first
};

/// Whether the balance takes it for a delay of the input: x(t − T) obeys the same law as u(t − T), and a
/// first order differs from a delay in T² only.
bool acts_as_delay(const EffectEntry& entry);

/// What the ladder comes to, refitted by the simulator.
struct TorqueSearch {
  std::vector<TorqueAddition> added;
  ScoredModel after;  ///< the nominal model with all of them
};

/// What an addition has become in the model, where each line of an effect is one of its own, in the order of
/// the rungs; nullptr: an effect that contains it stands there.
const ModelEffect* effect_of(const TorqueSearch& search, std::size_t addition);

/// Takes out what has no amount left. @param balanced  the model before, with the same effects
/// @returns whether any of them had one, so that the model is another one without it
bool drop_what_vanished(const ReferenceModel& balanced, TorqueSearch& search);

TorqueSearch take_ladder(const Study& study, const ScoredModel& nominal, const torque_view::Budget& budget);

}  // namespace gapscope::internal::diagnosis
