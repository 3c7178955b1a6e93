#include "telling/step_wordings.h"

/// What a card finds; its steps are in step_wordings.cpp. A sentence is reworded here and nowhere else.
namespace gapscope {
namespace {

constexpr Wording kWordings[] = {
    // The gap.
    {"gap.model_free", "The backlash gap is {gap}, measured without a model.",
     "The backlash gap 2β (full width, at x1) is {gap}, measured without a model."},
    {"gap.literal", "The backlash gap is {gap}, by S1 to S6 of the source paper.",
     "The backlash gap 2β (full width, at x1) is {gap}, by S1 to S6 of the source paper with L = {bound} "
     "{per}; its passages scatter by {scatter}."},
    {"gap.paper", "The backlash gap is {gap}, measured without a model, with the bound that was given.",
     "The backlash gap 2β (full width, at x1) is {gap}, measured without a model, with the bound that was "
     "given (L = {bound} {per})."},
    {"gap.reference", "The backlash gap is {gap} by the fitted model.",
     "The backlash gap 2β (full width, at x1) is {gap} by the fitted model."},
    {"gap.diagnosis", "The backlash gap is {gap} by the model that the diagnosis has fitted.",
     "The backlash gap 2β (full width, at x1) is {gap} by the model that the diagnosis has fitted."},
    {"gap.model_free.agrees", "The reading without a model agrees.",
     "The reading without a model[, {other},] agrees."},
    {"gap.reference.agrees", "The fitted model agrees."},
    {"gap.model_free.contradicts", "But without a model it reads {other}."},
    {"gap.first",
     "There are several gaps in series: the first is {gap}, all together are about {whole}, by two impacts in "
     "each passage."},
    {"gap.first.reference", "The fitted model, which has one gap, gives {other}."},
    {"gap.model_free.first",
     "The impacts alone read {other}. Either there are several gaps in series, of which they see the first, or the "
     "load moved: which of the two, a held output tells."},
    {"gap.reference.contradicts", "But the fitted model gives {other}."},
    {"gap.diagnosis.contradicts", "But the model that the diagnosis has fitted gives {other}."},
    {"gap.literal.reads", "S1 to S6 of the source paper read {other}, {apart} away from it."},
    {"none.model_free", "There is no backlash above {least}[ ({share} of the travel)]."},
    {"none.model_free.agrees", "Without a model none above {least} is seen, which agrees."},
    {"none.model_free.contradicts", "But without a model there is no backlash above {least}."},
    {"none.reference.agrees", "The fitted model closes its gap as well."},
    {"play.model_free", "The play at zero torque is {play}.",
     "The play at zero torque (full width, at x1) is {play}, measured without a model."},
    {"play.model_free.agrees", ""},
    {"play.bounds_gap", "Friction and compliance are a part of it, so the gap is at most that."},
    {"lost_motion", "The lost motion at zero torque is {lost}."},
    {"lost_motion.levels",
     "The lost motion at zero torque is {small} after input ramps to ±{to_small} and {large} after ramps to "
     "±{to_large} units of u."},
    {"lost_motion.grows", "", "What grows with the torque is wind-up, not a gap."},
    {"lost_motion.gap", "Most of it is a gap."},
    {"lost_motion.friction", "The lost motion is friction and compliance."},
    {"lost_motion.open",
     "How much of it is a gap, and how much friction and compliance, this recording does not show."},
    {"gap.at_most", "The gap is at most {limit}[, by the ramps to ±{by}]."},
    {"gap.at_most.larger",
     "The gap is at most {limit}, by the ramps to ±{by}: smaller ones need not have overcome the friction, and "
     "bound nothing."},
    {"gap.at_most.if_any", "If there is one, it is at most {limit}.",
     "If there is one, it is at most {limit}, unless the load was faster than the motor."},
    {"gap.beyond_travel", "The motor moves by {travel} in all, so that nothing can be said of a gap."},
    {"gap.not_known",
     "The gap is not known:[ {rejected}, and] without a model the recording is inconclusive.",
     "The gap is not known:[ {rejected}, and] without a model the recording is inconclusive ({reason})."},
    {"gap.not_known.rejected", "The gap is not known."},
    {"gap.not_estimated.here", "The gap was not estimated."},
    {"gap.not_estimated", "Nothing was estimated."},
    {"model_free.inconclusive", ""},
    {"reference.rejected", "The fitted model is rejected.", "The fitted model is rejected. {why}"},
    {"reference.rejected.why", "", "The fitted model is rejected. {why}"},
    {"reference.tells_none", ""},
    {"reference.why", "", "{why}"},
    {"reference.one_body", "Backlash is not examined, as the model is a single body."},
    {"reference.gap_given", "The gap was given to the model."},
    {"gap.elsewhere", "Not estimated here; `gapscope run CONFIG` does that."},
    {"gap.one_body.as_good", "Backlash is not examined: a single body is as good as the recording.",
     "Backlash is not examined: a single body is as good as the recording. To check without a model: {how}."},
    {"gap.one_body.on_load",
     "Backlash is not examined: with the encoder on the load only a model with a gap can show it.",
     "Backlash is not examined: with the encoder on the load only a model with a gap can show it (`gapscope "
     "init` with --model gap)."},
    {"gap.one_body", "Backlash is not examined, as the model is a single body.",
     "Backlash is not examined, as the model is a single body: it is neither shown nor ruled out. To check "
     "the recording for it: {how}."},
    {"gap.given", "The gap was given to the model, not estimated: {gap}.",
     "The gap was given to the model, not estimated: {gap}. For an estimate: {how}."},
    {"gap.not_determined", "The recordings do not determine the gap of the fitted model.",
     "The recordings do not determine the gap of the fitted model. Without a model: {how}."},
    {"gap.not_followed", "The fitted model does not follow the recordings well enough to give the gap.",
     "The fitted model does not follow the recordings well enough to give the gap[: it leaves {floors} times "
     "{floor}, and gives a gap below {least} times only]. Without a model: {how}."},
    {"gap.if_recording", "This holds if the recording is what it seems to be ({doubt})."},
    {"trust.good", "Trust: good."},
    {"trust.limited", "Trust: limited."},
    {"trust.limited.light_load",
     "Trust: limited (it holds for loads of at least 0.2 of the motor's inertia; a fitted model can confirm it)."},
    {"trust.limited.floors",
     "Trust: limited (the model leaves {floors} times the encoder's noise, and the interval does not hold "
     "what it lacks)."},
    {"trust.limited.open", "Trust: limited (these recordings leave the gap open by {share})."},
    {"trust.limited.reading", "Trust in that reading: limited."},
    {"trust.bound", "Trust: good as an upper limit of the gap; the gap itself may be smaller."},
    {"trust.lost_motion", "Trust: the lost motion is measured; a gap is not established."},
    {"trust.none", "", "Trust: none."},
    {"tolerance.gap.within", "Within your tolerance of {limit}."},
    {"tolerance.gap.outside", "Outside your tolerance of {limit}."},
    {"tolerance.gap.open", "Your tolerance of {limit} cannot be judged."},
    // The error of the model.
    {"error.not_fitted", "Not measured, as no model was fitted."},
    {"error.fit", "The fitted model, simulated freely, follows the motion to {fit} (100 % is exact)."},
    {"error.fit.departs",
     "The fitted model, simulated freely, departs from the motion: fit {fit} (100 % is exact)."},
    {"error.fit.rejected", "It is rejected: its numbers are not to be used."},
    {"error.fit.rejected.all_the_same",
     "It is rejected all the same, as over a whole run a large motion hides what the model gets wrong from "
     "sample to sample: its numbers are not to be used."},
    {"error.torque",
     "The [{refitted} ]model[, with {has},] lacks {missing} rms of {torque}, {share} of what the {source}.",
     "The [{refitted} ]model[ (with {has})] lacks {missing} rms of {torque} on held-out data[ below {band} "
     "Hz], {share} of the {input} rms that the {source}."},
    {"error.torque.alone", "The [{refitted} ]model[, with {has},] lacks {missing} rms of {torque}.",
     "The [{refitted} ]model[ (with {has})] lacks {missing} rms of {torque} on held-out data."},
    {"error.torque.many",
     "The [{refitted} ]model[, with {has},] lacks {missing} rms of {torque}, {times} times what the {source}.",
     "The [{refitted} ]model[ (with {has})] lacks {missing} rms of {torque} on held-out data, {times} times "
     "the {input} rms that the {source}."},
    {"error.motion", "The [{refitted} ]model[, with {has},] is {off} off the held-out motion.",
     "The [{refitted} ]model[ (with {has})] is {off} off the held-out motion[ ({measure})]."},
    {"error.diverges", "The [{refitted} ]model[, with {has},] runs away from the held-out motion."},
    {"error.noise", "That is within the noise.",
     "That is within the noise: the simulated motion is {off} rms off, and the encoder's noise alone makes {floor} (up "
     "to {ratio} times as much counts as noise)."},
    {"error.repeats", "That is within the noise.",
     "That is within the noise: the simulated motion is {off} rms off, and the drive itself differs from period to "
     "period by {floor} (up to {ratio} times as much counts as noise)."},
    {"error.noise.torque", "That is within the noise."},
    {"error.floor.records", "",
     "The {parts} disagree by {floor} of this, which no one set of numbers removes."},
    {"error.floor.drive", "",
     "The drive itself differs by {floor} from period to period; no model gets below that."},
    {"error.floor.encoder", "", "The encoder's noise alone looks like {floor}; no model gets below that."},
    {"error.constant_guessed", "All torques here rest on a guessed torque_constant; the percentages do not."},
    {"error.as_configured", "",
     "With the numbers of the configuration the {judged} motion is {given} off, refitted {before}[, with the "
     "additions {after}][ ({measure})]."},
    {"error.as_configured.diverges", "",
     "With the numbers of the configuration the {judged} motion runs away; refitted it is {before} off[, "
     "with the additions {after}][ ({measure})]."},
    {"error.free_run",
     "Simulated from the first sample to the last it drifts off by up to {before} (the travel is {travel})[; with "
     "what helps, by up to {after}][ ({rms} rms)]."},
    {"error.free_run.diverges",
     "Simulated from the first sample to the last it runs away[; with what helps it is up to {after} off, of "
     "{travel} of travel][ ({rms} rms)]."},
    {"error.free_run.then_diverges",
     "Simulated from the first sample to the last it is up to {before} off, of {travel} of travel; with what "
     "helps it runs away."},
    {"error.free_run.grows", "", "Over so long a run the smallest errors grow."},
    {"error.closed_loop",
     "With its controller in the loop it is {before} rms off in position[ (the travel is {travel})][; with what "
     "helps, {after}]."},
    {"error.closed_loop.diverges",
     "With its controller in the loop it runs away[; with what helps it is {after} rms off in position]."},
    {"error.fitted_loop",
     "`fitted.yaml` is fitted in that loop instead, and is {mae} off on average over what was held out.",
     "`fitted.yaml` is fitted in that loop instead, and is {mae} off on average over what was held out (mean "
     "absolute error of the position over whole recordings)[; the worst of {count} is {worst} with {most}]."},
    {"tolerance.torque.within", "Within your tolerance of {limit}."},
    {"tolerance.torque.outside", "Outside your tolerance of {limit}."},
    {"tolerance.torque.then_within", "Outside your tolerance of {limit}, within it with what helps."},
    {"tolerance.torque.open", "Your tolerance of {limit} of the {torque} cannot be judged."},
    // Where.
    {"by_diagnose", "Not looked for yet: `gapscope diagnose CONFIG` does that."},
    {"where.nowhere", "Nowhere: what is left has no pattern."},
    {"where.pattern", "The missing {torque} {where}."},
    {"where.short", "The held-out motion covers {turns} turns, less than one period."},
    // Its cause.
    {"firmware.rate", "The firmware's loop runs at {value}."},
    {"firmware.speed", "The firmware moves to its goal at no more than {value}."},
    {"firmware.acceleration", "The firmware accelerates towards its goal by no more than {value}."},
    {"firmware.filter", "The firmware smooths its goal with a time constant of {value}."},
    {"firmware.goal_late", "The goal takes effect {value} late."},
    {"firmware.late", "The controller's output acts {value} late."},
    {"firmware.ends", "The controller's output is limited to {value}."},
    {"firmware.falls", "The controller's gain falls where the error exceeds {value}."},
    {"cause.loop", "What the torque alone does not tell, the closed loop does, from goal to position."},
    {"cause.loop.drive", "The drive has {effects}."},
    {"cause.none", "Nothing is missing that this recording could show."},
    {"cause.numbers",
     "No effect is missing that this recording could show; some numbers of the configuration were off, and "
     "are fitted now."},
    {"cause.stopped", "Not known: the search was stopped before its end."},
    {"cause.established", "Established[ once {open} {open?is|are} in the model]: {causes}.",
     "Established[ once {open} {open?is|are} in the model]: {causes:+}."},
    {"cause.likely.rival", "Likely, not confirmed[, with {open} in the model]: {causes}.",
     "Likely, not confirmed[, with {open} in the model]: {causes:+}. ({rival} explains nearly as much.)"},
    {"cause.likely.balance", "Likely, not confirmed[, with {open} in the model]: {causes}.",
     "Likely, not confirmed[, with {open} in the model]: {causes:+}. The {torque} balance shows it; the "
     "{judged}, restarted again and again, cannot decide."},
    {"cause.likely.recordings", "Established on these recordings[, with {open} in the model]: {causes}.",
     "Established on these recordings[, with {open} in the model]: {causes:+}. The {judged} of another "
     "recording may not show it."},
    {"cause.group", "One of these is missing[ once {open} {open?is|are} in the model]: {group:or}.",
     "One of these is missing[ once {open} {open?is|are} in the model]: {group:or}. These recordings cannot "
     "tell which; `fitted.yaml` has {first}."},
    {"cause.group.likely", "One of these is likely to be missing: {group:or}.",
     "One of these is likely to be missing: {group:or}. These recordings cannot tell which; `fitted.yaml` has {first}."},
    {"cause.group.one_law", "One of these is missing: {group:or}.",
     "One of these is missing: {group:or}. No recording can tell which: dry friction that differs with the "
     "direction is the same as equal friction and a constant torque; `fitted.yaml` has {first}."},
    {"cause.open", "Not established, though {open?it helps|they help}: {open}.",
     "Not established, though {open?it helps|they help}: {open:+}."},
    {"cause.open.least", "",
     "Only what lowers the error by {fall} or more ({share} of its mean square) is called a cause."},
    {"open.outlasts", "its period is longer than the held-out motion"},
    {"open.rivals", "it may as well be {rivals:or}"},
    {"open.amount", "these recordings do not determine its amount"},
    {"open.little", "it lowers the error by only {fall}"},
    {"open.uncertain", "by how much it lowers the error is uncertain, {low#} to {high}"},
    {"open.same", "what was added after it removes most of the same"},
    {"open.rival", "{rival} would remove nearly as much in its place"},
    {"cause.unknown", "Unknown: no effect of the catalogue explains it."},
    {"cause.unknown.nearest", "{nearest} comes closest, but removes {share} of the error above the floor."},
    {"cause.unknown.little", "It is small: the error in {x} is {times} times what the encoder can show."},
    {"cause.suspected", "Unknown, though {suspect} is suspected.",
     "Unknown, though {suspect} is suspected: in the torque balance it brings the missing {torque} down from "
     "{before#} to {after}."},
    {"cause.suspected.swapped", "", "The recording that was fitted moves too little to establish it."},
    {"cause.suspected.unconfirmed", "",
     "No simulation with it follows the recordings well enough to establish it."},
    {"cause.suspected.controller", "",
     "The {torque} here was not recorded but computed from the goal by the model's controller, which hides a "
     "part of what is missing."},
    {"cause.outside", "Most likely ({p}) the cause is not in the catalogue."},
    {"cause.exhausted", "The search ended at its limit of work, so further causes may have been missed."},
    {"simulator.row", "Your simulator: {row}[; {more} more {more?row differs|rows differ}]."},
    {"simulator.alike", "Your simulator lacks nothing that these recordings would show."},
    {"simulator.not_followed",
     "What differs is not known: the model with all effects of both leaves {floors} floors on your "
     "simulator, which it does not follow."},
    {"simulator.hidden",
     "No row differs, but the model with all effects of both leaves {floors} floors on the drive: what "
     "differs may hide there."},
    {"simulator.off",
     "What differs is not known: no row does, though your simulator is {floors} floors off the drive."},
    {"simulator.not_fitted",
     "The model that has all effects of both could not be fitted to drive and simulator alike."},
    {"simulator.no_row", "The model fitted to it misses it by {miss}, so that no row can be compared."},
    {"simulator.held_out", "Over the held-out input your simulator is {off} rms off the drive."},
    {"simulator.differs", "Your simulator differs from the drive: {rows:;}."},
    {"simulator.stand_in",
     "Over the held-out input it is {off} rms off the drive. The comparison uses a model fitted to it, which "
     "is {miss} off it."},
    {"simulator.mended",
     "Its error, {error}, falls to {mended} with {first} mended, by {share}[; with all {rows} rows it is {all}]."},
    {"simulator.not_mended",
     "Its error, {error}, does not fall with {first} alone mended[; with all {rows} rows it is {all}]."},
    // What helps.
    {"share.motion", "cuts the {error} by {share}"},
    {"share.motion.left", "cuts what is left of the {error} by {share}"},
    {"share.torque", "brings it from {before#} to {after}"},
    {"helps.stopped", "Not known: the search was stopped before its end."},
    {"helps.loop",
     "What the closed loop tells brings its error in position[ from {before}] to {after} rms over whole recordings."},
    {"helps.none", "Nothing in the catalogue helps."},
    {"helps.not_established", "Nothing that these recordings establish.",
     "Nothing that these recordings establish; `fitted.yaml` has no addition."},
    {"helps.rungs", "The missing {torque} falls from {before} to {left:then}.",
     "The missing {torque} falls from {before} to {left:+then}; in all from {share#} to {share_after} of "
     "what the {source}."},
    {"helps.motion_rungs", "The {error} falls from {before} to {left:then}.",
     "The {error}[ ({measure})] falls from {before} to {left:+then}."},
    {"helps.torque", "{added} {added?brings|bring} the missing {torque} down from {before#} to {after}.",
     "{added:+} {added?brings|bring} the missing {torque} down from {before#} to {after} ({share#} to "
     "{share_after} of what the {source})."},
    {"helps.motion", "{added} {added?brings|bring} the {error} down from {before#} to {after}.",
     "{added:+} {added?brings|bring} the {error} down from {before#} to {after}[ ({measure})]."},
    {"helps.fitted", "", "`fitted.yaml` has {added?it|them}."},
    {"helps.no_nearer", "But the simulated motion comes no nearer.",
     "But the simulated motion comes no nearer: {before#} off before, {after} after[ ({measure})]."},
    {"helps.left.noise", "What is left is noise.", "What is left does not show above the encoder's noise."},
    {"helps.left.varies", "What is left is no more than the drive varies by itself.",
     "What is left does not show above what the drive varies by from period to period."},
    {"helps.left.records", "",
     "Of the {left} left the {parts} disagree by {floor}; the rest is not explained."},
    {"helps.left.floor", "",
     "Of the {left} left no model gets below {floor}; what is above that is not explained."},
    {"helps.left.motion", "What is left, {times} times {floor}, is not explained."},
    {"helps.left.torque", "", "What is left, {times} times {floor}, is not explained."},
    {"helps.law", "A free curve over the {variable} cuts the {error} by {share}.",
     "A free curve over the {variable} cuts the {error} by {share} (compensation_{law}.csv)."},
    {"helps.numbers", "The fit has changed {brief}.", "Of your own numbers the fit has changed {changes}."},
    {"helps.scale", "",
     "Inertia and damping are both {factor} times those of the configuration, which the recordings cannot "
     "separate from a torque constant (or gear ratio) that is {share} {way}: where the inertia is certain, "
     "give it as a bare number, which is held, and set torque_constant: {estimate}."},
    {"helps.as_good", "Nothing is needed: the model is as good as the recording."},
    {"helps.as_good.other_numbers",
     "Other numbers than those of the configuration, and nothing more: {brief}.",
     "Other numbers than those of the configuration, and nothing more: {changes}; `fitted.yaml` has them and "
     "is as good as the recording."},
    {"helps.simulator",
     "Your simulator's error, {error}, falls[ to {mended} with {first} mended][, to {all_mended} with all "
     "{rows} rows that differ]."},
};

}  // namespace

std::span<const Wording> wordings() {
  static const std::vector<Wording> all = [] {
    std::vector<Wording> both(std::begin(kWordings), std::end(kWordings));
    const std::span<const Wording> steps = internal::telling::step_wordings();
    both.insert(both.end(), steps.begin(), steps.end());
    return both;
  }();
  return all;
}

}  // namespace gapscope
