#pragma once

#include <span>

#include "gapscope/base/remark.h"
#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/gap_estimate.h"

/// Everything that the detector says, in one place. Angles and speeds in SI units.
namespace gapscope::internal::sliding_mode::words {

Remark no_recording();
Remark encoder_on_load();
Remark no_steady_motion_yet();
Remark within_first_samples(long samples);  ///< behind why nothing could be learnt

// Impacts, and passages between them.
Remark no_impact_stands_out();
Remark load_coasts_through();
Remark passages_few_quanta_wide();
Remark load_hits_motor();
Remark few_samples_around_impacts();
Remark release_not_located();
Remark load_moves();
Remark rests_alone();
Remark load_pushed();
Remark contact_tears();
Remark more_periods();

Remark few_passages_each_way(long plus, long minus, const Remark& advice);
Remark few_passages(long used, double asked, long seen, double half_periods, const Remark& advice);
Remark most_of_travel(double gap, double travel);
Remark gap_few_quanta(double gap, double quanta);
Remark too_slow(double visible);  ///< NaN: no gap would show
Remark passages_used(long used, long seen, int only_direction);
/// @param why  what the interval is mostly made of, and what would narrow it
Remark gap_uncertain(double gap, double percent, const Remark& why);
Remark few_counts(double counts, double needed);
Remark ends_uncertain();
Remark passages_differ();
Remark directions_differ();
Remark recordings_differ();
Remark samples_apart();
Remark one_body(double mass_ratio, double half_periods);
/// What u works against holds the contact closed.  @param leaning  SignalFacts
Remark held_closed(double leaning);
Remark only_large_gaps(double mass_ratio, double visible, double travel);
Remark flights_together(long used, long turns);

// Quasi-static loops.
struct Play {
  double play, amplitude;  ///< [rad], of u
  long loops;
};
Remark stands_still();                   ///< why there is no loop
Remark few_torque_ramps(long zeros);     ///< the same
Remark does_not_follow(double percent);  ///< the same
Remark no_loop(const Remark& why);
Remark loop_not_asked_for();  ///< the same
Remark locked_without_loop(const Remark& why);
/// Of one e_x with a bound that is given, where a loop can be read.
Remark locked_with_bound();
Remark no_flank();
Remark holds_gap(double lost_motion, double gap);
Remark lost_motion_means(LostMotionCause cause, double free_run, double alone, bool levels_differ);
Remark hysteresis_hides(std::span<const Play> levels, double visible, double travel);
Remark play_scatters(std::span<const Play> levels, double half_width);
Remark play_depends_on_level(std::span<const Play> levels, double limit);  ///< NaN: no limit on a gap
Remark play_at_one_level();
Remark play_is_a_bound(double limit);  ///< of a gap [rad]
Remark play_read(std::span<const Play> levels, double free_run);
Remark no_free_run(std::span<const Play> levels);
Remark small_ramps(double travel, double visible);  ///< travel of a ramp
Remark sticks_and_leaps();
Remark play_at_some_levels();
Remark loop_runs_backwards(std::span<const Play> levels);
Remark free_run_without_play(std::span<const Play> levels, double free_run);

// The torque behind a reversal.
Remark shelf_read(long reversals, double way);

// What a reading was tested for, and what it presumes.
Remark both_directions();
Remark single_passages();
Remark load_known();
Remark narrow_interval();
Remark levels_agree();
Remark same_with_other_bounds();
Remark one_gap();
Remark one_impact();
Remark second_impact();  ///< added to another
Remark load_rests();
Remark impacts_too();
Remark same_by_torque();
Remark own_encoder();

// One bound, as published.
Remark error_never_at_rest();
Remark bound_above_gap_mode();
Remark bound_below_engaged();
Remark flank_late(double percent);
Remark passages_contradict();
Remark reversals_read(double read, double half_periods, double bound);
Remark passages_as_printed(double read, double half_periods, double bound);
Remark paper_bound_misses(double bound, const Remark& reason);
Remark auto_reads();                                    ///< added to another
Remark nothing_reads(const Remark& why_not_auto);       ///< added to another
Remark bound_to_try(double bound);                      ///< added to another
Remark bounds_to_try(double smallest, double largest);  ///< added to another

}  // namespace gapscope::internal::sliding_mode::words
