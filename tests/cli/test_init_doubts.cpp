// What `init` does not take without a word.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/executable.h"
#include "cli/one_body_csv.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Workplace;

/// A sine of u, a position that follows it, and a motor that gets warm.
std::string with_temperature() {
  std::string csv = "t,u,x1,motor_temp,coil [°C]\n";
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i;
    csv += fmt::format("{:.3f},{:.6f},{:.8f},{:.2f},{:.2f}\n", t, 0.5 * std::sin(9.0 * t), -std::sin(9.0 * t),
                       25.0 + t, 30.0 + t);
  }
  return csv;
}

TEST(InitDoubts, ATemperatureIsNoInput) {
  Workplace place;
  place.file("r.csv", with_temperature());
  for (const std::string command : {"init", "check"})
    for (const std::string name : {"motor_temp", "'coil [°C]'"}) {
      const auto refused = place.run(command + " r.csv --input " + name);
      EXPECT_EQ(refused.status, 2);
      EXPECT_THAT(refused.err, AllOf(HasSubstr("--input is '"), HasSubstr("a temperature by its name"),
                                     HasSubstr("expected the column of a torque")));
    }
  EXPECT_FALSE(place.content().count("r.yaml"));
}

TEST(InitDoubts, AUnitInTheNameOfAColumnIsTaken) {
  Workplace place;
  std::string csv = "time_ms,current_A,Angle [deg]\n";
  for (int i = 0; i < 3000; ++i)
    csv += fmt::format("{},{:.6f},{:.8f}\n", i, 0.5 * std::sin(9e-3 * i), -57.0 * std::sin(9e-3 * i));
  place.file("r.csv", csv);
  const std::string columns = "r.csv --time time_ms --input current_A --position 'Angle [deg]' ";
  const auto told =
      HasSubstr("units       'time_ms' in ms, 'current_A' in A, 'Angle [deg]' in deg, by the names");
  EXPECT_THAT(place.run("check " + columns).out, AllOf(told, HasSubstr("3 s at 1000 Hz")));
  EXPECT_THAT(place.run("check --json " + columns).out, Not(told));
  EXPECT_THAT(place.run("init --model one_body " + columns).out, told);
  EXPECT_THAT(text_of(place.folder() / "r.yaml"),
              HasSubstr("units: {time: \"ms\", input: \"A\", position: \"deg\"}"));
  const auto declared = place.run("init --model one_body --position-unit mrad -o d.yaml " + columns);
  EXPECT_THAT(declared.out, HasSubstr("'time_ms' in ms, 'current_A' in A, by the names"));
  EXPECT_THAT(text_of(place.folder() / "d.yaml"), HasSubstr("position: \"mrad\""));
}

TEST(InitDoubts, ANumberInAnotherUnitIsAskedFor) {
  Workplace place;
  place.file("r.csv", with_temperature());
  const auto warned = [&](const std::string& options) {
    const auto init = place.run("init r.csv --model one_body " + options + " -o d.yaml");
    EXPECT_EQ(init.status, 0) << init.err;
    std::filesystem::remove(place.folder() / "d.yaml");
    return init.err;
  };
  EXPECT_THAT(warned("--mass 0.5 --arm 105"), HasSubstr("warning: --arm: 105 m? 105 mm is 0.105\n"));
  EXPECT_THAT(warned("--mass 1500 --arm 0.1"), HasSubstr("warning: --mass: 1500 kg? 1500 g is 1.5\n"));
  EXPECT_THAT(warned("--inertia 250"), HasSubstr("warning: --inertia: 250 kg m^2? 250 kg cm^2 is 0.025\n"));
  EXPECT_THAT(warned("--mass 490 --arm 10"), AllOf(HasSubstr("warning: --mass: 490 kg? 490 g is 0.49\n"),
                                                   HasSubstr("warning: --arm: 10 m? 10 cm is 0.1\n")));
  EXPECT_THAT(warned("--mass 0.5 --arm 0.105"), Not(HasSubstr("?")));
  EXPECT_THAT(warned("--inertia 1e-3"), Not(HasSubstr("?")));
}

/// Of an arm on a servo whose position 0 is not where it hangs.
TEST(InitDoubts, WhereAnArmHangsIsReadOffTheRecording) {
  Workplace place;
  const auto pendulum = [](double hangs, bool switched_off) {
    std::string csv = "t,u,x1\n";
    for (int i = 0; i < 4000; ++i) {
      const double t = 0.002 * i, w = 3.6 * std::cos(3.0 * t) + 2.8 * std::cos(7.0 * t);
      const double a = -10.8 * std::sin(3.0 * t) - 19.6 * std::sin(7.0 * t);
      const double x = 1.2 * std::sin(3.0 * t) + 0.4 * std::sin(7.0 * t);
      const double u = switched_off && i >= 2000 ? 0.0 : 0.02 * a + 0.03 * w + 0.7 * std::sin(x);
      csv += fmt::format("{:.3f},{:.8f},{:.8f}\n", t, u, x + hangs);
    }
    return csv;
  };
  place.file("pi.csv", pendulum(3.14, false));
  place.file("zero.csv", pendulum(0.0, false));
  place.file("off.csv", pendulum(0.0, true));
  const auto written = [&](const std::string& name) {
    const auto init = place.run("init " + name + ".csv --model one_body --mass 0.7 --arm 0.1");
    EXPECT_EQ(init.status, 0) << init.err;
    return std::pair(init.out, testing::text_of(place.folder() / (name + ".yaml")));
  };
  const auto [told, pi] = written("pi");
  EXPECT_THAT(told, HasSubstr("hangs_at    3.14 rad, read off the recording"));
  EXPECT_THAT(pi, HasSubstr("anchor: {mass: 0.7, arm: 0.1, hangs_at: {value: 3.14, estimate: true, bounds: "
                            "[2.64, 3.64]}}"));
  const auto [quiet, zero] = written("zero");
  EXPECT_THAT(quiet, Not(HasSubstr("hangs_at")));
  EXPECT_THAT(zero, HasSubstr("the arm hangs down at about 0, as the recording shows"));
  EXPECT_THAT(written("off").second, HasSubstr("the recording does not show: else add hangs_at:"));
  EXPECT_THAT(place.run("init --help").out, HasSubstr("anchor: hangs_at"));
}

