#include "telling/step_wordings.h"

namespace gapscope::internal::telling {
namespace {

constexpr Wording kSteps[] = {
    {"next.within_tolerance", "Nothing: this is within your tolerance."},
    {"next.nothing", "Nothing."},
    {"next.finish", "Run `gapscope diagnose CONFIG` to its end."},
    {"next.diagnose.gap_known", "Nothing more for the gap."},
    {"next.diagnose.too", "To see where model and drive differ, and why: `gapscope diagnose CONFIG`."},
    {"next.diagnose",
     "Run `gapscope diagnose CONFIG`: it shows where the model and the drive differ, and why."},
    {"next.diagnose.lacks",
     "Run `gapscope diagnose CONFIG`: it finds what the model still lacks, such as a delay, cogging or "
     "another friction law."},
    {"next.model_gap",
     "Put a gap into the model first: write the configuration again with `gapscope init ... --model gap` "
     "(and the motor's own inertia, `--inertia`, where its data sheet has it), and diagnose that."},
    {"next.read_gap",
     "Read the gap with what was found in the model: `gapscope run CONFIG --model-from DIR/fitted.yaml -o DIR_gap`."},
    {"next.estimate",
     "Let the fit estimate what the configuration holds ({held}: {estimate}), and diagnose again: while such "
     "a number is wrong, effects make up for it."},
    {"next.swap",
     "Swap `file` and `held_out` and diagnose again: the recording that is held out now moves more, and "
     "shows more when it is fitted."},
    {"next.go_on",
     "[{first} ]`gapscope diagnose CONFIG --model-from DIR/fitted.yaml -o DIR_more` goes on from what was found."},
    {"next.do_not_rely",
     "Do not rely on `DIR/fitted.yaml` yet: {left} of the {torque} is unexplained with all that was found. "
     "Record another motion ({motion})[, or {swap}], and diagnose again.",
     "Do not rely on `DIR/fitted.yaml` yet: {left} of the {torque} is unexplained with all that was found "
     "({times} times {floor}). Record another motion ({motion})[, or {swap}], and diagnose again."},
    {"next.no_nearer",
     "Do not simulate with `DIR/fitted.yaml`: the motion comes no nearer with {added?what was added|all that "
     "was added}. Record another motion ({motion}), and diagnose again."},
    {"next.loop", "Simulate with `DIR/fitted.yaml`, goal in and position out."},
    {"next.simulate", "Simulate with `DIR/fitted.yaml`[, which has {addition} in it]."},
    {"next.simulate.open",
     "Simulate with `DIR/fitted.yaml`: it predicts best, whether or not each addition is a real cause."},
    {"next.simulate.drifts",
     "Simulate short motions alone with `DIR/fitted.yaml`: over a whole recording it is up to {after} off, "
     "without what was added {before}."},
    {"next.simulate.runs_away",
     "Simulate short motions alone with `DIR/fitted.yaml`: over a whole recording it runs away."},
    {"next.short_motions",
     "Simulate short motions alone with `DIR/fitted.yaml`: over a whole recording it drifts by {drift} of the travel."},
    {"next.numbers", "Simulate with the numbers of `DIR/fitted.yaml`."},
    {"next.export",
     "`gapscope export DIR --to {format} -o DIR_{format}` writes {what} for other simulators."},
    {"next.export.any", "`gapscope export` writes {what} for other simulators."},
    {"next.export.loses", "",
     "`gapscope export` loses a part of {lost} in every format; certificate.md says how much."},
    {"next.settle",
     "To settle the cause, record another motion ({motion}) and diagnose again with that held out."},
    {"next.confirm",
     "To see whether that holds elsewhere, record another motion ({motion}) and diagnose again with that."},
    {"next.mend_simulator",
     "Mend your simulator: {rows}, as the table of drive and simulator has it; `fitted.yaml` has the drive's numbers."},
    {"next.record_input",
     "Record the motor's input as well (duty, current or torque), and diagnose from that."},
    {"next.record_motion",
     "Record the drive in another motion (other speeds, other loads) and diagnose that."},
    {"next.little",
     "Nothing, if {share} of the {torque} is little enough (`tolerance: {tolerance}` judges it). Else:"},
    {"next.experiment.record",
     "Record {input} for {duration} s: it would separate the two causes by {by:,}."},
    {"next.experiment.contained", "If {truth} is the cause, no input can tell, because {rival} contains it."},
    {"next.experiment.travel",
     "The models travel {travel} in it: check first that stops, speed and temperature of the drive allow that."},
    {"next.experiment.none", "No input within the limits would tell {rivals:from} by one σ of the encoder."},
    {"next.experiment.limits",
     "Widen the limits where the drive may move farther (`next_experiment:` of the configuration), or use "
     "another load or a finer encoder."},
    {"next.experiment.unplayable", "No input within the limits can be played on these models."},
    {"next.experiment.goals",
     "Record other goals (faster or slower ones, another amplitude), or the same ones at another gain of the "
     "controller, and hold that recording out: these do not tell {rivals:from}."},
    {"next.see_to_recording", "Mend the recording first: {advice}."},
    {"next.estimate_gap",
     "Let the fit find the gap (gap: {estimate}): the configuration holds it at {held}, and without a model "
     "it reads {read}."},
    {"next.sign",
     "Check the sign and the unit of the input u (`gapscope check`): a motor without torque would predict "
     "this motion better."},
    {"next.once_more",
     "Record once more at another amplitude or frequency: the estimate that stays is the one to believe."},
    {"next.without_gap",
     "Fit the model with its gap closed (`--set model.parameters.gap=0`, a compliant shaft) or as one body "
     "(`gapscope init --model one_body`), or record a motion that closes the contact on both sides."},
    {"next.close_contact", "Record a motion that closes the contact on both sides, several times."},
    {"next.start_nearer.iterations",
     "Start the fit nearer to the drive (model: parameters), or raise fit: max_iterations."},
    {"next.start_nearer.unit",
     "Start the fit nearer to the drive (model: parameters), and check the unit of the input u."},
    {"next.bound_auto.loop",
     "Set detector: bound to auto: it reads the lost-motion loop, a given bound reads impacts alone."},
    {"next.other_bound",
     "Try another bound, a lower one where e_x shows impacts alone, or detector: {auto}."},
    {"next.model_of_load",
     "For a gap by a model alone: `gapscope init` with --model gap, then `gapscope fit`."},
    {"next.bound_as_told",
     "Set detector: bound as the reason says, or to auto, which reads with a bank of bounds."},
    {"next.bound_auto", "Set detector: bound to auto, which reads this recording."},
    {"next.faster",
     "For a reading without a model: a faster motion, a finer encoder or faster sampling, the output free."},
    {"next.unload",
     "For the gap, take the constant load off (turn the drive so that its weight does not act, release the "
     "preload), or let the input swing about 0."},
    {"next.advice", "For a reading without a model: {advice}."},
    {"next.free_motion",
     "For a reading without a model, record seven periods or more of a triangle or a sine with a dwell at "
     "the reversals, the output free."},
    {"next.larger_ramps",
     "Leave the output held: slow ramps to and fro, three or more, to a larger torque than in this recording."},
    {"next.smaller_ramps",
     "Add ramps to half the smallest torque: the gap is at most the lost motion there, and wind-up shrinks "
     "with the torque."},
    {"next.ramps_between",
     "Add ramps to torques between those: the smallest that overcome the friction bound the gap by their lost "
     "motion."},
    {"next.hold_output",
     "Hold the output and record slow ramps of both directions: their lost motion is the play of all gaps together."},
    {"next.two_levels",
     "Repeat the ramps at half and at twice the torque: the part of the lost motion that grows with it is no gap."},
};

}  // namespace

std::span<const Wording> step_wordings() { return kSteps; }

}  // namespace gapscope::internal::telling
