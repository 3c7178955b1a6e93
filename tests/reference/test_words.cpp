// Every sentence of the fit can be put together, on both axes.
#include <gtest/gtest.h>

#include "reference/words.h"

namespace gapscope::internal::reference {
namespace {

std::vector<Remark> all_remarks() {
  return {words::diverges(),
          words::iterations_ran_out(),
          words::not_explained(12.0, 30.0),
          words::leaves_some(6.2, 30.0),
          words::free_run_departs(3.0),
          words::at_the_floor(99.98),
          words::failed_to_fit(),
          words::leaves_unexplained(0.65, 31.0),
          words::leaves_unexplained(1.7, 31.0),
          words::as_well_without_gap(1.02),
          words::gap_bears_little(1.5, 239.0),
          words::gap_differs(),
          words::odd_coupling("mass_ratio", 100.0, "-"),
          words::not_settled(),
          words::gap_at_bound(),
          words::gap_not_determined(),
          words::parts_disagree(),
          words::above_floor(95.07, 1700.0, 6.2),
          words::above_floor(-102.0, 4400.0, 15.0),
          words::residual_patterned(),
          words::not_random(0.4, 0.1),
          words::worse_than_still(3.0),
          words::at_bound("gap", 0.1, "rad"),
          words::no_trace("contact_damping"),
          words::like_initial_state("gap"),
          words::change_together({"motor_inertia", "torque_constant"}, {1.0, 1.0}),
          words::change_together({"load_damping", "mass_ratio"}, {1.0, -1.0}),
          words::change_together({"load_damping", "mass_ratio", "gap"}, {1.0, 2.0, -0.5}),
          words::not_determined("motor_damping", 0.1, "N m s/rad", "mass_ratio"),
          words::no_information("gap"),
          words::little_known("contact_stiffness", 40.0),
          words::another_gap(0.01, 0.02),
          words::values_move(words::between_recordings("a.csv", "b.csv"), {{"gap", 0.01, 0.02, "rad"}}),
          words::values_move(words::between_parts(3.0),
                             {{"gap", 0.01, 0.02, "rad"}, {"mass_ratio", 1.0, 2.0, "-"}}),
          words::values_move(words::between_gains(30.0, 10.0), {{"gap", 0.01, 0.02, "rad"}})};
}

TEST(Words, ArePutTogetherOnBothAxes) {
  for (const Remark& remark : all_remarks()) {
    EXPECT_FALSE(remark.code().empty());
    for (const Coordinates coordinates : {Coordinates::kRotation, Coordinates::kTranslation}) {
      const std::string text = remark.text(coordinates);
      EXPECT_EQ(text.find_first_of("{}[]"), std::string::npos) << text;
      EXPECT_TRUE(coordinates.rotational() || text.find(" rad") == std::string::npos) << text;
    }
  }
}

TEST(Words, SayWhatIsDeterminedOfParametersThatChangeTogether) {
  EXPECT_EQ(
      words::change_together({"motor_inertia", "torque_constant"}, {1.0, 1.0}).text(),
      "motor_inertia and torque_constant change together without a trace: only their ratio is determined. Fix "
      "one of them; what would separate them is a known torque or a known inertia.");
}

TEST(Words, NameTheExcitationForEveryParameter) {
  EXPECT_EQ(words::excitation_for("contact_damping"), "harder impacts");
  EXPECT_EQ(words::excitation_for("cogging_torque.ratio"), "an input that brings this effect out");
}

}  // namespace
}  // namespace gapscope::internal::reference