TEST(InitDoubts, AGoalIsNoInput) {
  Workplace place;
  std::string csv = "t,goal,x1\n";
  for (int i = 0; i < 3000; ++i)
    csv += fmt::format("{:.3f},{:.6f},{:.8f}\n", 1e-3 * i, std::sin(9e-3 * (i + 10)), std::sin(9e-3 * i));
  place.file("r.csv", csv);
  const auto check = place.run("check r.csv --input goal");
  EXPECT_EQ(check.status, 3);
  EXPECT_THAT(check.out, HasSubstr("a commanded position"));
  const auto init = place.run("init r.csv --input goal --model one_body");
  EXPECT_EQ(init.status, 0);
  EXPECT_THAT(init.err, HasSubstr("such a column belongs under --target"));
}

TEST(InitDoubts, WhatIsRefusedSaysWhatToDo) {
  Workplace place;
  place.file("r.csv", with_temperature());
  EXPECT_THAT(place.run("init r.csv --encoder-side load").err,
              AllOf(HasSubstr("expected a header with the columns t, u, x2;"), HasSubstr("--position x1")));
  EXPECT_THAT(place.run("init r.csv --held-out ./r.csv").err,
              HasSubstr("--held-out is ./r.csv, the recording itself"));
  EXPECT_THAT(place.run("diagnose r.yaml --held-out h.csv").err, HasSubstr("--set recording.held_out=FILE"));
  ASSERT_EQ(place.run("init r.csv --model one_body").status, 0);
  EXPECT_THAT(place.run("init r.csv --model one_body").err,
              AllOf(HasSubstr("r.yaml: is there already"), HasSubstr("or that it is deleted first")));
}

/// The window of a configuration is of each of its files, and who cuts one is told of the other.
TEST(InitDoubts, AWindowCutsWhatIsHeldOutAsWellAndThatIsSaid) {
  Workplace place;
  place.file("r.csv", with_temperature());
  place.file("h.csv", with_temperature());
  const std::string init = "init r.csv --model one_body --window 0 1.5 ";
  const auto both = place.run(init + "--held-out h.csv -o both.yaml");
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out,
              HasSubstr("window      0 to 1.5 s of both files, also of h.csv, which is held out\n"));
  EXPECT_THAT(testing::text_of(place.folder() / "both.yaml"),
              HasSubstr("window: [0, 1.5]  # s, of each file, held_out as well\n"));
  EXPECT_THAT(place.run(init + "-o one.yaml").out, Not(HasSubstr("window")));
}

/// The sheet's torque constant: what was read goes in proportion to it, and nothing is left to guess.
TEST(Init, ATorqueConstantThatIsToldScalesWhatWasRead) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  place.file("r.csv", one_body_csv(input));
  const std::string init = "init r.csv --model one_body --torque-constant 0.172 ";
  const auto told = place.run(init + "-o told.yaml");
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, Not(HasSubstr("GUESS")));
  const std::string yaml = testing::text_of(place.folder() / "told.yaml");
  EXPECT_THAT(yaml, HasSubstr("torque_constant: 0.172  # N m per unit of u, as given"));
  EXPECT_THAT(yaml, HasSubstr("motor_inertia: {value: 0.0008"));  // of 8.78e-4 kg m^2
  EXPECT_THAT(yaml, Not(HasSubstr("over torque_constant")));
  EXPECT_EQ(place.run(init + "--gear-ratio 2 -o geared.yaml").status, 0);
  const std::string geared = testing::text_of(place.folder() / "geared.yaml");
  EXPECT_THAT(geared, HasSubstr("torque_constant: {value: 0.172, given_at: motor}"));
  EXPECT_THAT(geared, HasSubstr("motor_inertia: {value: 0.003")) << "four times, behind the gear";
  EXPECT_THAT(place.run(init + "--input-unit 'N m' -o torque.yaml").err, HasSubstr("it is 1 there"));
  EXPECT_EQ(place.run(init + "--inertia 8.8e-4 -o sheet.yaml").status, 0);
  const std::string sheet = testing::text_of(place.folder() / "sheet.yaml");
  EXPECT_THAT(sheet,
              AllOf(HasSubstr("motor_inertia: {value: 0.00088, estimate: true}  # kg m^2; begun as given"),
                    Not(HasSubstr("anchor"))));
  EXPECT_EQ(place.run("init r.csv --model gap --torque-constant 0.172 --inertia 8.8e-4 -o gap.yaml").status,
            0);
  EXPECT_THAT(testing::text_of(place.folder() / "gap.yaml"),
              HasSubstr("motor_inertia: 0.00088  # kg m^2, as given"));
  EXPECT_NE(place.run(init + "--mass 0.5 --arm 0.1 -o anchored.yaml").status, 0);
}

}  // namespace
}  // namespace gapscope
