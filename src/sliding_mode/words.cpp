#include "sliding_mode/words.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::sliding_mode::words {
namespace {

/// "0.01 rad at |u| = 0.2 (3 ramps), 0.02 rad at ..."
Remark listed(std::span<const Play> levels) {
  Remark all;
  for (const Play& level : levels)
    all += Remark(
        "level",
        all.empty() ? "{:.3g} [rad] at |u| = {:.3g} ({} ramps)" : ", {:.3g} [rad] at |u| = {:.3g} ({} ramps)",
        {level.play, level.amplitude, level.loops});
  return all;
}

}  // namespace

Remark no_recording() { return {"no_recording", "no recording"}; }
Remark encoder_on_load() {
  return {
      "encoder_on_load",
      "the encoder is on the load: the motor's way through the gap does not show in x2, which has of a gap "
      "only a standstill at reversals or a limit cycle, as friction has; record the motor's position as "
      "well, or fit a model"};
}
Remark no_steady_motion_yet() {
  return {"no_steady_motion_yet",
          "no steady periodic motion yet: most of the time so far was rest or transient"};
}
Remark within_first_samples(long samples) {
  return {"within_first_samples", " (in the first {} samples)", {samples}};
}
Remark no_impact_stands_out() {
  return {"no_impact_stands_out",
          "no impact stands out of the motion: quasi-static, or without a free passage; use a faster "
          "excitation (higher frequency or amplitude) with the output free to move"};
}
Remark load_coasts_through() {
  return {
      "load_coasts_through",
      "the load coasts through the gap before the motor turns, and meets the far flank while x1 still goes "
      "the other way; less torque or a triangle, or let the load rest at the reversals"};
}
Remark passages_few_quanta_wide() {
  return {"passages_few_quanta_wide",
          "the passages are a few encoder quanta wide; use a finer encoder or a wider motion"};
}
Remark load_hits_motor() {
  return {"load_hits_motor",
          "the load drives the motor at the impacts; let the motion rest at its reversals, or lower the "
          "frequency"};
}
Remark few_samples_around_impacts() {
  return {"few_samples_around_impacts", "too few samples around the impacts; sample faster"};
}
Remark release_not_located() {
  return {"release_not_located",
          "the release before the impacts cannot be located; let the motion rest at its reversals "
          "(a trapezoid that pauses at zero torque), lower the frequency, or use a finer encoder"};
}
Remark load_moves() {
  return {"load_moves",
          "the load was moving between t1 and t2; let the motion rest at its reversals (a trapezoid that "
          "pauses at zero torque), or lower the frequency"};
}
Remark rests_alone() {
  return {
      "rests_alone",
      "the motor may have come to rest within the gap, after a load that coasted on; let the torque fall to "
      "zero more slowly, so that the load stops while it is still pushed, or use a finer encoder"};
}
Remark load_pushed() {
  return {
      "load_pushed",
      "where the motion turns round, a force on the load (an unbalance, a spring, a friction that springs "
      "back) drives it through the gap, too; remove that force, or reverse where it is small"};
}
Remark contact_tears() {
  return {
      "contact_tears",
      "the jolts at the ends of the passages throw x1 on along its way, where a contact would hold it back; "
      "look for a contact that sticks until it tears (grease), or for a controller that steps at each "
      "reversal "
      "(backlash compensation)"};
}
Remark more_periods() { return {"more_periods", "record more periods"}; }
Remark few_passages_each_way(long plus, long minus, const Remark& advice) {
  return Remark("few_passages",
                "only {} and {} usable passages of the gap in the two directions: ", {plus, minus}) +
         advice;
}
Remark few_passages(long used, double asked, long seen, double half_periods, const Remark& advice) {
  const Remark text =
      Remark("few_passages",
             "only {} usable passages of the gap where {:.0f} are asked, of {} seen in {:.0f} half periods: ",
             {used, asked, seen, half_periods}) +
      advice;
  const double times = asked / static_cast<double>(std::max(used, 1L));
  if (times > 2.0 || advice.code() == more_periods().code()) return text;
  return text + Remark("few_passages", ", or record {:.1f} times as long", {std::ceil(10.0 * times) / 10.0});
}
Remark most_of_travel(double gap, double travel) {
  return {"most_of_travel",
          "the estimate of {:.3g} [rad] is most of the travel of {:.3g} [rad]; raise the amplitude",
          {gap, travel}};
}
Remark gap_few_quanta(double gap, double quanta) {
  return {"gap_few_quanta",
          "a gap of {:.2g} [rad] is only {:.0f} encoder quanta; use a finer encoder",
          {gap, quanta}};
}
Remark too_slow(double visible) {
  const Remark limit =
      std::isfinite(visible)
          ? Remark("visible", "the impacts of a gap below {:.2g} [rad] would not show", {visible})
          : Remark("nothing_visible", "no gap of any size would show");
  return Remark("too_slow",
                "this recording shows no impacts (slow motion, a locked output or a coarse encoder): ") +
         limit +
         Remark(
             "too_slow",
             "; use a faster excitation (higher frequency or amplitude) with the output free to move, or a "
             "finer encoder");
}
Remark passages_used(long used, long seen, int only_direction) {
  Remark said("passages_used", "{} of {} passages of the gap used", {used, seen});
  if (only_direction > 0) said += Remark("rising", ", all with rising x1");
  if (only_direction < 0) said += Remark("falling", ", all with falling x1");
  return said;
}
Remark one_body(double mass_ratio, double half_periods) {
  return {"one_body",
          "for a load of at least {:.1f} of the motor's inertia: it goes along with the motor as one body in "
          "{:.0f} half periods",
          {mass_ratio, half_periods}};
}
Remark held_closed(double leaning) {
  return {
      "held_closed",
      "the mean of u is {:.1f} times what u swings by: what it works against, such as gravity or a preload, "
      "holds the contact closed, and no gap shows; unload it, or let u swing about 0",
      {leaning}};
}
Remark only_large_gaps(double mass_ratio, double visible, double travel) {
  return {"only_large_gaps",
          "this recording could only have shown a gap of {:.2g} [rad], on a travel of {:.2g} [rad], and for "
          "a load "
          "of at least {:.1f} of the motor's inertia; use a faster excitation (higher frequency or "
          "amplitude) with "
          "the output free to move, a finer encoder or faster sampling",
          {visible, travel, mass_ratio}};
}
Remark flights_together(long used, long turns) {
  return {"flights_together",
          "{} passages after {} changes of the torque's sign, looked at together",
          {used, turns}};
}

