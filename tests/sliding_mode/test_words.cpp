// Every sentence of the detector can be put together, on both axes.
#include <gtest/gtest.h>

#include <set>

#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

std::vector<Remark> all_remarks() {
  const Remark more = words::more_periods();
  const std::vector<words::Play> plays = {{0.01, 0.2, 3}, {0.02, 0.4, 5}};
  return {words::no_recording(),
          words::encoder_on_load(),
          words::no_steady_motion_yet(),
          words::within_first_samples(900),
          words::no_impact_stands_out(),
          words::load_coasts_through(),
          words::passages_few_quanta_wide(),
          words::load_hits_motor(),
          words::few_samples_around_impacts(),
          words::release_not_located(),
          words::load_moves(),
          words::rests_alone(),
          words::load_pushed(),
          words::contact_tears(),
          more,
          words::few_passages_each_way(1, 2, more),
          words::few_passages(3, 4.0, 5, 6.0, more),
          words::most_of_travel(0.3, 0.4),
          words::gap_few_quanta(0.01, 7.0),
          words::too_slow(0.1),
          words::too_slow(kNaN),
          words::passages_used(5, 6, 1),
          words::flights_together(12, 13),
          words::gap_uncertain(0.01, 40.0, more),
          words::few_counts(22.0, 40.0),
          words::few_counts(22.0, 100.0),
          words::ends_uncertain(),
          words::passages_differ(),
          words::directions_differ(),
          words::recordings_differ(),
          words::samples_apart(),
          words::one_body(0.1, 12.0),
          words::only_large_gaps(0.1, 0.019, 0.246),
          words::stands_still(),
          words::few_torque_ramps(2),
          words::does_not_follow(51.0),
          words::no_loop(words::stands_still()),
          words::loop_not_asked_for(),
          words::locked_without_loop(words::does_not_follow(51.0)),
          words::locked_with_bound(),
          words::lost_motion_means(LostMotionCause::kGap, 0.03, 9.0, true),
          words::lost_motion_means(LostMotionCause::kFriction, 0.0, 1.0, false),
          words::lost_motion_means(LostMotionCause::kOpen, 0.0, 1.0, true),
          words::hysteresis_hides(plays, 0.01, 0.05),
          words::play_scatters(plays, 0.01),
          words::play_depends_on_level(plays, 0.01),
          words::play_depends_on_level(plays, kNaN),
          words::play_at_one_level(),
          words::play_is_a_bound(0.031),
          words::play_read(plays, 0.03),
          words::no_free_run(plays),
          words::small_ramps(0.1, 0.2),
          words::sticks_and_leaps(),
          words::play_at_some_levels(),
          words::error_never_at_rest(),
          words::bound_above_gap_mode(),
          words::bound_below_engaged(),
          words::flank_late(10.0),
          words::passages_contradict(),
          words::reversals_read(5.0, 6.0, 4.1),
          words::paper_bound_misses(98.0, more),
          words::auto_reads(),
          words::nothing_reads(words::load_coasts_through()),
          words::bound_to_try(4.0),
          words::bounds_to_try(4.0, 5.0)};
}

TEST(Words, ArePutTogetherOnBothAxes) {
  std::set<std::string> texts;
  for (const Remark& remark : all_remarks()) {
    EXPECT_FALSE(remark.code().empty());
    for (const Coordinates coordinates : {Coordinates::kRotation, Coordinates::kTranslation}) {
      const std::string text = remark.text(coordinates);
      EXPECT_EQ(text.find_first_of("{}[]"), std::string::npos) << text;
      EXPECT_TRUE(coordinates.rotational() || text.find(" rad") == std::string::npos) << text;
    }
    EXPECT_TRUE(texts.insert(remark.text()).second) << "said twice: " << remark.text();
  }
}

TEST(Words, ListPlaysWithTheirLevels) {
  const std::vector<words::Play> plays = {{0.01, 0.2, 3}, {0.02, 0.4, 5}};
  EXPECT_EQ(
      words::no_free_run(plays).text(Coordinates::kTranslation),
      "quasi-static loop without a free run: hysteresis of friction and compliance, 10 mm at |u| = 0.2 (3 "
      "ramps), 20 mm at |u| = 0.4 (5 ramps)");
}

}  // namespace
}  // namespace gapscope::internal::sliding_mode