Remark both_directions() { return {"both_directions", "same in both directions"}; }
Remark single_passages() { return {"single_passages", "read in single passages, not in all together alone"}; }
Remark load_known() {
  return {"load_known",
          "the motor rests at its load before the gap, or the law of the load that moves is known"};
}
Remark narrow_interval() { return {"narrow_interval", "known to an eighth"}; }
Remark levels_agree() { return {"levels_agree", "same at two torque levels"}; }
Remark same_with_other_bounds() { return {"same_with_other_bounds", "same with other bounds"}; }
Remark one_gap() { return {"one_gap", "there is one gap, not several in series"}; }
Remark one_impact() {
  return {"one_impact", "no later impact is more abrupt than the one that closes the gap"};
}
Remark second_impact() {
  return {
      "second_impact",
      "; behind them a second impact, more abrupt than the first: several gaps in series, of which this is "
      "the first"};
}
Remark load_rests() { return {"load_rests", "load rests between t1 and t2"}; }
Remark impacts_too() { return {"impacts_too", "impacts show the gap, too"}; }
Remark same_by_torque() { return {"same_by_torque", "the torque behind the reversals tells the same"}; }
Remark shelf_read(long reversals, double way) {
  return {
      "shelf_read",
      "the torque behind {} reversals: low for {:.3g} [rad], where the motor moves alone, then the load's "
      "friction on top",
      {reversals, way}};
}
Remark own_encoder() { return {"own_encoder", "x1 is what the encoder read, not filtered since"}; }

Remark stands_still() { return {"stands_still", "x1 moves by less than its noise"}; }
Remark few_torque_ramps(long zeros) {
  return {"few_torque_ramps",
          "u passes zero {} times, and a loop needs three ramps of one amplitude, to either side",
          {zeros}};
}
Remark does_not_follow(double percent) {
  return {"does_not_follow",
          "{:.0f} % of the way of x1 go with the change of u, and a quasi-static loop needs 75 %",
          {percent}};
}
Remark no_loop(const Remark& why) {
  return Remark("no_loop", "there is no lost-motion loop: ") + why +
         Remark("advice", "; ramp the torque slowly to and fro beyond the friction, three times or more");
}
Remark loop_not_asked_for() {
  return {"loop_not_asked_for", "the method is impact, and the loop was not asked"};
}
Remark locked_without_loop(const Remark& why) {
  return Remark("locked_without_loop",
                "the output is locked, so that no impact shows, and no loop gives the gap: ") +
         why +
         Remark("advice", "; ramp the torque slowly to and fro beyond the friction, three times or more");
}
Remark locked_with_bound() {
  return {
      "locked_with_bound",
      "the output is locked, so that no impact shows, and one e_x with a given bound reads impacts alone; "
      "the lost-motion loop, which this recording has, is read with detector: bound: auto"};
}
Remark no_flank() {
  return {"no_flank",
          "x1 lies at zero torque where it turns: the loop has no loaded flank to read lost motion from"};
}
Remark holds_gap(double lost_motion, double gap) {
  return {"holds_gap",
          "of {:.3g} [rad] lost motion the gap is {:.3g} [rad]; the rest is friction, compliance or coasting",
          {lost_motion, gap}};
}
Remark lost_motion_means(LostMotionCause cause, double free_run, double alone, bool levels_differ) {
  const Remark differ =
      levels_differ
          ? Remark("levels_differ", "; it depends on the torque level, as friction and compliance do")
          : Remark();
  if (cause == LostMotionCause::kGap)
    return Remark("mostly_gap",
                  "mostly a gap: on each ramp x1 runs free over {:.3g} [rad] at one torque, {:.2g} times as "
                  "far as it moves at any other",
                  {free_run, alone}) +
           differ;
  if (cause == LostMotionCause::kFriction)
    return Remark("friction_and_compliance",
                  "friction and compliance: x1 goes along with the torque and runs free nowhere") +
           differ;
  return Remark("open", "whether it is a gap or friction and compliance does not show here") + differ;
}
Remark hysteresis_hides(std::span<const Play> levels, double visible, double travel) {
  return Remark("hysteresis_hides",
                "a loop of friction and compliance, in which this recording could only have shown a gap of "
                "{:.3g} [rad], on a travel of {:.3g} [rad]: ",
                {visible, travel}) +
         listed(levels) + Remark("advice", "; free the output and use the impacts to see smaller gaps");
}
Remark play_scatters(std::span<const Play> levels, double half_width) {
  return Remark("play_scatters",
                "x1 runs free, but the ramps leave the play uncertain by {:.2g} [rad]: ", {half_width}) +
         listed(levels) + Remark("advice", "; ramp the torque further beyond the friction, or more often");
}

Remark play_depends_on_level(std::span<const Play> levels, double limit) {
  const Remark gap = std::isfinite(limit)
                         ? Remark("limit",
                                  "; the difference is friction or compliance, so the gap is at most {:.3g} "
                                  "[rad]",
                                  {limit})
                         : Remark("limit", "; the difference is friction or compliance");
  return Remark("play_depends_on_level", "the play at zero torque depends on the torque level: ") +
         listed(levels) + gap +
         Remark("advice",
                "; ramp to small torques just above the friction, or free the output and use the impacts");
}
Remark play_at_one_level() {
  return {"play_at_one_level",
          "the play at zero torque was read at one torque level only; ramp to another amplitude as well: a "
          "play that depends on it is friction or compliance"};
}
Remark play_is_a_bound(double limit) {
  return {"play_is_a_bound",
          "the loop was recorded at one torque level and the output is not declared locked, so a load that "
          "slides may be part of it: the gap is at most {:.3g} [rad]; ramp to another amplitude as well, or "
          "lock the output and declare it (load: locked)",
          {limit}};
}
Remark play_read(std::span<const Play> levels, double free_run) {
  return Remark("play", "branches of the lost-motion loop: ") + listed(levels) +
         Remark("free_run", "; on each ramp x1 runs free over {:.3g} [rad]", {free_run});
}
Remark no_free_run(std::span<const Play> levels) {
  return Remark("no_free_run",
                "quasi-static loop without a free run: hysteresis of friction and compliance, ") +
         listed(levels);
}
Remark small_ramps(double travel, double visible) {
  return {"small_ramps",
          "on a ramp the motor moves by {:.3g} [rad], and a gap would show from {:.3g} [rad]: ramp to a "
          "larger torque",
          {travel, visible}};
}
Remark sticks_and_leaps() {
  return {"sticks_and_leaps",
          "the drive sticks and leaps within a ramp, which hides or imitates a play; ramp the torque further "
          "beyond the friction of the motor, or add a dither"};
}
Remark play_at_some_levels() {
  return {
      "play_at_some_levels",
      "x1 runs free at some torque levels only; ramp the torque further beyond the friction of the motor"};
}
Remark loop_runs_backwards(std::span<const Play> levels) {
  return Remark("loop_runs_backwards", "the lost-motion loop runs backwards, x1 moves before u does: ") +
         listed(levels) +
         Remark("advice", "; record u and x1 at the same instants: u is late, or its sign is wrong");
}
Remark free_run_without_play(std::span<const Play> levels, double free_run) {
  return Remark(
             "free_run_without_play",
             "on each ramp x1 runs free over {:.3g} [rad], which the play does not bear out: ", {free_run}) +
         listed(levels) +
         Remark("advice",
                "; a gap that is passed without friction, hard stops and a soft drive look alike: free the "
                "output and use the impacts");
}

}  // namespace gapscope::internal::sliding_mode::words
